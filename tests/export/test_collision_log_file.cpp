// SPDX-License-Identifier: MIT
// A collision log that went through a file is the same log, and a damaged file is named as such.
#include <fstream>
#include <iterator>

#include "fnv.hpp"
#include "logged_run.hpp"
#include "output_file.hpp"
#include "replay.hpp"
#include "scratch_folder.hpp"

using namespace shakedown;

TEST(CollisionLogFile, ReadsBackBitForBit) {
  const ScratchFolder folder;
  const StoredRun run = logged_run();
  write_file(folder / collision_log_name, collision_log_bytes(run));
  const StoredRun back = read_collision_log(folder, all_effects());
  EXPECT_EQ(back.program, run.program);
  EXPECT_EQ(digest(back.setup), digest(run.setup));
  EXPECT_EQ(back.log.events, run.log.events);
  EXPECT_EQ(back.log.digests, run.log.digests);
  EXPECT_EQ(back.log.entries, run.log.entries);
  EXPECT_EQ(back.log.impacts, run.log.impacts);
  EXPECT_EQ(back.log.end_time, run.log.end_time);
  EXPECT_EQ(back.log.initial.position, run.log.initial.position);
  EXPECT_EQ(back.log.initial.velocity, run.log.initial.velocity);
  EXPECT_EQ(back.log.initial.radius, run.log.initial.radius);
  EXPECT_EQ(collision_log_bytes(back), collision_log_bytes(run));
}

/// 100 grains in a file fit where no packing holds as many.
TEST(CollisionLogFile, HoldsGrainsThatNoPackingDoes) {
  const ScratchFolder folder;
  std::ofstream grains(folder / "grains.csv");
  grains << "id,x,y,z,vx,vy,vz\n";
  for (int i = 0; i < 100; ++i)
    grains << i << ',' << 0.095 + 0.01001 * (i / 25) - 0.0025 << ',' << 0.01 * (i % 5) - 0.02 << ','
           << 0.01 * (i / 5 % 5) - 0.02 << ",0,0,0\n";
  grains.close();
  shakedown::Setup setup;
  setup.box.length = 0.0401;
  setup.grains.count = 100;
  setup.run.duration = 0.01;
  EXPECT_THROW(parse_setup(write_setup(setup), "packed", all_effects()), InputError);
  setup.release.initial_grains = (folder / "grains.csv").string();
  RunOptions options;
  options.log_collisions = true;
  const StoredRun run{"test", setup, 0, *make_hard_engine()->run(setup, options).collision_log};
  write_file(folder / collision_log_name, collision_log_bytes(run));
  const StoredRun back = read_collision_log(folder, all_effects());
  EXPECT_TRUE(back.setup.release.initial_grains.empty());
  EXPECT_EQ(back.log.initial.position, run.log.initial.position);
  EXPECT_EQ(collision_log_bytes(back), collision_log_bytes(run));
}

TEST(CollisionLogFile, NamesADamagedFile) {
  const ScratchFolder folder;
  const std::string bytes = collision_log_bytes(logged_run());
  for (const std::size_t length : {std::size_t{0}, std::size_t{40}, bytes.size() / 2, bytes.size() - 1}) {
    write_file(folder / "cut.log", bytes.substr(0, length));
    EXPECT_THROW(read_collision_log(folder / "cut.log", all_effects()), FileError) << length;
  }
  EXPECT_THROW(read_collision_log(folder / "missing.log", all_effects()), FileError);
}

/// One byte makes another motion, or one without end.
TEST(CollisionLogFile, NamesAFileWithOneChangedByte) {
  const ScratchFolder folder;
  const std::string bytes = collision_log_bytes(logged_run());
  for (std::size_t at = 0; at < bytes.size(); at += bytes.size() / 97) {
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ 0x20);
    write_file(folder / "changed.log", changed);
    try {
      read_collision_log(folder / "changed.log", all_effects());
      ADD_FAILURE() << "byte " << at;
    } catch (const FileError& error) {
      EXPECT_NE(std::string(error.what()).find("changed.log: is"), std::string::npos) << error.what();
    }
  }
}

/// A log that was edited, its sum put right, or that another build wrote: a grain meets a wall that it
/// leaves.
TEST(CollisionLogFile, WithAnImpactThatIsNoneIsToldByItsDigests) {
  const ScratchFolder folder;
  std::ifstream stream(PROJECT_ROOT "/tests/fuzz/corpus/log/edited.log", std::ios::binary);
  std::string bytes(std::istreambuf_iterator<char>(stream), {});
  const std::uint64_t sum = fnv1a(bytes);
  bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
  write_file(folder / collision_log_name, bytes);
  const StoredRun stored = read_collision_log(folder, all_effects());
  Replay replay(stored.setup, stored.log);
  EXPECT_THROW(replay.advance_to(stored.log.end_time), FileError);
}
