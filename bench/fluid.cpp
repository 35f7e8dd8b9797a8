// SPDX-License-Identifier: MIT
// Elastic spheres in a periodic cube, molten: million impacts per CPU second, and where the spheres are, for
// other codes (bench/beside_edmd).
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <string>

#include "fluid.hpp"
#include "hard_sphere_system.hpp"

namespace {

/// Seconds of CPU that this process has used.
double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Writes the spheres as EDMD reads them: their number, the cube's edges, and of each a letter, x, y, z and
/// its radius, in diameters.
void write_sph(const shakedown::State& state, double edge, const std::string& path) {
  std::ofstream file(path);
  file << std::setprecision(17) << state.size() << '\n' << edge << ' ' << edge << ' ' << edge << "\n";
  for (const auto& place : state.position)
    file << "a " << place.x() << ' ' << place.y() << ' ' << place.z() << " 0.5\n";
}

}  // namespace

int main(int count, char** words) {
  if (count < 4) {
    std::cerr << "usage: bench_fluid GRAINS PERCENT IMPACTS_A_GRAIN [FILE.sph]\n";
    return 2;
  }
  const int grains = std::atoi(words[1]), percent = std::atoi(words[2]);
  const std::int64_t impacts = std::atoll(words[3]) * grains;
  shakedown::HardSphereSystem system = shakedown::molten_fluid(grains, percent / 100.0);
  if (count > 4) {
    write_sph(system.state(), shakedown::periodic_fluid(grains, percent / 100.0).box.length, words[4]);
    return 0;
  }
  const double begin = cpu_seconds();
  system.advance_impacts(impacts);
  std::cout << static_cast<double>(impacts) / (cpu_seconds() - begin) / 1e6 << '\n';
}
