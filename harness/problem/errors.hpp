// SPDX-License-Identifier: MIT
// Three kinds of error, never mixed: the user's input, a promise of the physics that an engine cannot keep,
// our own bug.
#pragma once
#include <stdexcept>
#include <string>
#include <vector>

#include "expect.hpp"

namespace shakedown {

/// Where in a file something stands; line and column count from 1, 0 when unknown.
struct SourcePlace {
  std::string file;
  int line = 0;
  int column = 0;
};

/// One thing that is wrong with an input: "place: key: problem (why). remedy".
struct Violation {
  SourcePlace place;
  std::string key;      ///< e.g. "box.mass"; may be empty
  std::string problem;  ///< what is wrong, and why in parentheses
  std::string remedy;   ///< what to do
};
/// Returns the violation as one line.
std::string to_string(const Violation& violation);

/// The user's input: every violation at once. Exit code 2.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Violation> found);
  std::vector<Violation> violations;
};

/// A file that cannot be read or written. Exit code 4.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An engine cannot keep its promise (overlap, open ledger, endless collisions). Exit code 3.
class PhysicsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Stopped on request (Ctrl-C) before anything could be kept. Exit code 130.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A limit of simulations or of time is reached: what was begun gives no result, what was found stands.
class BudgetSpent : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace shakedown
