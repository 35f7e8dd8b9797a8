// SPDX-License-Identifier: MIT
// Prints what grains in a shaken box lose about the amplitude where they stop going as one: the tables of
// bench/results/2026-11-27-shaken-box.md.
#include <cstdio>
#include <vector>

#include "shaken_box.hpp"

using namespace shakedown;

namespace {

void table(const char* title, ShakenBox box) {
  std::printf("\n## %s\n\n| A/L_g | collected | hard | soft |\n|---|---|---|---|\n", title);
  for (const double ratio : {0.15, 0.2, 0.25, 0.28, 0.3, 0.31, 0.32, 0.33, 0.35, 0.4, 0.5, 0.7, 1.0, 1.5}) {
    box.amplitude = ratio * box.clearance;
    std::printf("| %.2f | %.2f%s ", ratio, collected_loss(1 / ratio), ratio < 1 / 3.14159265 ? " *" : "");
    for (const char* engine : {"hard", "soft"}) {
      const ShakenLoss loss = loss_of(engine, box);
      std::printf("| %.2f +- %.2f ", loss.mean, loss.spread);
      std::fflush(stdout);
    }
    std::printf("|\n");
  }
}

}  // namespace

int main() {
  table("A column of 10 grains, restitution 0.5", {});
  ShakenBox damper;
  damper.grains = 37;
  damper.width = 0.05;
  damper.thickness = 0.02;  // as the paper on the damper takes it
  damper.clearance = 0.045;
  damper.frequency = 1.23;
  damper.restitution = 0.76;
  damper.settling = 10;
  damper.periods = 20;
  table("37 grains of 10 mm in a box of 50 x 50 x 65 mm, restitution 0.76", damper);
}
