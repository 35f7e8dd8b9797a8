// SPDX-License-Identifier: MIT
#pragma once
#include <gtest/gtest.h>
#include <stdlib.h>  // setenv

#include <filesystem>
#include <fstream>
#include <string>

#include "scratch_folder.hpp"

namespace shakedown {

/// The message of the error that a call throws.
template <class Error, class Call>
std::string message_of(Call call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

/// A variable of the environment, put back at the end.
class Named {
 public:
  Named(const char* variable, const std::string& value) : variable_(variable) {
    if (const char* before = ::getenv(variable)) before_ = before;
    ::setenv(variable, value.c_str(), 1);
  }
  ~Named() {
    if (before_.empty())
      ::unsetenv(variable_);
    else
      ::setenv(variable_, before_.c_str(), 1);
  }
  Named(const Named&) = delete;
  Named& operator=(const Named&) = delete;

 private:
  const char* variable_;
  std::string before_;
};

/// A shell script that stands for somebody's program.
inline std::string stand_in(const ScratchFolder& folder, const std::string& lines) {
  const std::filesystem::path file = folder / "program";
  std::ofstream(file) << "#!/bin/sh\n" << lines << "\n";
  std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  return file.string();
}

}  // namespace shakedown
