// SPDX-License-Identifier: MIT
#include "command_engine.hpp"

#include <fmt/format.h>

#include <chrono>
#include <sstream>

#include "child_program.hpp"
#include "command_answer.hpp"
#include "command_question.hpp"
#include "initial_state.hpp"
#include "text.hpp"
#include "work_folder.hpp"

namespace shakedown {

namespace {

/// By this exit code the command refuses a setup that it does not model.
constexpr int code_not_modelled = 2;

class CommandEngine final : public Engine {
 public:
  CommandEngine(std::string name, std::vector<std::string> words)
      : name_(std::move(name)), words_(std::move(words)) {}

  std::string_view name() const override { return name_; }
  /// Answers for every effect alike: only the command itself knows, and is asked by running it.
  Capability can_model(const EffectRecord&) const override {
    return {Fidelity::to_stated_error, "as the command models it, which it says when it is run"};
  }

  Trajectory run(const Setup& setup, const RunOptions& options) const override {
    refuse_what_is_not_modelled(*this, setup);
    if (setup.domain == Domain::periodic)
      throw InputError({{place_of(setup, "domain.kind"), "domain.kind",
                         "a command is asked for boxes with walls only, not for periodic cells",
                         "use engine 'hard', or domain.kind = \"closed\""}});
    const auto started = std::chrono::steady_clock::now();
    const Physics physics = physics_of(setup);
    const State initial = initial_state(setup, options.run);
    const WorkFolder folder(kept_folder(std::filesystem::path(words_[0]).filename().string(), options.run));
    folder.write("setup.json", command_question(setup, physics, initial, options.run));
    for (const char* written : {"motion.csv", "output.txt", "error.txt"}) folder.make_way(written);
    execute(folder, setup, options);
    Trajectory trajectory =
        command_answer(folder / "motion.csv", "engine '" + name_ + "'", setup, physics, initial);
    trajectory.engine = name_;
    trajectory.wall_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    return trajectory;
  }

 private:
  void execute(const WorkFolder& folder, const Setup& setup, const RunOptions& options) const {
    ChildProgram child;
    child.words = words_;
    child.words.push_back((folder / "setup.json").string());
    child.words.push_back((folder / "motion.csv").string());
    child.output = folder / "output.txt";
    child.error = folder / "error.txt";
    child.stop = options.stop;
    const ChildEnd end = run_child(child);
    if (end.stopped) throw Interrupted("engine '" + name_ + "': nothing of the run is kept");
    if (end.exit_code == 0 && end.signal == 0) return;
    constexpr std::size_t most = 600;
    const std::string said(trimmed(end_of(folder / "error.txt", most)));
    if (end.exit_code == code_not_modelled)
      throw InputError(
          {{place_of_effects(setup), "engine '" + name_ + "'",
            "refuses this setup (exit code 2): " + (said.empty() ? "it says nothing" : printable(said)),
            "choose another engine with --engine, or a setup that it models"}});
    throw PhysicsError(
        fmt::format("engine '{}': the command {}; standard error: {}\n"
                    "--keep DIR keeps its files.",
                    name_, in_words(end), said.empty() ? "empty" : printable(said)));
  }

  static SourcePlace place_of_effects(const Setup& setup) {
    return setup.effects.empty() ? SourcePlace{} : setup.effects.front().place;
  }

  std::string name_;
  std::vector<std::string> words_;
};

}  // namespace

std::unique_ptr<Engine> make_command_engine(std::string_view name) {
  EXPECT(name.starts_with(command_prefix));
  std::istringstream text{std::string(name.substr(command_prefix.size()))};
  std::vector<std::string> words;
  for (std::string word; text >> word;) words.push_back(word);
  const auto refuse = [&](const std::string& problem) {
    throw InputError(
        {{{},
          "engine '" + printable(name) + "'",
          problem,
          "write command:PROGRAM with a program on the PATH or its path, e.g. command:./my_code"}});
  };
  if (words.empty()) refuse("names no program");
  if (!program_named(words[0]))
    refuse("there is no program '" + printable(words[0]) + "' that may be executed");
  return std::make_unique<CommandEngine>(std::string(name), std::move(words));
}

}  // namespace shakedown
