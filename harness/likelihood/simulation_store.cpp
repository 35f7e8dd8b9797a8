// SPDX-License-Identifier: MIT
#include "simulation_store.hpp"

#include "setup_file.hpp"

namespace shakedown {

SimulationJournal::Features SimulationStore::find_or_simulate(
    const SimulationAsked& asked, const std::vector<ReadOff>& read,
    const std::function<Recording()>& simulate) const {
  std::string name;
  if (journal) {
    name = std::string(asked.engine) + ' ' + digest(asked.setup) + ' ' + std::to_string(asked.run);
    for (const ReadOff& one : read) name += ' ' + one.run;
    if (auto kept = journal->find(name)) return std::move(*kept);
  }
  const auto recording = recordings ? recordings->recording(asked.setup, asked.run, simulate)
                                    : std::make_shared<const Recording>(simulate());
  SimulationJournal::Features features;
  for (const ReadOff& one : read) features.push_back(simulated_features(*one.plan, *recording));
  if (journal) journal->keep(name, features);
  return features;
}

}  // namespace shakedown
