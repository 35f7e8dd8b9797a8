// SPDX-License-Identifier: MIT
#include "collision_log_file.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <fstream>
#include <sstream>

#include "fnv.hpp"
#include "kept_files.hpp"
#include "provenance.hpp"
#include "setup_file.hpp"
#include "toml_document.hpp"

namespace shakedown {

namespace {

static_assert(std::endian::native == std::endian::little);
constexpr std::string_view first_line = "shakedown collision log 2\n";

class Writer {
 public:
  std::string bytes{first_line};
  template <class Number>
  void number(Number value) {
    static_assert(sizeof(Number) == 8);
    char raw[8];
    std::memcpy(raw, &value, 8);
    bytes.append(raw, 8);
  }
  void vector(const Vec3& value) {
    for (const double part : value) number(part);
  }
  void text(std::string_view value) {
    number(static_cast<std::uint64_t>(value.size()));
    bytes += value;
  }
};

class Reader {
 public:
  Reader(std::string bytes, const std::filesystem::path& file) : bytes_(std::move(bytes)), file_(file) {
    if (!bytes_.starts_with(first_line))
      fail("is not a collision log of this program's version; make the run again with --log");
    at_ = first_line.size();
    check_sum();
  }
  template <class Number>
  Number number() {
    static_assert(sizeof(Number) == 8);
    Number value;
    std::memcpy(&value, take(8).data(), 8);
    return value;
  }
  Vec3 vector() {
    Vec3 value;
    for (double& part : value) part = number<double>();
    return value;
  }
  std::string_view text() { return take(number<std::uint64_t>()); }
  /// Reads how many records of `size` bytes follow.
  std::size_t count(std::size_t size) {
    const auto n = number<std::uint64_t>();
    if (n > (bytes_.size() - at_) / size) fail("is cut short or damaged; make the run again with --log");
    return n;
  }
  bool done() const { return at_ == bytes_.size(); }
  [[noreturn]] void fail(const std::string& what) const { throw FileError(file_.string() + ": " + what); }

 private:
  /// Throws FileError where the sum does not fit: a log that was damaged may still be read, as another motion
  /// or one without end.
  void check_sum() {
    const std::size_t whole = bytes_.size() - std::min(bytes_.size() - at_, sizeof(std::uint64_t));
    std::uint64_t sum = 0;
    if (bytes_.size() - whole == sizeof sum) std::memcpy(&sum, bytes_.data() + whole, sizeof sum);
    if (bytes_.size() - whole < sizeof sum || sum != fnv1a(std::string_view(bytes_).substr(0, whole)))
      fail("is cut short or damaged; make the run again with --log");
    bytes_.resize(whole);
  }
  std::string_view take(std::uint64_t n) {
    if (n > bytes_.size() - at_) fail("is cut short or damaged; make the run again with --log");
    at_ += n;
    return std::string_view(bytes_).substr(at_ - n, n);
  }
  std::string bytes_;
  std::filesystem::path file_;
  std::size_t at_ = 0;
};

void write_state(Writer& to, const State& state) {
  to.number(static_cast<std::uint64_t>(state.size()));
  to.number(static_cast<std::uint64_t>(state.spin.empty() ? 0 : 1));
  to.number(state.x_box);
  to.number(state.v_box);
  for (std::size_t i = 0; i < state.size(); ++i) {
    to.vector(state.position[i]);
    to.vector(state.velocity[i]);
    if (!state.spin.empty()) to.vector(state.spin[i]);
    to.number(state.radius[i]);
    to.number(state.mass[i]);
  }
}

State read_state(Reader& from) {
  State state;
  const std::size_t n = from.count(64);
  const bool spins = from.number<std::uint64_t>() != 0;
  state.x_box = from.number<double>();
  state.v_box = from.number<double>();
  for (std::size_t i = 0; i < n; ++i) {
    state.position.push_back(from.vector());
    state.velocity.push_back(from.vector());
    if (spins) state.spin.push_back(from.vector());
    state.radius.push_back(from.number<double>());
    state.mass.push_back(from.number<double>());
  }
  return state;
}

/// Reads the setup of a log. The grains come from the log itself, so no packing need hold as many of them.
Setup setup_of_log(const std::string& text, const std::filesystem::path& file, KnownEffects known) {
  const std::string key = "release.initial_grains";
  const Override own_state{key, toml_string(file.string()), file.string()};
  Setup setup = parse_setup(text, file.string(), known, {&own_state, 1});
  setup.release.initial_grains.clear();
  setup.places.erase(key);
  return setup;
}

}  // namespace

std::string collision_log_bytes(const StoredRun& stored) {
  Writer to;
  Setup setup = stored.setup;
  setup.release.initial_grains.clear();
  to.text(stored.program);
  to.text(write_setup(setup));
  to.number(static_cast<std::int64_t>(stored.run));
  to.number(stored.log.end_time);
  to.number(stored.log.entries);
  to.number(stored.log.impacts);
  write_state(to, stored.log.initial);
  to.number(static_cast<std::uint64_t>(stored.log.digests.size()));
  for (const std::uint64_t digest : stored.log.digests) to.number(digest);
  to.text({reinterpret_cast<const char*>(stored.log.events.data()), stored.log.events.size()});
  to.number(fnv1a(to.bytes));
  return to.bytes;
}

StoredRun read_collision_log(std::filesystem::path file, KnownEffects known) {
  if (std::filesystem::is_directory(file)) file /= collision_log_name;
  keep_unchanged(file);
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    throw FileError(file.string() +
                    ": there is no such collision log; `shakedown run SETUP --out DIR --log` makes one");
  std::ostringstream contents;
  contents << stream.rdbuf();
  Reader from(contents.str(), file);
  StoredRun stored;
  stored.file = file;
  stored.program = from.text();
  const std::string setup(from.text());
  stored.setup = setup_of_log(setup, file, known);
  stored.run = static_cast<int>(from.number<std::int64_t>());
  stored.log.end_time = from.number<double>();
  stored.log.entries = from.number<std::int64_t>();
  stored.log.impacts = from.number<std::int64_t>();
  stored.log.initial = read_state(from);
  const std::size_t digests = from.count(8);
  for (std::size_t i = 0; i < digests; ++i) stored.log.digests.push_back(from.number<std::uint64_t>());
  const std::string_view events = from.text();
  stored.log.events.assign(events.begin(), events.end());
  if (!from.done() || digests == 0) from.fail("is damaged; make the run again with --log");
  return stored;
}

}  // namespace shakedown
