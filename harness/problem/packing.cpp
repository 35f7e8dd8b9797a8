// SPDX-License-Identifier: MIT
#include "packing.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <string>

#include "quantity.hpp"
#include "random.hpp"
#include "setup_keys.hpp"

namespace shakedown {

namespace {

/// Throws InputError. `placed`: how many grains the packing holds, 0 when it cannot tell.
[[noreturn]] void does_not_fit(const Setup& setup, std::size_t placed, const std::string& packing) {
  const std::string why =
      placed > 0 ? "holds " + std::to_string(placed) + " in this box" : "leaves overlaps in this box";
  throw InputError(
      {{place_of(setup, "grains.count"), "grains.count",
        std::to_string(setup.grains.count) + " grains do not fit (packing '" + packing + "' " + why + ")",
        "take fewer or smaller grains, a larger box, or another release.packing"}});
}

std::atomic<const std::atomic<bool>*> asked_to_stop{nullptr};

/// Throws InputError when the largest grain drawn does not fit into the box, as the mean one may.
void check_room_of_the_largest(const Setup& setup, const std::vector<double>& radius) {
  const double largest = 2 * *std::max_element(radius.begin(), radius.end());
  const double room = std::min({setup.box.length, setup.box.width[0], setup.box.width[1]});
  if (largest <= room) return;
  const auto in_mm = [](double metres) { return write_quantity(std::round(metres * 1e9) / 1e9, "mm"); };
  throw InputError({{place_of(setup, "grains.diameter"), "grains.diameter",
                     "the largest grain has " + in_mm(largest) + " and does not fit into the box (" +
                         in_mm(room) + " at its narrowest)",
                     "make the box larger, or the grains smaller or less unequal"}});
}

/// Rounds a number of sites in a row down, to 1e9 at most: no packing fills more.
int whole(double number) { return static_cast<int>(std::min(std::floor(number), 1e9)); }

/// Returns cubic-close layers from the outer (+x) wall inwards: alternate sites of a square grid of spacing
/// a/2, a = 1.42 diameters.
std::vector<Vec3> fcc_layers(const Setup& setup) {
  const double diameter = setup.grains.diameter, half_constant = 0.71 * diameter;
  const double front = (setup.box.length - diameter) / 2;
  const auto sites = [&](double width) {
    return whole((width - diameter) / half_constant * (1 + 1e-12)) + 1;
  };
  const int rows = sites(setup.box.width[0]), columns = sites(setup.box.width[1]);
  const double first_y = -half_constant * (rows - 1) / 2, first_z = -half_constant * (columns - 1) / 2;
  const std::size_t count = static_cast<std::size_t>(setup.grains.count);
  std::vector<Vec3> centres;
  for (int layer = 0; centres.size() < count; ++layer) {
    const double x = front - 10e-6 - layer * half_constant;
    if (x < -front) does_not_fit(setup, centres.size(), "fcc");
    for (int i = 0; i < rows && centres.size() < count; ++i) {
      expect_packing_goes_on();
      for (int j = 0; j < columns && centres.size() < count; ++j)
        if ((i + j + layer) % 2 == 0)
          centres.emplace_back(x, first_y + i * half_constant, first_z + j * half_constant);
    }
  }
  return centres;
}

/// Returns square layers, n x n and (n-1) x (n-1) in turn, with 1.1 diameters from grain to grain and 0.65
/// diameters from layer to layer. Where only one grain fits across, every other layer is empty, as there is
/// no place between the others.
std::vector<Vec3> square_layers(const Setup& setup) {
  const double diameter = setup.grains.diameter, spacing = 1.1 * diameter;
  const double front = (setup.box.length - diameter) / 2;
  const auto sites = [&](double width) { return whole((width - diameter) / spacing * (1 + 1e-12)) + 1; };
  const int rows = sites(setup.box.width[0]), columns = sites(setup.box.width[1]);
  const std::size_t count = static_cast<std::size_t>(setup.grains.count);
  std::vector<Vec3> centres;
  for (int layer = 0; centres.size() < count; ++layer) {
    const double x = front - 0.01 * diameter - layer * 0.65 * diameter;
    if (x < -front) does_not_fit(setup, centres.size(), "square");
    const int shrink = layer % 2;
    const int r = rows - shrink, c = columns - shrink;
    for (int i = 0; i < r && centres.size() < count; ++i) {
      expect_packing_goes_on();
      for (int j = 0; j < c && centres.size() < count; ++j)
        centres.emplace_back(x, spacing * (i - (r - 1) / 2.0), spacing * (j - (c - 1) / 2.0));
    }
  }
  return centres;
}

std::vector<Vec3> random_centres(const Setup& setup, double thickness, int run) {
  Random random(setup.run.seed, static_cast<std::uint64_t>(run), Stream::packing);
  const double diameter = setup.grains.diameter, front = (setup.box.length - diameter) / 2;
  std::vector<Vec3> centres(static_cast<std::size_t>(setup.grains.count));
  for (Vec3& centre : centres) {
    expect_packing_goes_on();
    centre.x() = front - 10e-6 - random.uniform() * thickness;
    centre.y() = (random.uniform() - 0.5) * (setup.box.width[0] - diameter);
    centre.z() = (random.uniform() - 0.5) * (setup.box.width[1] - diameter);
  }
  return centres;
}

/// Sites of a face-centred cubic lattice of cells[0] x cells[1] x cells[2] cubes, stretched to a room about
/// the origin.
struct Lattice {
  Eigen::Vector3i cells;
  Vec3 room;

