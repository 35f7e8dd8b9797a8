// SPDX-License-Identifier: MIT
#include "lammps_engine.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>

#include "child_program.hpp"
#include "initial_state.hpp"
#include "lammps_answer.hpp"
#include "lammps_contacts.hpp"
#include "lammps_script.hpp"
#include "work_folder.hpp"

namespace shakedown {

namespace {

std::string lammps_name() {
  const char* named = std::getenv("SHAKEDOWN_LAMMPS");
  return named == nullptr || *named == '\0' ? "lmp" : named;
}

std::string lammps_program() {
  const std::string name = lammps_name();
  if (const auto file = program_named(name)) return std::filesystem::absolute(*file).string();
  throw InputError({{{},
                     "engine 'lammps'",
                     "there is no program '" + name + "' (LAMMPS is run beside this program)",
                     "install Debian's package lammps, or name yours in the environment variable "
                     "SHAKEDOWN_LAMMPS"}});
}

void check(const Setup& setup) {
  std::vector<Violation> found;
  if (setup.domain == Domain::periodic)
    found.push_back({place_of(setup, "domain.kind"), "domain.kind",
                     "periodic is not modelled by engine 'lammps' (its walls are real ones)",
                     "use engine 'hard' for periodic cells, or domain.kind = \"closed\""});
  if (!(setup.soft.contact_time > 0))
    found.push_back({place_of(setup, "soft.contact_time"), "soft.contact_time",
                     "must be above zero (it sets the stiffness)", "0.3 ms suits the paper's damper"});
  constexpr double fewest = 5;
  if (!(setup.soft.steps_per_contact >= fewest))
    found.push_back({place_of(setup, "soft.steps_per_contact"), "soft.steps_per_contact",
                     fmt::format("{} is too few (below {} the contact is not resolved)",
                                 setup.soft.steps_per_contact, fewest),
                     "use 20, or 50 for impacts whose restitution scatters by less than 0.01"});
  if (!found.empty()) throw InputError(std::move(found));
}

/// Returns what LAMMPS complains about: it writes what is wrong to its standard output, in a line that begins
/// with ERROR, and then the line of the script; libraries that it needs complain to standard error.
std::string complaint(const WorkFolder& folder) {
  const std::string output = contents_of(folder / "output.txt");
  const std::size_t at = output.find("ERROR");
  constexpr std::size_t most = 600;
  const std::string text =
      at == std::string::npos ? end_of(folder / "error.txt", most) : output.substr(at, most);
  return text.empty() ? "it says nothing" : "it says:\n" + text;
}

class LammpsEngine final : public Engine {
 public:
  std::string_view name() const override { return "lammps"; }
  Capability can_model(const EffectRecord& effect) const override { return effect.capability(name()); }

  Trajectory run(const Setup& setup, const RunOptions& options) const override {
    refuse_what_is_not_modelled(*this, setup);
    check(setup);
    const std::string program = lammps_program();
    const auto started = std::chrono::steady_clock::now();
    const Physics physics = physics_of(setup);
    const State initial = initial_state(setup, options.run);
    const LammpsScript script = lammps_script(setup, physics, initial);
    const WorkFolder folder(kept_folder("lammps", options.run));
    folder.write(lammps_script_file, script.text);
    folder.write(lammps_bodies_file, script.bodies);
    if (!script.table.empty()) folder.write(lammps_table_file, script.table);
    for (const char* written : {lammps_motion_file, lammps_end_file, "log.lammps", "output.txt", "error.txt"})
      folder.make_way(written);
    execute(program, folder, lammps_steps(setup), options);
    Trajectory trajectory = lammps_answer(folder, setup, physics, initial, script);
    trajectory.wall_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    return trajectory;
  }

 private:
  static void execute(const std::string& program, const WorkFolder& folder, const LammpsSteps& steps,
                      const RunOptions& options) {
    ChildProgram child;
    child.words = {program, "-in", lammps_script_file, "-log", "log.lammps"};
    child.environment = {"OMP_NUM_THREADS=1"};  // an ensemble has a run on every core already
    child.folder = folder.path();
    child.output = folder / "output.txt";
    child.error = folder / "error.txt";
    child.stop = options.stop;
    if (options.progress) child.now_and_then = [&] { options.progress(lammps_time_so_far(folder, steps)); };
    const ChildEnd end = run_child(child);
    if (end.stopped) throw Interrupted("engine 'lammps': nothing of the run is kept");
    if (end.exit_code != 0 || end.signal != 0)
      throw PhysicsError(
          fmt::format("engine 'lammps': {} {} at t = {:.6g} s; {}\nUse a shorter soft.contact_time where "
                      "bodies are lost; "
                      "--keep DIR keeps the script.",
                      program, in_words(end), lammps_time_so_far(folder, steps), complaint(folder)));
  }
};

}  // namespace

bool has_lammps() { return program_named(lammps_name()).has_value(); }

std::unique_ptr<Engine> make_lammps_engine() { return std::make_unique<LammpsEngine>(); }

}  // namespace shakedown
