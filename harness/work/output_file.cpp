// SPDX-License-Identifier: MIT
#include "output_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "errors.hpp"
#include "kept_files.hpp"

namespace shakedown {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void cannot_write(const fs::path& file, const std::string& why,
                               const std::string& remedy = "choose another place or make room there") {
  throw FileError(file.string() + ": cannot be written (" + why + "); " + remedy);
}

fs::path neighbour_of(const fs::path& file) {
  fs::path neighbour = file;
  neighbour += ".partial-" + std::to_string(::getpid());  // two programs may write to one folder
  return neighbour;
}

void make_folder_of(const fs::path& file) {
  std::error_code error;
  if (file.has_parent_path()) fs::create_directories(file.parent_path(), error);
  if (error) cannot_write(file, error.message());
}

/// Throws FileError where something other than a plain file of an earlier result stands in the file's place.
void refuse_what_must_stay(const fs::path& file) {
  if (file.empty()) cannot_write(file, "the name is empty", "name a file");
  std::error_code error;
  const fs::file_status there = fs::symlink_status(file, error);
  if (file.filename().empty() || fs::is_directory(there))
    cannot_write(file, "it is a folder", "name a file in it");
  if (fs::is_symlink(there))
    cannot_write(file, "it is a link, and results would take its place",
                 "name the file that it leads to, or remove the link");
  if (fs::exists(there) && !fs::is_regular_file(there))
    cannot_write(file, "it is a device or a pipe, and results would take its place",
                 "name a file; without the option nothing is written");
  if (is_kept_unchanged(file))
    cannot_write(file, "this command reads it, or its other results go there", "choose another name");
}

/// Opens a new file: whatever has that name, a link to somewhere else for one, is no file of ours. Below
/// zero: it cannot be made.
int open_new(const fs::path& neighbour) {
  std::error_code ignored;
  fs::remove(neighbour, ignored);  // of a process with our number that was killed
  return ::open(neighbour.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
}

}  // namespace

GrowingFile::GrowingFile(fs::path file) : file_(std::move(file)), neighbour_(neighbour_of(file_)) {
  refuse_what_must_stay(file_);
  make_folder_of(file_);
  descriptor_ = open_new(neighbour_);
  if (descriptor_ < 0) cannot_write(file_, std::strerror(errno));
}

GrowingFile::~GrowingFile() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  std::error_code ignored;
  fs::remove(neighbour_, ignored);
}

void GrowingFile::add(std::string_view text) {
  constexpr std::size_t at_once = 1 << 20;
  waiting_ += text;
  if (waiting_.size() >= at_once) hand_over();
}

void GrowingFile::hand_over() {
  for (std::string_view left = waiting_; !left.empty();) {
    const ssize_t written = ::write(descriptor_, left.data(), left.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) cannot_write(file_, std::strerror(errno));
    left.remove_prefix(static_cast<std::size_t>(written));
  }
  waiting_.clear();
}

void GrowingFile::finish() {
  hand_over();
  if (::close(std::exchange(descriptor_, -1)) == 0) {
    std::error_code error;
    fs::rename(neighbour_, file_, error);
    if (!error) return;
    errno = error.value();
  }
  const std::string why = std::strerror(errno);
  std::error_code ignored;
  fs::remove(neighbour_, ignored);
  cannot_write(file_, why);
}

void write_file(const fs::path& file, std::string_view contents) {
  GrowingFile whole(file);
  whole.add(contents);
  whole.finish();
}

void expect_writable(const fs::path& file) { const GrowingFile trial(file); }

/// Locks a folder through a file in it: some file systems lock no folders, and a program that is killed
/// leaves a file that locks nothing.
class OutputFolder::Lock {
 public:
  explicit Lock(const fs::path& folder) : file_(folder / ".being-written") {
    // Between opening and locking the last holder may have removed the file: then there is a new one.
    do {
      if (descriptor_ >= 0) ::close(descriptor_);
      descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
      if (descriptor_ < 0) cannot_write(file_, std::strerror(errno));
      if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) continue;
      ::close(descriptor_);
      cannot_write(folder, "another program is writing its results there",
                   "choose another folder, or wait until it has ended");
    } while (!is_still_the_file());
  }
  ~Lock() {
    std::error_code ignored;
    fs::remove(file_, ignored);
    ::close(descriptor_);
  }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  bool is_still_the_file() const {
    struct stat opened {
    }, there{};
    return ::fstat(descriptor_, &opened) != 0 ||
           (::stat(file_.c_str(), &there) == 0 && opened.st_ino == there.st_ino);
  }
  fs::path file_;
  int descriptor_ = -1;
};

OutputFolder::OutputFolder(fs::path folder, Use use) : folder_(std::move(folder)) {
  if (folder_.empty()) cannot_write(folder_, "the name is empty", "name a folder");
  expect_writable(folder_ / "summary.json");
  if (use == Use::alone) lock_ = std::make_shared<const Lock>(folder_);
}

void OutputFolder::write(const fs::path& name, std::string_view contents) const {
  write_file(folder_ / name, contents);
}

void OutputFolder::remove(const std::vector<fs::path>& names) const {
  std::error_code ignored;
  for (const fs::path& name : names) {
    const fs::path file = folder_ / name;
    if (is_kept_unchanged(file)) continue;
    fs::remove(file, ignored);  // of folders the empty ones alone
    if (name.has_parent_path()) fs::remove(file.parent_path(), ignored);
  }
}

}  // namespace shakedown