  std::int64_t size() const { return 4LL * cells.x() * cells.y() * cells.z(); }
  /// Returns the place of a site, m: those of a cell follow each other, cells along z first.
  Vec3 site(std::int64_t index) const {
    constexpr std::array<std::array<double, 3>, 4> basis{
        {{.25, .25, .25}, {.75, .75, .25}, {.75, .25, .75}, {.25, .75, .75}}};
    const std::array<double, 3>& in_cell = basis[static_cast<std::size_t>(index % 4)];
    const std::int64_t cell = index / 4, column = cell / cells.z(), layer = column / cells.y();
    const Vec3 corner(static_cast<double>(layer), static_cast<double>(column % cells.y()),
                      static_cast<double>(cell % cells.z()));
    return -room / 2 + room.cwiseQuotient(cells.cast<double>())
                           .cwiseProduct(corner + Vec3(in_cell[0], in_cell[1], in_cell[2]));
  }
};

/// Returns the room of the centres in a closed or periodic cell, m along each axis.
Vec3 room_of_cell(const Setup& setup) {
  const double margin = setup.domain == Domain::closed ? setup.grains.diameter : 0.0;
  return Vec3(setup.box.length, setup.box.width[0], setup.box.width[1]).array() - margin;
}

/// Returns the sites of a face-centred cubic lattice that fills a whole cell (closed and periodic domains).
std::vector<Vec3> filled_cell(const Setup& setup) {
  const std::size_t count = static_cast<std::size_t>(setup.grains.count);
  const Vec3 room = room_of_cell(setup);
  if (room.minCoeff() <= 0) does_not_fit(setup, 0, "fcc, stretched to the cell");
  const double per_length = std::cbrt(static_cast<double>(count) / 4 / room.prod());
  Eigen::Vector3i cells;
  for (int axis = 0; axis < 3; ++axis)
    cells[axis] = std::max(1, static_cast<int>(std::ceil(per_length * room[axis] - 1e-9)));
  while (Lattice{cells, room}.size() < static_cast<std::int64_t>(count)) ++cells.x();
  const Lattice lattice{cells, room};
  std::vector<Vec3> centres(count);
  for (std::size_t i = 0; i < count; ++i) {
    expect_packing_goes_on();
    centres[i] = lattice.site(static_cast<std::int64_t>(i));
  }
  // every site of a lattice sees what the first one sees
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < centres.size(); ++i)
    nearest = std::min(nearest, (centres[i] - centres[0]).squaredNorm());
  if (nearest < setup.grains.diameter * setup.grains.diameter)
    does_not_fit(setup, 0, "fcc, stretched to the cell");
  return centres;
}

/// Draws `count` different ones of so many places and returns them in order.
std::vector<std::int64_t> drawn_places(std::int64_t places, std::int64_t count, Random& random) {
  constexpr std::int64_t most_walked = 10'000'000;  // a tenth of a second
  std::vector<std::int64_t> drawn;
  if (places <= std::max(most_walked, 100 * count)) {
    // Each is kept with the probability of places still wanted over places left.
    for (std::int64_t place = 0, left = count; left > 0; ++place) {
      expect_packing_goes_on();
      if (random.uniform() * static_cast<double>(places - place) < static_cast<double>(left))
        drawn.push_back(place), --left;
    }
    return drawn;
  }
  std::set<std::int64_t> different;
  while (std::ssize(different) < count) {
    expect_packing_goes_on();
    different.insert(static_cast<std::int64_t>(random.uniform() * static_cast<double>(places)));
  }
  drawn.assign(different.begin(), different.end());
  return drawn;
}

/// Returns sites drawn at random from a lattice of packing fraction 0.70 (or a little less): full of
/// vacancies, it melts within a few impacts a grain even where the full lattice is stable.
std::vector<Vec3> sparsely_filled_cell(const Setup& setup, int run) {
  const std::int64_t count = setup.grains.count;
  const Vec3 room = room_of_cell(setup);
  const double constant = std::cbrt(4 * 0.5236 / 0.70) * setup.grains.diameter;
  constexpr double most_cells = 65536;  // along an edge: so that sites are counted without rounding
  const Lattice lattice{(room / constant).array().floor().min(most_cells).cast<int>().max(1), room};
  if (lattice.size() < count || room.minCoeff() < constant)
    does_not_fit(setup, static_cast<std::size_t>(lattice.size()), "random");
  // The order of the lattice stays, so neighbours are near in memory.
  Random random(setup.run.seed, static_cast<std::uint64_t>(run), Stream::packing);
  std::vector<Vec3> centres;
  for (const std::int64_t place : drawn_places(lattice.size(), count, random)) {
    expect_packing_goes_on();
    centres.push_back(lattice.site(place));
  }
  return centres;
}

/// Pushes overlapping grains apart and back into the box until none overlap; false when 20 000 sweeps do not
/// reach that.
bool relax(const Setup& setup, const std::vector<double>& radius, std::vector<Vec3>& centres) {
  const Vec3 half(setup.box.length / 2, setup.box.width[0] / 2, setup.box.width[1] / 2);
  const double clearance = 1e-3 * setup.grains.diameter;
  for (int sweep = 0; sweep < 20000; ++sweep) {
    bool overlapping = false;
    for (std::size_t i = 0; i < centres.size(); ++i) {
      expect_packing_goes_on();
      for (std::size_t j = i + 1; j < centres.size(); ++j) {
        const Vec3 apart = centres[i] - centres[j];
        const double reach = radius[i] + radius[j], distance = apart.norm();
        if (distance >= reach + clearance / 10) continue;
        overlapping = true;
        const Vec3 shift = apart / std::max(distance, 1e-12) * ((reach + clearance - distance) / 2);
        centres[i] += shift;
        centres[j] -= shift;
      }
      // a box hardly wider than the grain leaves less than this margin
      const Vec3 room = (half.array() - radius[i] - 1e-6).max(0);
      const Vec3 inside = centres[i].cwiseMin(room).cwiseMax(-room);
      overlapping = overlapping || inside != centres[i];  // perhaps into another
      centres[i] = inside;
    }
    if (!overlapping) return true;
  }
  return false;
}

bool free_of_overlap(const Setup& setup, const std::vector<double>& radius,
                     const std::vector<Vec3>& centres) {
  const bool periodic = setup.domain == Domain::periodic;
  const Vec3 cell(setup.box.length, setup.box.width[0], setup.box.width[1]);
  for (std::size_t i = 0; i < centres.size(); ++i) {
    expect_packing_goes_on();
    if (!periodic && ((cell / 2 - centres[i].cwiseAbs()).array() < radius[i]).any()) return false;
    for (std::size_t j = i + 1; j < centres.size(); ++j) {
      Vec3 apart = centres[i] - centres[j];
      for (int axis = 0; periodic && axis < 3; ++axis) apart[axis] = std::remainder(apart[axis], cell[axis]);
      if (apart.norm() < radius[i] + radius[j]) return false;
    }
  }
  return true;
}

/// Returns the centres as each packing places grains of the mean diameter, before anything is relaxed.
std::vector<Vec3> placed_centres(const Setup& setup, Packing packing, int run) {
  if (setup.domain != Domain::damper)
    return packing == Packing::random ? sparsely_filled_cell(setup, run) : filled_cell(setup);
  const double diameter = setup.grains.diameter;
  switch (packing) {
    case Packing::fcc: return fcc_layers(setup);
    case Packing::square: return square_layers(setup);
    case Packing::random: {
      // A layer of volume fraction 0.31, the loosest that relaxes at once and still lies against the wall.
      const double area = (setup.box.width[0] - diameter) * (setup.box.width[1] - diameter);
      const double volume = setup.grains.count * std::pow(diameter, 3) * 0.5236;
      const double thickness = std::min(setup.box.length - diameter - 20e-6, volume / area / 0.31 * 0.8);
      return random_centres(setup, thickness, run);
    }
    case Packing::spread: return random_centres(setup, setup.box.length - diameter - 20e-6, run);
  }
  EXPECT(false && "every packing is listed above");
  return {};
}

}  // namespace

