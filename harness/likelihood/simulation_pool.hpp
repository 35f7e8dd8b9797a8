// SPDX-License-Identifier: MIT
// Keeps simulations that were made already: rounds of a fit, and later fits of the same model, learn from all
// of them. Where parameters are known only together (the two restitutions), the solution of a single round
// would be left to its emulators' noise.
#pragma once
#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

namespace shakedown {

/// Holds one simulation.
struct PooledRun {
  Eigen::VectorXd values;                 ///< of the knobs, SI
  std::vector<Eigen::VectorXd> features;  ///< m, of each measured run that shares the setup
};

/// Simulations by the name of their model: setup, names of the knobs and measured runs (model_name in
/// emulator.cpp).
using SimulationPool = std::map<std::string, std::vector<PooledRun>>;

}  // namespace shakedown
