// SPDX-License-Identifier: MIT
// One hash of all that a run gives, whatever compiler built the program and however many threads ran it. What
// changes a hash changes results: say so in CHANGELOG.md, then write the new hash here.
#include <gtest/gtest.h>

#include <bit>
#include <string>
#include <vector>

#include "effects.hpp"
#include "engines.hpp"
#include "ensemble.hpp"
#include "fnv.hpp"
#include "series_file.hpp"
#include "setup_file.hpp"

using namespace shakedown;

namespace {

struct Case {
  const char* name;
  const char* engine;
  const char* text;    ///< of the setup
  std::uint64_t hash;  ///< of three runs
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class Hash {
 public:
  void add(double number) { value_ = fnv_step(value_, std::bit_cast<std::uint64_t>(number)); }
  void add(const std::vector<double>& numbers) {
    for (const double number : numbers) add(number);
  }
  void add(const std::vector<Vec3>& vectors) {
    for (const Vec3& vector : vectors)
      for (int axis = 0; axis < 3; ++axis) add(vector[axis]);
  }
  void add(const std::string& bytes) { value_ = fnv1a(bytes, value_); }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = fnv_start;
};

void add(Hash& hash, const Trajectory& run) {
  hash.add(series_csv(run));
  for (const auto* numbers : {&run.time, &run.x_box, &run.v_box, &run.x_com, &run.total_energy})
    hash.add(*numbers);
  for (std::size_t c = 0; c < contact_classes; ++c) {
    hash.add(run.loss[c]);
    hash.add(run.ledger.contact_loss[c]);
    hash.add(static_cast<double>(run.collisions[c]));
  }
  hash.add(run.ledger.effect_loss);
  hash.add(run.end_state.position);
  hash.add(run.end_state.velocity);
  hash.add(run.end_state.spin);
  if (run.collision_log)
    hash.add(std::string(run.collision_log->events.begin(), run.collision_log->events.end()));
}

std::uint64_t hash_of(const Case& c, int threads) {
  EnsembleOptions options;
  options.runs = 3;
  options.execution.threads = threads;
  options.keep_samples = true;
  options.log_collisions = true;
  const shakedown::Setup setup =
      parse_setup(std::string("[run]\nsample_rate = \"100 Hz\"\n") + c.text, "bytes.toml", all_effects());
  Hash hash;
  const Ensemble made = run_ensemble(*engine_named(c.engine), setup, options);
  for (const RunResult& run : made.runs) add(hash, run.trajectory);
  EXPECT_EQ(made.runs.size(), 3u);
  return hash.value();
}

/// The C library chooses its sin, cos and log by the processor: those of processors with fused
/// multiply-add differ in the last place from those without.
bool is_a_processor_of_the_hashes() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("fma") && __builtin_cpu_supports("avx2");
#else
  return false;
#endif
}

class BytesOf : public ::testing::TestWithParam<Case> {};

}  // namespace

TEST_P(BytesOf, ARunHaveOneHash) {
  const std::uint64_t alone = hash_of(GetParam(), 1);
  for (const int threads : {2, 3})
    EXPECT_EQ(hexadecimal(hash_of(GetParam(), threads)), hexadecimal(alone)) << threads << " threads";
  if (!is_a_processor_of_the_hashes()) GTEST_SKIP() << "hashes are those of x86-64 with FMA and AVX2";
  EXPECT_EQ(hexadecimal(alone), hexadecimal(GetParam().hash));
}

INSTANTIATE_TEST_SUITE_P(
    EachEngine, BytesOf,
    ::testing::Values(
        Case{"hard", "hard", "duration = \"2 s\"\n", 0xe11fb9492d58bb95u},
        Case{"hard_many", "hard",
             "duration = \"0.05 s\"\n[grains]\ncount = 300\n[box]\nmass = \"3.5 kg\"\nwidth = [\"150 mm\", "
             "\"150 mm\"]\n",
             0x32ff9169f25ea690u},
        Case{"hard_rubbing", "hard",
             "duration = \"1 s\"\n[[effect]]\nname = \"grain_friction\"\ngrain_grain = 0.2\ngrain_wall = "
             "0.1\n[[effect]]\nname = \"grain_air_drag\"\nlinear = \"2e-4 N s/m\"\n",
             0x2236d089cc13d387u},
        Case{"hard_driven", "hard",
             "duration = \"1 s\"\n[[effect]]\nname = \"spring_cubic\"\ncoefficient = 0.1\n[[effect]]\nname = "
             "\"oscillating_acceleration\"\namplitude = {x = \"0.1 m/s^2\"}\n",
             0x031f5f78ecc99912u},
        Case{"hard_sticky", "hard",
             "duration = \"1 s\"\n[[effect]]\nname = \"grain_cohesion\"\nforce = \"0.02 N\"\nrange = \"0.02 "
             "mm\"\n[[effect]]\nname = \"clamp_dry_friction\"\nforce = \"0.02 N\"\n",
             0xffcfbffcb7a96fadu},
        Case{"soft", "soft", "duration = \"0.1 s\"\n", 0x05f5d14156c9d0dcu},
        Case{"soft_rubbing", "soft",
             "duration = \"0.05 s\"\n[[effect]]\nname = \"grain_friction\"\ngrain_grain = 0.2\ngrain_wall = "
             "0.1\n[[effect]]\nname = \"spring_cubic\"\ncoefficient = 0.1\n",
             0xcdc10835173d1603u},
        Case{"bullet", "bullet", "duration = \"0.05 s\"\n", 0xc3a1c4372f11e83cu}),
    [](const auto& of) { return std::string(of.param.name); });
