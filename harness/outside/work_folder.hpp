// SPDX-License-Identifier: MIT
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace shakedown {

/// The folder of one run of an outside program: what it is given and what it answers. It is removed with this
/// object, unless somebody wants to look into it.
class WorkFolder {
 public:
  /// `kept`: a folder that stays, made when it is missing; empty: a new one among the system's temporary
  /// files. Throws FileError.
  explicit WorkFolder(const std::filesystem::path& kept);
  ~WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  /// Writes a file in the folder. Throws FileError.
  void write(const std::string& name, std::string_view contents) const;
  /// Makes way for a file that another program is to write: removes that of an earlier run. Throws FileError
  /// where a link, a device or a file that the command reads has its name.
  void make_way(const std::string& name) const;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }  ///< absolute

 private:
  std::filesystem::path path_;
  bool temporary_ = false;
};

/// Lets the files of outside programs stay in this folder, made when it is missing; empty: as the environment
/// variable SHAKEDOWN_KEEP says, which names one too. To be called before any run begins.
void keep_outside_files(const std::filesystem::path& folder);

/// Returns where the files of this run are to stay: "DIR/lammps/run_0", `program` without a path. A second
/// run of that name in this process (of another setup) gets "run_0_2", so that none is written over. Empty:
/// nowhere. Thread-safe.
std::filesystem::path kept_folder(const std::string& program, int run);

/// Returns the whole file; empty when there is none.
std::string contents_of(const std::filesystem::path& file);

/// Returns the last `most` bytes of a file, from the beginning of a line on; empty when there is none.
std::string end_of(const std::filesystem::path& file, std::size_t most);

}  // namespace shakedown
