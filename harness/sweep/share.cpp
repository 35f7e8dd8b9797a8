// SPDX-License-Identifier: MIT
#include "share.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstdlib>

#include "errors.hpp"

namespace shakedown {

namespace {

std::optional<int> whole_number(std::string_view text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return {};
  return number;
}

[[noreturn]] void refuse_share(std::string source, std::string problem, std::string remedy) {
  throw InputError({{{std::move(source), 0, 0}, "", std::move(problem), std::move(remedy)}});
}

JobShare share_of(std::string source, int index, int of) {
  if (of < 1 || index < 0 || index >= of)
    refuse_share(std::move(source),
                 fmt::format("says {} of {} (counted from 0), which is no share", index, of),
                 "say which share with --shard i/n");
  return {index, of, std::move(source)};
}

class Reader {
 public:
  explicit Reader(const Environment& environment) : environment_(environment) {}
  bool has(const char* name) const { return environment_(name).has_value(); }
  std::optional<int> number(const char* name) const {
    const std::optional<std::string> text = environment_(name);
    if (!text || *text == "undefined") return {};  // Grid Engine says so outside arrays
    const std::optional<int> value = whole_number(*text);
    if (!value)
      refuse_share(name, fmt::format("is \"{}\", not a whole number", *text),
                   "say which share with --shard i/n");
    return value;
  }

 private:
  const Environment& environment_;
};

/// Returns the share of a process among those that one command started.
JobShare among_processes(const Reader& read) {
  constexpr const char* pairs[][2] = {{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
                                      {"MV2_COMM_WORLD_RANK", "MV2_COMM_WORLD_SIZE"},
                                      {"PMI_RANK", "PMI_SIZE"},
                                      {"SLURM_PROCID", "SLURM_STEP_NUM_TASKS"}};
  for (const auto& [rank, size] : pairs)
    if (read.has(rank) && read.has(size)) return share_of(rank, *read.number(rank), *read.number(size));
  const bool batch_script = read.has("SLURM_JOB_ID") && !read.has("SLURM_STEP_ID");
  if (!batch_script && read.has("SLURM_PROCID") && read.has("SLURM_NTASKS"))
    return share_of("SLURM_PROCID", *read.number("SLURM_PROCID"), *read.number("SLURM_NTASKS"));
  return {};
}

/// Returns the share of a member of an array of jobs.
JobShare among_array_members(const Reader& read) {
  if (const std::optional<int> id = read.number("SLURM_ARRAY_TASK_ID");
      id && read.has("SLURM_ARRAY_TASK_COUNT")) {
    const int first = read.number("SLURM_ARRAY_TASK_MIN").value_or(0),
              step = read.number("SLURM_ARRAY_TASK_STEP").value_or(1);
    return share_of("SLURM_ARRAY_TASK_ID", (*id - first) / step, *read.number("SLURM_ARRAY_TASK_COUNT"));
  }
  if (const std::optional<int> id = read.number("SGE_TASK_ID"); id && read.number("SGE_TASK_LAST")) {
    const int first = read.number("SGE_TASK_FIRST").value_or(1),
              step = read.number("SGE_TASK_STEPSIZE").value_or(1);
    return share_of("SGE_TASK_ID", (*id - first) / step, (*read.number("SGE_TASK_LAST") - first) / step + 1);
  }
  return {};
}

}  // namespace

JobShare parse_share(std::string_view text) {
  const std::size_t slash = text.find('/');
  const std::optional<int> index = whole_number(text.substr(0, slash));
  const std::optional<int> of = slash == text.npos ? std::nullopt : whole_number(text.substr(slash + 1));
  if (!index || !of || *of < 1 || *index < 1 || *index > *of)
    refuse_share("--shard", fmt::format("\"{}\" is no share", text),
                 "write i/n with i from 1 to n, e.g. --shard 2/8");
  return {*index - 1, *of, "--shard"};
}

Environment process_environment() {
  return [](const char* name) -> std::optional<std::string> {
    const char* value = std::getenv(name);
    return value == nullptr || *value == '\0' ? std::nullopt : std::optional<std::string>(value);
  };
}

JobShare share_from_launcher(const Environment& environment) {
  const Reader read(environment);
  const JobShare process = among_processes(read), member = among_array_members(read);
  JobShare share{member.index * process.of + process.index, member.of * process.of, ""};
  for (const std::string& source : {member.source, process.source})
    if (!source.empty()) share.source += (share.source.empty() ? "" : " and ") + source;
  return share;
}

}  // namespace shakedown
