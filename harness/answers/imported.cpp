// SPDX-License-Identifier: MIT
#include "imported.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace shakedown {

std::string imported_text(const ImportedTables& imported, const std::string& file) {
  std::string text = fmt::format("{}\nwrote {}\n", imported.preview, file);
  if (imported.open_questions.empty())
    return text + fmt::format("Then: shakedown diagnose setup.toml --data {}\n", file);
  text += "Please fill in:\n";
  for (const std::string& question : imported.open_questions) text += fmt::format("  {}\n", question);
  return text;
}

std::string imported_json(const ImportedTables& imported, const std::string& file) {
  nlohmann::ordered_json document{{"schema_version", 1},
                                  {"experiment", file},
                                  {"columns", nlohmann::json::array()},
                                  {"open_questions", imported.open_questions}};
  for (const GuessedColumn& column : imported.columns)
    document["columns"].push_back({{"role", column.role},
                                   {"from", column.from},
                                   {"unit", column.unit},
                                   {"track", column.track},
                                   {"reason", column.reason},
                                   {"certain", column.certain}});
  return document.dump(2) + "\n";
}

}  // namespace shakedown