void expect_packing_goes_on() {
  const std::atomic<bool>* asked = asked_to_stop.load(std::memory_order_relaxed);
  if (asked != nullptr && asked->load(std::memory_order_relaxed))
    throw Interrupted("the grains were not packed yet");
}

void stop_packing_when(const std::atomic<bool>* asked) { asked_to_stop = asked; }

std::vector<Vec3> packed_centres(const Setup& setup, Packing packing, const std::vector<double>& radius,
                                 int run) {
  if (setup.grains.count == 0) return {};
  check_room_of_the_largest(setup, radius);
  std::vector<Vec3> centres = placed_centres(setup, packing, run);
  // True when all grains have the size that the packing assumes.
  const double usual = setup.grains.diameter / 2;
  const bool equal = std::all_of(radius.begin(), radius.end(), [=](double r) { return r == usual; });
  const bool damper = setup.domain == Domain::damper;
  const bool lattice = !damper || packing == Packing::fcc || packing == Packing::square;
  // Lattices of equal grains are free of overlap by construction: large systems skip the check of all pairs.
  if (lattice && equal) return centres;
  // In other domains the hard engine's own check, through neighbours, covers large systems.
  constexpr std::size_t all_pairs_up_to = 20000;
  if (!damper && centres.size() > all_pairs_up_to) return centres;
  const auto is_free = [&] { return free_of_overlap(setup, radius, centres); };
  if (!is_free() && !(damper && relax(setup, radius, centres) && is_free()))
    does_not_fit(setup, 0, std::string(name_of(packing)));
  return centres;
}

}  // namespace shakedown
