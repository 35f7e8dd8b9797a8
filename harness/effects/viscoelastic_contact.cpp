// SPDX-License-Identifier: MIT
#include "viscoelastic_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace shakedown {

namespace {

struct Contact {
  double depth, speed;
};

/// Returns d/ds of the contact with time = s^2, in which the motion starts smoothly (depth^(1/2) has no slope
/// at touch in the time itself).
Contact slope(double s, const Contact& c, double b) {
  const double root = std::sqrt(std::max(c.depth, 0.0));
  return {2 * s * c.speed, -2 * s * root * (c.depth + b * c.speed)};
}

struct Step {
  Contact end;
  double error;
};

/// Takes one step of Dormand and Prince's pair of orders 5 and 4.
Step stepped(double s, const Contact& c, double h, double b) {
  constexpr std::array<std::array<double, 6>, 6> a{
      {{1. / 5},
       {3. / 40, 9. / 40},
       {44. / 45, -56. / 15, 32. / 9},
       {19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729},
       {9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656},
       {35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84}}};
  constexpr std::array<double, 6> node{1. / 5, 3. / 10, 4. / 5, 8. / 9, 1, 1};
  constexpr std::array<double, 7> difference{71. / 57600,      0,         -71. / 16695, 71. / 1920,
                                             -17253. / 339200, 22. / 525, -1. / 40};
  std::array<Contact, 7> k{slope(s, c, b)};
  Contact at = c;
  for (std::size_t i = 0; i < 6; ++i) {
    at = c;
    for (std::size_t j = 0; j <= i; ++j)
      at = {at.depth + h * a[i][j] * k[j].depth, at.speed + h * a[i][j] * k[j].speed};
    k[i + 1] = slope(s + node[i] * h, at, b);
  }
  Contact error{0, 0};
  for (std::size_t j = 0; j < 7; ++j)
    error = {error.depth + h * difference[j] * k[j].depth, error.speed + h * difference[j] * k[j].speed};
  return {at, std::max(std::abs(error.depth), std::abs(error.speed))};
}

bool over(const Contact& c, double b) { return c.speed < 0 && c.depth + b * c.speed <= 0; }

constexpr int intervals = 600;
constexpr double largest_root = 6;  // of b: restitution 3e-3

std::vector<double> tabulated() {
  std::vector<double> table;
  for (int i = 0; i <= intervals; ++i) {
    const double root = largest_root * i / intervals;
    table.push_back(solved_viscoelastic_restitution(root * root));
  }
  return table;
}

}  // namespace

double solved_viscoelastic_restitution(double b) {
  if (b == 0) return 1;
  constexpr double tolerance = 1e-14;
  double s = 0, h = 0.01;
  Contact contact{0, 1};
  while (true) {
    const Step step = stepped(s, contact, h, b);
    const double factor = std::clamp(0.9 * std::pow(tolerance / (step.error + 1e-300), 0.2), 0.2, 3.0);
    if (step.error > tolerance && h > 1e-9) {
      h *= factor;
      continue;
    }
    if (over(step.end, b)) break;
    s += h;
    contact = step.end;
    h *= factor;
  }
  double low = 0, high = h;  // the end of the contact lies within this step
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (over(stepped(s, contact, middle, b).end, b) ? high : low) = middle;
  }
  return -stepped(s, contact, high, b).end.speed;
}

double viscoelastic_restitution(double b) {
  static const std::vector<double> table = tabulated();
  const double root = std::sqrt(b);
  // asymptote
  if (root >= largest_root) return table.back() * std::pow(b / (largest_root * largest_root), -5.0 / 3);
  // Six points of Lagrange in the root of b, in which the restitution is smooth.
  constexpr int points = 6;
  const double place = root / largest_root * intervals;
  const int first = std::clamp(static_cast<int>(place) - 2, 0, intervals + 1 - points);
  double sum = 0;
  for (int i = 0; i < points; ++i) {
    double weight = 1;
    for (int j = 0; j < points; ++j)
      if (j != i) weight *= (place - first - j) / (i - j);
    sum += weight * table[static_cast<std::size_t>(first + i)];
  }
  return sum;
}

double viscoelastic_damping(double restitution) {
  double low = 0, high = largest_root;  // in the root of b; the restitution falls with it
  if (restitution >= 1) return 0;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (viscoelastic_restitution(middle * middle) > restitution ? low : high) = middle;
  }
  return low * low;
}

}  // namespace shakedown
