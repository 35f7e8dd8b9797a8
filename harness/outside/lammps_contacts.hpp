// SPDX-License-Identifier: MIT
// Contacts and the attraction beside them in the words of LAMMPS: grains of one size, walls of one kind.
#pragma once
#include <string>
#include <vector>

#include "damper_state.hpp"
#include "physics.hpp"

namespace shakedown {

class LammpsContacts {
 public:
  /// There must be grains. `held`: the box does not move. Setup and physics must outlive it.
  LammpsContacts(const Setup& setup, const Physics& physics, const State& initial, bool held);

  /// Returns "hooke k gamma damping velocity tangential ...", as pair_coeff and fix wall/gran/region take it.
  std::string law(ContactClass kind) const;
  /// Returns lines of the script that say what the laws are, for people.
  std::vector<std::string> remarks() const;
  /// Returns the lines pair_style and pair_coeff.
  std::vector<std::string> pairs() const;
  /// Returns the contents of the file of pair_style table that `pairs` names; empty without attraction.
  std::string table() const;
  /// Returns the lines that pull grains to the two walls across `axis`, 0 to 2; none where walls do not
  /// attract.
  std::vector<std::string> walls_pull(int axis) const;

 private:
  /// Returns the mass with which two bodies in such a contact meet, kg.
  double reduced_mass(ContactClass kind) const;
  /// Return the words for the normal force: of the spring and dashpot, or of the law of an effect.
  std::string normal(ContactClass kind) const;
  std::string hertz(ContactClass kind) const;

  const Setup& setup_;
  const Physics& physics_;
  double mass_, radius_;
  bool held_;
};

/// The name of the file.
constexpr const char* lammps_table_file = "attraction.table";

}  // namespace shakedown
