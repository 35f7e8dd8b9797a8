// SPDX-License-Identifier: MIT
// Preloaded into a program: disks that are full, folders that are read-only, a power cut. Counts the calls
// that change files below $FAULT_UNDER - opening to write, writing, fsync, truncating, renaming - and from
// call $FAULT_AT on (from 1) they fail with $FAULT_KIND: ENOSPC or EROFS; KILL: in the midst of that call the
// program is killed. VANISH counts calls that open a file there to read instead, and from that call on the
// file is not there. The number of calls is left in $FAULT_COUNT when the program ends by itself.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

constexpr int most_descriptors = 4096;
std::array<std::atomic<bool>, most_descriptors> watched{};  ///< open files below the folder
std::atomic<long> calls{0};

const char* setting(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

bool is_below(const char* path) {
  const char* folder = setting("FAULT_UNDER");
  return *folder != '\0' && std::strncmp(path, folder, std::strlen(folder)) == 0;
}

bool is_watched(int descriptor) {
  return descriptor >= 0 && descriptor < most_descriptors && watched[static_cast<std::size_t>(descriptor)];
}

int watching(int descriptor) {
  if (descriptor >= 0 && descriptor < most_descriptors) watched[static_cast<std::size_t>(descriptor)] = true;
  return descriptor;
}

/// True where this call must fail (errno is set); `half` is done before the program is killed.
template <class Half>
bool fails(const Half& half) {
  const long at = std::strtol(setting("FAULT_AT"), nullptr, 10), call = ++calls;
  const char* kind = setting("FAULT_KIND");
  if (at == 0 || call < at) return false;
  if (std::strcmp(kind, "KILL") == 0) {
    half();
    (void)::kill(::getpid(), SIGKILL);
  }
  if (std::strcmp(kind, "VANISH") == 0) return false;
  errno = std::strcmp(kind, "EROFS") == 0 ? EROFS : ENOSPC;
  return true;
}
bool fails() {
  return fails([] {});
}

template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

/// Left by the destructor of the library: when the program ends.
struct Count {
  ~Count() {
    if (*setting("FAULT_COUNT") == '\0') return;
    if (std::FILE* file = std::fopen(setting("FAULT_COUNT"), "w")) {
      std::fprintf(file, "%ld\n", calls.load());
      (void)std::fclose(file);
    }
  }
} count;

bool writes(int flags) { return (flags & (O_WRONLY | O_RDWR)) != 0; }

/// True where a file that is opened to read is there no longer; folders stay.
bool has_vanished(const char* path) {
  struct stat there {};
  if (std::strcmp(setting("FAULT_KIND"), "VANISH") != 0 || ::stat(path, &there) != 0 ||
      !S_ISREG(there.st_mode))
    return false;
  const long at = std::strtol(setting("FAULT_AT"), nullptr, 10), call = ++calls;
  if (at == 0 || call < at) return false;
  errno = ENOENT;
  return true;
}

int opened(const char* name, const char* path, int flags, mode_t mode) {
  const auto open_it = next<int(const char*, int, ...)>(name);
  if (is_below(path) && !writes(flags)) return has_vanished(path) ? -1 : open_it(path, flags, mode);
  if (!is_below(path)) return open_it(path, flags, mode);
  return fails() ? -1 : watching(open_it(path, flags, mode));
}

std::FILE* opened_stream(const char* name, const char* path, const char* mode) {
  const auto open_it = next<std::FILE*(const char*, const char*)>(name);
  if (!is_below(path)) return open_it(path, mode);
  if (std::strpbrk(mode, "wa+") == nullptr) return has_vanished(path) ? nullptr : open_it(path, mode);
  if (fails()) return nullptr;
  std::FILE* stream = open_it(path, mode);
  if (stream != nullptr) watching(::fileno(stream));
  return stream;
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
  va_end(more);
  return opened("open", path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
  va_end(more);
  return opened("open64", path, flags, mode);
}

std::FILE* fopen(const char* path, const char* mode) { return opened_stream("fopen", path, mode); }
std::FILE* fopen64(const char* path, const char* mode) { return opened_stream("fopen64", path, mode); }

int close(int descriptor) {
  if (is_watched(descriptor)) watched[static_cast<std::size_t>(descriptor)] = false;
  return next<int(int)>("close")(descriptor);
}

ssize_t write(int descriptor, const void* bytes, std::size_t size) {
  const auto write_it = next<ssize_t(int, const void*, std::size_t)>("write");
  if (is_watched(descriptor) && fails([&] { (void)write_it(descriptor, bytes, size / 2); })) return -1;
  return write_it(descriptor, bytes, size);
}

ssize_t pwrite64(int descriptor, const void* bytes, std::size_t size, off64_t place) {
  const auto write_it = next<ssize_t(int, const void*, std::size_t, off64_t)>("pwrite64");
  if (is_watched(descriptor) && fails([&] { (void)write_it(descriptor, bytes, size / 2, place); })) return -1;
  return write_it(descriptor, bytes, size, place);
}

int fsync(int descriptor) {
  return is_watched(descriptor) && fails() ? -1 : next<int(int)>("fsync")(descriptor);
}
int fdatasync(int descriptor) {
  return is_watched(descriptor) && fails() ? -1 : next<int(int)>("fdatasync")(descriptor);
}
int ftruncate64(int descriptor, off64_t size) noexcept {
  return is_watched(descriptor) && fails() ? -1 : next<int(int, off64_t)>("ftruncate64")(descriptor, size);
}

int rename(const char* from, const char* to) noexcept {
  return is_below(to) && fails() ? -1 : next<int(const char*, const char*)>("rename")(from, to);
}

int mkdir(const char* path, mode_t mode) noexcept {
  return is_below(path) && fails() ? -1 : next<int(const char*, mode_t)>("mkdir")(path, mode);
}

}  // extern "C"
