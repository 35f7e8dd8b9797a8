// SPDX-License-Identifier: MIT
#include <string>

#include "effects.hpp"
#include "experiment_file.hpp"
#include "formula.hpp"
#include "import_tables.hpp"
#include "initial_state.hpp"
#include "measurement.hpp"
#include "output_file.hpp"
#include "quantity.hpp"
#include "scratch_folder.hpp"
#include "setup_file.hpp"
#include "sweep_axis.hpp"
#include "target_reads.hpp"

namespace shakedown {

namespace {

/// The bytes as a file.
std::filesystem::path as_file(const ScratchFolder& folder, const char* name, std::string_view bytes) {
  write_file(folder / name, bytes);
  return folder / name;
}

}  // namespace

void read_as_setup(std::string_view bytes) {
  const Setup setup = parse_setup(bytes, "fuzz.toml", all_effects());
  const std::string text = write_setup(setup);
  const Setup back = parse_setup(text, "again.toml", all_effects());
  EXPECT(write_setup(back) == text);
  if (setup.release.initial_grains.empty()) EXPECT(digest(back) == digest(setup));
}

void read_as_experiment(std::string_view bytes) {
  const Experiment experiment =
      parse_experiment(bytes, "experiment.toml", FUZZ_CORPUS "/experiment_tables", all_effects());
  (void)digest(experiment);
  const Measurement measurement = measurement_of(Setup{}, experiment, all_effects());
  (void)all_notes(measurement);
}

void read_as_film(std::string_view bytes) {
  static const ScratchFolder folder;
  as_file(folder, "film.csv", bytes);
  const std::string_view experiment =
      "[camera]\nframe_rate = \"100 Hz\"\n[column.time]\nfrom = \"t_s\"\nunit = "
      "\"s\"\n[column.box_position]\n"
      "from = \"x_box_m\"\nunit = \"m\"\n[column.grain_centre]\nfrom = \"x_com_m\"\nunit = \"m\"\n[[run]]\n"
      "file = \"film.csv\"\nbox_length = \"40 mm\"\n";
  const Measurement measurement = measurement_of(
      Setup{}, parse_experiment(experiment, "experiment.toml", folder, all_effects()), all_effects());
  (void)all_notes(measurement);
}

void read_as_table(std::string_view bytes) {
  static const ScratchFolder folder;
  const std::filesystem::path file = as_file(folder, "table.csv", bytes);
  const ImportedTables found = import_tables({file}, folder, {"240 Hz", "0.25 mm", "640 px", {"40 mm"}});
  // What import writes, a command reads: any complaint names the table, not the file that import wrote.
  const Experiment experiment = parse_experiment(found.experiment, "imported.toml", folder, all_effects());
  (void)digest(experiment);
}

void read_as_curve(std::string_view bytes) {
  static const ScratchFolder folder;
  as_file(folder, "curve.csv", bytes);
  const Setup setup = parse_setup("[[effect]]\nname = \"user_force\"\ntable = \"curve.csv\"\n", "fuzz.toml",
                                  all_effects(), {}, folder.path());
  // The setup holds the points: it needs the table no more.
  const Setup back = parse_setup(write_setup(setup), "again.toml", all_effects());
  EXPECT(digest(back) == digest(setup));
}

void read_as_formula(std::string_view bytes) {
  try {
    const Formula formula(std::string(bytes), {{"k", 1.5}, {"x0", 0.1}});
    const Formula copy(formula);
    for (const double x : {0.0, 0.1, -1e9})
      for (const double v : {0.0, -3.0}) {
        const double here = formula(x, v, 0.5), there = copy(x, v, 0.5);
        EXPECT(here == there || (here != here && there != there));
      }
    (void)formula.uses("x");
  } catch (const FormulaProblem& problem) {
    EXPECT(problem.position <= bytes.size() + 1 && !problem.problem.empty());
  }
}

void read_as_grains(std::string_view bytes) {
  static const ScratchFolder folder;
  Setup setup;
  setup.grains.count = 4;
  setup.release.initial_grains = as_file(folder, "grains.csv", bytes).string();
  const State state = initial_state(setup);
  EXPECT(state.size() == 4);
  (void)kinetic_energy(state, setup.box.mass);
}

void read_as_words(std::string_view bytes) {
  const ValueOrReason<Quantity> quantity = parse_quantity(bytes);
  if (const Quantity* found = std::get_if<Quantity>(&quantity)) (void)describe(found->dimension);
  (void)parse_unit(bytes);
  const std::string text(bytes);
  const auto tried = [](const auto& work) {
    try {
      work();
    } catch (const InputError&) {
    }
  };
  tried([&] { (void)parse_axis(text, all_effects()); });
  tried([&] {
    const Override word = parse_override(text);
    (void)with_overrides(Setup{}, {&word, 1}, all_effects());
  });
}

}  // namespace shakedown
