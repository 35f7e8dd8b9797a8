// SPDX-License-Identifier: MIT
// Prints single impacts of benchmarks beside ours: the tables of
// bench/results/2026-11-26-referees-of-one-impact.md.
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "published_figures.hpp"
#include "referees.hpp"

using namespace shakedown;

namespace {

/// The engines as columns: hard spheres whose slip friction stops or turns round, soft contacts, Bullet.
struct Column {
  const char *engine, *title;
  double tangential_restitution;
  double stiffness_ratio = ContactLaw::turning_ratio;
};
constexpr std::array columns{Column{"hard", "hard, slip stopped", 0},
                             Column{"hard", "hard, slip turned round", 1}, Column{"soft", "soft", 1},
                             Column{"bullet", "bullet", 0}};
/// A tangential spring of elastic alumina (nu = 0.23).
constexpr double elastic_ratio = 2 * (1 - 0.23) / (2 - 0.23);
constexpr std::array compliant{Column{"hard", "hard, spring of 0.87", 1, elastic_ratio},
                               Column{"soft", "soft, spring of 0.87", 1, elastic_ratio}};

Rebound seen(const Column& column, Encounter it) {
  it.tangential_restitution = column.tangential_restitution;
  it.stiffness_ratio = column.stiffness_ratio;
  it.steps_per_contact = 200;
  return rebound_of(it, impact_by(column.engine, it).motion);
}

std::string number(double value, int digits) {
  char text[32];
  const bool zero = std::abs(value) < 0.5 * std::pow(10, -digits);
  std::snprintf(text, sizeof text, "%.*f", digits, zero ? 0.0 : value);
  return text;
}

void print(const std::vector<std::string>& cells) {
  for (const std::string& cell : cells) std::printf("| %s ", cell.c_str());
  std::printf("|\n");
}

void head(const char* title, std::vector<std::string> cells) {
  std::printf("\n## %s\n\n", title);
  print(cells);
  cells.assign(cells.size(), "---");
  print(cells);
}

void head_with_engines(const char* title, std::vector<std::string> cells) {
  for (const Column& column : columns) cells.emplace_back(column.title);
  head(title, std::move(cells));
}

template <class Show>
void row_with_engines(std::vector<std::string> cells, const Encounter& it, Show&& show) {
  for (const Column& column : columns) cells.push_back(show(seen(column, it)));
  print(cells);
}

void normal_impacts() {
  head("Tests 1 and 2: peak force (kN), deepest overlap (um), duration (us)",
       {"test", "read off: force, duration", "Hertz, closed form", "soft with Hertz's force",
        "soft as it is, its contact time Hertz's"});
  const auto cell = [](double force, double overlap, double duration) {
    return number(force / 1e3, 3) + ", " + number(overlap * 1e6, 2) + ", " + number(duration * 1e6, 2);
  };
  for (const auto& it : published::normal_impacts) {
    Encounter one = impact_of(it);
    const Hertz hertz = hertz_impact(one, it.youngs_modulus, it.poisson_ratio);
    one.contact_time = hertz.duration;
    const Outcome linear = impact_by("soft", one);
    const double rate = std::numbers::pi / one.contact_time, spring = one.reduced_mass() * rate * rate;
    one.hertz_stiffness = hertz.stiffness;
    const Outcome by_hertz = impact_by("soft", one);
    print({it.what, number(it.peak_force / 1e3, 2) + ", " + number(it.duration * 1e6, 1),
           cell(hertz.peak_force, hertz.deepest, hertz.duration),
           cell(hertz.stiffness * std::pow(by_hertz.deepest_overlap, 1.5), by_hertz.deepest_overlap,
                by_hertz.seconds_in_contact),
           cell(spring * linear.deepest_overlap, linear.deepest_overlap, linear.seconds_in_contact)});
  }
}

void restitutions() {
  head_with_engines("Test 3: restitution", {"asked"});
  for (const double e : {0.2, 0.4, 0.6, 0.8, 1.0}) {
    const Encounter it = normal_impact(e);
    row_with_engines({number(e, 1)}, it,
                     [&](const Rebound& r) { return number(r.closing / it.closing(), 5); });
  }
}

void oblique_impacts() {
  head_with_engines("Test 4: tangential velocity after over before, spin (rad/s)",
                    {"angle", "read off", compliant[0].title, compliant[1].title});
  for (const auto& p : published::oblique_impacts) {
    const Encounter it = oblique_impact(p.degrees);
    const double before = it.velocity.dot(place_of(it.partner).tangent);
    const auto cell = [&](const Rebound& r) {
      return number(r.tangential / before, 3) + ", " + number(-r.spin, 0);
    };
    row_with_engines({number(p.degrees, 0), number(p.tangential_restitution, 3) + ", " + number(p.spin, 0),
                      cell(seen(compliant[0], it)), cell(seen(compliant[1], it))},
                     it, cell);
  }
  head_with_engines("Kharaz, Gorham and Salman: angle at which the point of contact leaves",
                    {"angle", "measured", compliant[0].title, compliant[1].title});
  for (const auto& p : published::measured_angles) {
    const auto cell = [](const Rebound& r) { return number(r.contact_degrees, 1); };
    const Encounter it = oblique_impact(p.degrees);
    row_with_engines({number(p.degrees, 1), number(p.contact_degrees, 1), cell(seen(compliant[0], it)),
                      cell(seen(compliant[1], it))},
                     it, cell);
  }
}

void best_constant() {
  const auto error = [](auto&& rebound) {
    double sum = 0;
    int count = 0;
    for (const auto& p : published::measured_angles) {
      if (p.degrees > 32.5) continue;  // beyond, all slide
      sum += std::pow(rebound(oblique_impact(p.degrees)).contact_degrees - p.contact_degrees, 2);
      ++count;
    }
    return std::sqrt(sum / count);
  };
  double best = 0, least = 1e9;
  for (double beta = -1; beta <= 1.001; beta += 0.01) {
    const double off = error([&](const Encounter& it) { return seen({"hard", "", beta}, it); });
    if (off < least) {
      least = off;
      best = beta;
    }
  }
  const auto of = [&](const Column& column) {
    return error([&](const Encounter& it) { return seen(column, it); });
  };
  std::printf(
      "\nBelow 32.5 degrees, root of the mean square from what was measured: hard spheres with their best "
      "tangential restitution, %.2f, %.1f degrees; stopped (0) %.1f; turned round (1) %.1f; soft %.1f; with "
      "a "
      "tangential spring of 0.87 hard %.2f, soft %.2f.\n",
      best, least, of(columns[0]), of(columns[1]), of(columns[2]), of(compliant[0]), of(compliant[1]));
}

/// What a constant can say of a compliant contact: the one that a spring leaves where nothing slides.
void compliances() {
  head("Slip after over slip before, friction 0.3, restitution 0.75",
       {"slip over friction times closing speed", "hard, 2/7", "soft, 2/7", "hard, 0.6", "soft, 0.6",
        "0.6 as a constant", "hard, 0.82", "soft, 0.82", "0.82 as a constant"});
  for (const double scaled : {0.1, 0.3, 0.6, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0}) {
    const double slip = 0.3 * scaled;
    Encounter it =
        meets(Partner::held_wall, std::atan(slip) * 180 / std::numbers::pi, 0.3 * std::hypot(1, slip));
    it.friction = 0.3;
    it.contact_time = 1e-5;
    const auto left = [&](const Column& column) {
      return number(seen(column, it).slip / it.slip().norm(), 3);
    };
    std::vector<std::string> cells{number(scaled, 1), left({"hard", "", 1}), left({"soft", "", 1})};
    for (const double ratio : {0.6, 0.82}) {
      cells.push_back(left({"hard", "", 1, ratio}));
      cells.push_back(left({"soft", "", 1, ratio}));
      const double normal = std::log(it.restitution) / std::numbers::pi;
      cells.push_back(
          left({"hard", "", -std::cos(std::numbers::pi * std::sqrt(3.5 * ratio * (1 + normal * normal)))}));
    }
    print(cells);
  }
}

void scaled_impacts() {
  head_with_engines("Test 5: slip, spin after, over friction times normal speed",
                    {"slip before", "read off"});
  const auto rows = [](const char* who, const auto& points) {
    constexpr double scale = 0.3 * 5;
    for (const auto& p : points)
      row_with_engines({number(p.slip, 2) + who, number(p.slip_after, 2) + ", " + number(p.spin_after, 2)},
                       scaled_impact(p.slip), [&](const Rebound& r) {
                         return number(r.slip / scale, 2) + ", " + number(r.spin * 1e-5 / scale, 2);
                       });
  };
  rows(", steel", published::steel_spheres);
  rows(", finite elements", published::finite_elements);
}

void spinning_impacts() {
  head_with_engines("Tests 6 and 8: slip turned round over slip before",
                    {"angle", "read off: alloy, nylon, on the large sphere"});
  for (const auto& p : published::spinning_impacts) {
    std::vector<std::string> cells{number(p.degrees, 0), number(p.alloy, 3) + ", " + number(p.nylon, 3) +
                                                             ", " + number(p.on_large_sphere, 3)};
    const Encounter plane = spinning_impact(p.degrees), sphere = spinning_impact_on_large(p.degrees);
    for (const Column& column : columns)
      cells.push_back(number(-seen(column, plane).slip / plane.slip().norm(), 3) + ", " +
                      number(-seen(column, sphere).slip / sphere.slip().norm(), 3));
    print(cells);
  }
  head_with_engines("Test 7: spin after, rad/s", {"before, and in the paper"});
  for (const double spin : {0.17, 1.4, 5.5, 22.9})
    row_with_engines({number(spin, 2)}, twin_impact(spin),
                     [](const Rebound& r) { return number(r.spin, 6); });
}

void bounces() {
  head("Bouncing: height of the peak, m",
       {"restitution, bounce", "by impacts (DEM02)", "hard", "by a spring of 5e4 N/m (DEM01)", "soft",
        "5e5 N/m", "soft", "5e6 N/m", "soft"});
  for (const double e : {0.5, 0.7, 0.9, 1.0})
    for (const int bounce : {1, 3}) {
      Fall ball;
      ball.restitution = e;
      ball.bounces = bounce;
      std::vector<std::string> cells{number(e, 1) + ", " + std::to_string(bounce),
                                     number(peak_by_impacts(ball).height, 5),
                                     number(peak_by("hard", ball), 5)};
      for (const double stiffness : {5e4, 5e5, 5e6}) {
        ball.stiffness = stiffness;
        cells.push_back(number(peak_by_spring(ball).height, 5));
        cells.push_back(number(peak_by("soft", ball), 5));
      }
      print(cells);
    }
}

void rolls() {
  head("From slip to roll (DEM04; with backspin): speed over that at the start",
       {"friction, backspin", "half way", "soft", "hard", "when it rolls", "soft", "hard, slip stopped",
        "hard, slip turned round"});
  for (const double friction : {0.1, 0.3, 0.6})
    for (const double backspin : {0.0, 1.0, 2.5, 4.0}) {
      Roll ball{.backspin = backspin, .friction = friction};
      const double slipping = ball.slipping();
      const auto speed = [&](const char* engine, double tangential, double time) {
        ball.tangential_restitution = tangential;
        return number(roll(engine, ball, time).speed / ball.speed, 4);
      };
      print({number(friction, 1) + ", " + number(backspin, 1), number((6 - backspin) / 7, 4),
             speed("soft", 1, slipping / 2), speed("hard", 0, slipping / 2),
             number(ball.rolling_speed() / ball.speed, 4), speed("soft", 1, 3 * slipping),
             speed("hard", 0, 3 * slipping), speed("hard", 1, 3 * slipping)});
    }
}

}  // namespace

int main() {
  normal_impacts();
  restitutions();
  oblique_impacts();
  best_constant();
  compliances();
  scaled_impacts();
  spinning_impacts();
  bounces();
  rolls();
}
