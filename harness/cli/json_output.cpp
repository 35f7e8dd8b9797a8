// SPDX-License-Identifier: MIT
#include "json_output.hpp"

#include "errors.hpp"
#include "output_file.hpp"

namespace shakedown {

void JsonOutput::check() const {
  if (wanted && !to_standard_output()) expect_writable(file);
}

void JsonOutput::write(const std::string& document) const {
  if (!wanted) return;
  if (!to_standard_output()) return write_file(file, document);
  const bool written = std::fwrite(document.data(), 1, document.size(), stdout) == document.size();
  if (!written || std::fflush(stdout) != 0)
    throw FileError("standard output: cannot be written; name a file after --json");
}

void add_json_option(CLI::App& command, JsonOutput& output) {
  command
      .add_option_function<std::string>(
          "--json",
          [&output](const std::string& file) {
            output.wanted = true;
            output.file = file;
          },
          "write the results as JSON to FILE; \"-\" or no name: to standard output")
      ->expected(0, 1)
      ->type_name("[FILE]");
}

}  // namespace shakedown
