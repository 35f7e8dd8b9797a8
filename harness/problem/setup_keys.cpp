// SPDX-License-Identifier: MIT
#include "setup_keys.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "quantity.hpp"
#include "toml_string.hpp"

namespace shakedown {

namespace {

template <auto Section, auto Member>
auto& field(Setup& setup) {
  return setup.*Section.*Member;
}
Domain& domain_field(Setup& setup) { return setup.domain; }

constexpr double infinity = std::numeric_limits<double>::infinity();
// No box on a spring is near these. Beyond, doubles do not keep places 1e-12 m apart (1 km), or times and
// energies of a run (the others).
constexpr double longest = 1e3, thinnest = 1e-7;        // m
constexpr double heaviest = 1e9;                        // kg
constexpr double fastest = 1e6;                         // m/s
constexpr double quickest = 1e9;                        // Hz
constexpr double latest = 1e9;                          // s
constexpr double largest_seed = 9.2233720368547748e18;  // TOML's whole numbers end at 2^63 - 1

using S = Setup;
const std::vector<SetupKey>& table() {
  static const std::vector<SetupKey> keys{
      {"domain.kind", &domain_field, "", 0, 0, false,
       "Where the grains live: a box on a spring (damper), a box held still (closed), or a cell without "
       "walls (periodic)."},
      {"box.mass", &field<&S::box, &S::Box::mass>, "g", 0, heaviest, true, "Mass of the box without grains."},
      {"box.length", &field<&S::box, &S::Box::length>, "mm", 0, longest, true,
       "Inner length along the motion."},
      {"box.width", &field<&S::box, &S::Box::width>, "mm", 0, longest, true,
       "Inner widths across, along y and z."},
      {"spring.frequency", &field<&S::spring, &S::Spring::frequency>, "Hz", 0, quickest, true,
       "Frequency of the empty box; the spring constant is M (2 pi f)^2."},
      {"blade.youngs_modulus", &field<&S::blade, &S::Blade::youngs_modulus>, "GPa", 0, infinity, true,
       "Young's modulus of the blade; only for the beam formula that is reported beside the spring constant "
       "used."},
      {"blade.width", &field<&S::blade, &S::Blade::width>, "mm", 0, longest, true,
       "Width of the blade; beam formula only."},
      {"blade.thickness", &field<&S::blade, &S::Blade::thickness>, "mm", 0, longest, true,
       "Thickness of the blade; beam formula only."},
      {"blade.length", &field<&S::blade, &S::Blade::length>, "mm", 0, longest, true,
       "Free length of the blade; beam formula only."},
      {"grains.count", &field<&S::grains, &S::Grains::count>, "", 0, 1e8, false,
       "Number of grains; 0 is the empty box."},
      {"grains.diameter", &field<&S::grains, &S::Grains::diameter>, "mm", thinnest, longest, false,
       "Diameter of a grain."},
      {"grains.mass", &field<&S::grains, &S::Grains::mass>, "g", 0, heaviest, true, "Mass of a grain."},
      {"restitution.grain_grain", &field<&S::restitution, &S::Restitution::grain_grain>, "", 0, 1, false,
       "Coefficient of normal restitution between grains."},
      {"restitution.grain_wall", &field<&S::restitution, &S::Restitution::grain_wall>, "", 0, 1, false,
       "Coefficient of normal restitution of a grain and the box, end walls and side walls."},
      {"release.displacement", &field<&S::release, &S::Release::displacement>, "mm", -longest, longest, false,
       "Displacement at which the box is released at rest."},
      {"release.packing", &field<&S::release, &S::Release::packing>, "", 0, 0, false,
       "Arrangement of the grains at release."},
      {"release.initial_grains", &field<&S::release, &S::Release::initial_grains>, "", 0, 0, false,
       "CSV file id,x,y,z,vx,vy,vz of the grains at release, m and m/s, instead of a packing; relative to "
       "the setup file."},
      {"release.kinetic_energy_fraction", &field<&S::release, &S::Release::kinetic_energy_fraction>, "", 0, 1,
       false, "Kinetic energy of the grains at release as a fraction of the spring's energy (damper)."},
      {"release.grain_speed", &field<&S::release, &S::Release::grain_speed>, "m/s", 0, fastest, false,
       "Root mean square speed of the grains at release in domains without a spring."},
      {"run.duration", &field<&S::run, &S::Run::duration>, "s", 0, latest, true, "Simulated time."},
      {"run.sample_rate", &field<&S::run, &S::Run::sample_rate>, "Hz", 0, quickest, true,
       "Samples recorded per second."},
      {"run.seed", &field<&S::run, &S::Run::seed>, "", 0, largest_seed, false, "Seed of all random numbers."},
      {"hard.wall_elastic_fraction", &field<&S::hard, &S::Hard::wall_elastic_fraction>, "", 0, 1, false,
       "End-wall impacts slower than this times the box's current top speed are elastic."},
      {"hard.pair_elastic_speed", &field<&S::hard, &S::Hard::pair_elastic_speed>, "m/s", 0, fastest, false,
       "Impacts between grains slower than this are elastic; 10 mm/s at least where something presses layers "
       "on walls or impacts give little back."},
      {"hard.wall_elastic_speed", &field<&S::hard, &S::Hard::wall_elastic_speed>, "m/s", 0, fastest, false,
       "End- and side-wall impacts slower than this are elastic; 1 mm/s at least where something presses "
       "layers on walls, grains are unequal or impacts give little back."},
      {"hard.kick_interval", &field<&S::hard, &S::Hard::kick_interval>, "ms", 0, 0.1, true,
       "Drag and formulas act on grains in impulses so far apart; the error is of second order in it, and "
       "beyond a part of a swing they would come too late."},
      {"soft.contact_time", &field<&S::soft, &S::Soft::contact_time>, "ms", 0, infinity, true,
       "Duration of a soft contact: half a period of the contact oscillator."},
      {"soft.steps_per_contact", &field<&S::soft, &S::Soft::steps_per_contact>, "", 5, 1e6, false,
       "Time steps within the contact time, enough to resolve it; need not be whole."},
      {"bullet.defaults", &field<&S::bullet, &S::Bullet::defaults>, "", 0, 0, false,
       "Leave Bullet's solver untouched, to show what that does."},
      {"bullet.time_step", &field<&S::bullet, &S::Bullet::time_step>, "ms", 0, infinity, true,
       "Time step of Bullet's solver."},
  };
  return keys;
}

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;  // Clang before 17 deduces no aggregates

}  // namespace

Packing packing_of(std::string_view name) {
  const auto found = std::find(packing_names.begin(), packing_names.end(), name);
  EXPECT(found != packing_names.end());
  return static_cast<Packing>(found - packing_names.begin());
}

std::span<const SetupKey> setup_keys() { return table(); }

const SetupKey* find_setup_key(std::string_view path) {
  for (const SetupKey& key : table())
    if (key.path == path) return &key;
  return nullptr;
}

std::span<const std::string_view> choices_of(const SetupKey& key) {
  if (std::holds_alternative<Field<Domain>>(key.field)) return domain_names;
  if (std::holds_alternative<Field<Packing>>(key.field)) return packing_names;
  return {};
}

bool is_numeric(const SetupKey& key) {
  return std::holds_alternative<Field<double>>(key.field) ||
         std::holds_alternative<Field<std::array<double, 2>>>(key.field) ||
         std::holds_alternative<Field<int>>(key.field) ||
         std::holds_alternative<Field<std::uint64_t>>(key.field);
}

std::vector<double> numbers_of(const SetupKey& key, const Setup& setup) {
  // one accessor for reading and writing; nothing is written here
  Setup& readable = const_cast<Setup&>(setup);
  return std::visit(
      Overloaded{[&](Field<double> f) { return std::vector{f(readable)}; },
                 [&](Field<std::array<double, 2>> f) {
                   return std::vector{f(readable)[0], f(readable)[1]};
                 },
                 [&](Field<int> f) { return std::vector{static_cast<double>(f(readable))}; },
                 [&](Field<std::uint64_t> f) { return std::vector{static_cast<double>(f(readable))}; },
                 [](auto) { return std::vector<double>{}; }},
      key.field);
}

std::string toml_of(double si, std::string_view unit) {
  return unit.empty() ? write_number(si) : toml_string(write_quantity(si, unit));
}

std::string toml_of(const SetupKey& key, const Setup& setup) {
  Setup& readable = const_cast<Setup&>(setup);
  return std::visit(Overloaded{[&](Field<double> f) { return toml_of(f(readable), key.unit); },
                               [&](Field<std::array<double, 2>> f) {
                                 return "[" + toml_of(f(readable)[0], key.unit) + ", " +
                                        toml_of(f(readable)[1], key.unit) + "]";
                               },
                               [&](Field<int> f) { return std::to_string(f(readable)); },
                               [&](Field<std::uint64_t> f) { return std::to_string(f(readable)); },
                               [&](Field<bool> f) { return std::string(f(readable) ? "true" : "false"); },
                               [&](Field<std::string> f) { return toml_string(f(readable)); },
                               [&](Field<Domain> f) { return toml_string(name_of(f(readable))); },
                               [&](Field<Packing> f) { return toml_string(name_of(f(readable))); }},
                    key.field);
}

}  // namespace shakedown
