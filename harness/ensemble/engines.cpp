// SPDX-License-Identifier: MIT
#include "engines.hpp"

#include <span>

#include "apart_engine.hpp"
#include "bullet_engine.hpp"
#include "command_engine.hpp"
#include "hard_engine.hpp"
#include "lammps_engine.hpp"
#include "soft_engine.hpp"

namespace shakedown {

namespace {

struct NamedEngine {
  const char* name;
  std::unique_ptr<Engine> (*make)();
};

std::span<const NamedEngine> engines() {
  static const std::vector<NamedEngine> list{
      {"hard", make_hard_engine},     {"soft", [] { return make_soft_engine(); }},
      {"bullet", make_bullet_engine}, {"lammps", make_lammps_engine},
      {"apart", make_apart_engine},
  };
  return list;
}

}  // namespace

std::vector<std::string> engine_names() {
  std::vector<std::string> names;
  for (const NamedEngine& engine : engines()) names.emplace_back(engine.name);
  return names;
}

std::unique_ptr<Engine> engine_named(std::string_view name) {
  if (name.starts_with(command_prefix)) return make_command_engine(name);
  std::string known;
  for (const NamedEngine& engine : engines()) {
    if (name == engine.name) return engine.make();
    known += (known.empty() ? "" : ", ") + std::string(engine.name);
  }
  throw InputError({{{},
                     "engine",
                     "there is no engine '" + std::string(name) + "'",
                     "choose one of: " + known + ", or command:PROGRAM"}});
}

}  // namespace shakedown
