// SPDX-License-Identifier: MIT
#include "ensemble_options.hpp"

namespace shakedown {

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

}  // namespace shakedown
