// SPDX-License-Identifier: MIT
#include "provenance.hpp"

#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "build_info.hpp"

namespace shakedown {

namespace {

std::string cpu_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name") && line.find(": ") != std::string::npos)
      return line.substr(line.find(": ") + 2);
  return "unknown";
}

std::string now_utc() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

std::vector<std::string> command_line() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> words;
  for (std::string word; std::getline(file, word, '\0');) words.push_back(word);
  return words;
}

}  // namespace

Provenance provenance_of_this_program() {
  Provenance provenance;
  provenance.version = build_info::version;
  provenance.commit = build_info::commit;
  provenance.compiler = build_info::compiler;
  provenance.flags = build_info::flags;
  provenance.host_cpu = cpu_name();
  provenance.host_cores = static_cast<int>(std::thread::hardware_concurrency());
  provenance.started = now_utc();
  provenance.command = command_line();
  return provenance;
}

std::string provenance_json(const Provenance& provenance) {
  const nlohmann::ordered_json json{
      {"program",
       {{"name", "shakedown"},
        {"version", provenance.version},
        {"commit", provenance.commit},
        {"compiler", provenance.compiler},
        {"flags", provenance.flags}}},
      {"host", {{"cpu", provenance.host_cpu}, {"cores", provenance.host_cores}}},
      {"started", provenance.started},
      {"command", provenance.command},
      {"engine", provenance.engine},
      {"seed", provenance.seed},
      {"runs", provenance.runs},
      {"threads", provenance.threads}};
  return json.dump(2) + "\n";
}

std::string version_line() {
  return std::string("shakedown ") + build_info::version + " (" + build_info::commit + ", " +
         build_info::compiler + ")";
}

}  // namespace shakedown
