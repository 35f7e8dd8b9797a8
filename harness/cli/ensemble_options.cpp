// SPDX-License-Identifier: MIT
#include "ensemble_options.hpp"

#include <charconv>
#include <cmath>

#include "work_folder.hpp"

namespace shakedown {

CLI::Validator positive_number() {
  return {[](std::string& text) -> std::string {
            double value = 0;
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
            const bool whole = error == std::errc{} && end == text.data() + text.size();
            if (whole && std::isfinite(value) && value > 0) return {};
            return "'" + text + "' is not a positive number; write one, e.g. 0.5";
          },
          "POSITIVE"};
}

void add_seed_option(CLI::App& command, std::uint64_t& seed, const std::string& words) {
  command.add_option("--seed", seed, words)
      ->check(CLI::Validator(
          [](std::string& text) -> std::string {
            std::int64_t value = 0;  // TOML's whole numbers end where these do
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
            if (error == std::errc{} && end == text.data() + text.size() && value >= 0) return {};
            return "'" + text + "' is not a seed; write a whole number from 0 to 9223372036854775807";
          },
          ""))
      ->type_name("N")
      ->capture_default_str();
}

void add_threads_option(CLI::App& command, int& threads, const std::string& words) {
  command.add_option("--threads", threads, words)
      ->check(CLI::Range(0, 1024))
      ->type_name("T")
      ->capture_default_str();
}

void add_simulations_option(CLI::App& command, int& count, int fewest, const std::string& words) {
  command.add_option("--runs", count, words)
      ->check(CLI::Range(fewest, 100000))
      ->type_name("N")
      ->capture_default_str();
}

void add_keep_option(CLI::App& command) {
  command
      .add_option_function<std::string>(
          "--keep", [](const std::string& folder) { keep_outside_files(folder); },
          "leave what lammps or command:PROGRAM are given and answer in this folder, lammps/run_0 and so on; "
          "without it they are removed")
      ->type_name("DIR");
}

}  // namespace shakedown
