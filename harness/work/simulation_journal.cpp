// SPDX-License-Identifier: MIT
#include "simulation_journal.hpp"

#include <cerrno>
#include <cstring>
#include <iterator>

#include "errors.hpp"
#include "fnv.hpp"
#include "kept_files.hpp"
#include "output_file.hpp"

namespace shakedown {

namespace {

namespace fs = std::filesystem;

/// Key, number of vectors, each vector's size and numbers, and the FNV-1a of all that; 8 bytes each, of this
/// machine: a journal does not travel.
std::string record_of(std::uint64_t key, const SimulationJournal::Features& features) {
  std::string record;
  const auto add = [&](const auto& value) {
    static_assert(sizeof value == 8);
    record.append(reinterpret_cast<const char*>(&value), 8);
  };
  add(key), add(std::uint64_t{features.size()});
  for (const Eigen::VectorXd& values : features) {
    add(static_cast<std::uint64_t>(values.size()));
    for (const double value : values) add(value);
  }
  add(fnv1a(record));
  return record;
}

/// Reads 8 bytes at a time from a text that may end anywhere.
class Reader {
 public:
  Reader(std::string_view text, std::size_t at) : text_(text), at_(at) {}
  std::size_t at() const { return at_; }
  std::size_t left() const { return (text_.size() - at_) / 8; }
  template <class T>
  bool next(T& value) {
    if (left() == 0) return false;
    std::memcpy(&value, text_.data() + at_, 8);
    at_ += 8;
    return true;
  }

 private:
  std::string_view text_;
  std::size_t at_;
};

bool read_record(Reader& reader, std::string_view text, std::uint64_t& key,
                 SimulationJournal::Features& features) {
  const std::size_t begin = reader.at();
  std::uint64_t count = 0, size = 0, sum = 0;
  if (!reader.next(key) || !reader.next(count) || count > reader.left()) return false;
  features.assign(count, {});
  for (Eigen::VectorXd& values : features) {
    if (!reader.next(size) || size > reader.left()) return false;
    values.resize(static_cast<Eigen::Index>(size));
    for (double& value : values) reader.next(value);
  }
  const std::string_view whole = text.substr(begin, reader.at() - begin);
  return reader.next(sum) && sum == fnv1a(whole);
}

}  // namespace

SimulationJournal::SimulationJournal(fs::path file, const std::string& work, bool resume)
    : file_(std::move(file)) {
  const std::string title = "shakedown simulations of " + work + "\n";
  std::error_code none;
  expect_no_pipe(file_);
  const bool go_on = resume && fs::exists(file_) && fs::file_size(file_, none) > 0;
  if (go_on) read(title);
  std::error_code problem;
  if (!go_on && fs::exists(file_)) fs::rename(file_, file_.string() + ".old", problem);
  if (problem) throw FileError(file_.string() + ": cannot be kept under another name: " + problem.message());
  if (!go_on) write_file(file_, title);
  stream_.open(file_, std::ios::binary | std::ios::app);
  if (!stream_)
    throw FileError(file_.string() + ": cannot be written (" + std::strerror(errno) +
                    "); choose another place or make room there");
}

void SimulationJournal::read(const std::string& title) {
  std::ifstream stream(file_, std::ios::binary);
  if (!stream) cannot_be_read(file_);
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  if (!text.starts_with(title))
    throw InputError({{{file_.string(), 0, 0},
                       "",
                       "holds simulations of other measurements, or of another version of the program",
                       "leave out --resume to begin afresh, or choose another folder"}});
  std::size_t whole = title.size();
  Features features;
  std::uint64_t key = 0;
  for (Reader reader(text, whole); read_record(reader, text, key, features); whole = reader.at())
    kept_[key] = features;
  fs::resize_file(file_, whole);
}

std::optional<SimulationJournal::Features> SimulationJournal::find(const std::string& simulation) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = kept_.find(fnv1a(simulation));
  return found == kept_.end() ? std::nullopt : std::optional(found->second);
}

void SimulationJournal::keep(const std::string& simulation, const Features& features) {
  const std::uint64_t key = fnv1a(simulation);
  const std::string record = record_of(key, features);
  const std::lock_guard<std::mutex> lock(mutex_);
  stream_ << record;  // unchecked: a full disk takes away going on later, not the answer
  kept_[key] = features;
}

std::int64_t SimulationJournal::kept() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return static_cast<std::int64_t>(kept_.size());
}

}  // namespace shakedown
