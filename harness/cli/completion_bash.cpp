// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "manual.hpp"
#include "option_words.hpp"

namespace shakedown {

namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

/// Returns what bash's compgen lists for a value; files are what it takes by itself where nothing is listed.
std::string words_offered(const OptionWords& option) {
  switch (option.kind) {
    case ValueKind::words: return "-W '" + joined(option.choices) + "'";
    case ValueKind::folder: return "-d";
    case ValueKind::file: return "-f";
    default: return "-W ''";
  }
}

/// Returns the case of one command: values after an option, else its options, else its positional arguments.
std::string case_of(const std::string& path, const CLI::App& command) {
  std::string values, options, positional = "-W ''";
  for (const OptionWords& option : options_of(command)) {
    if (option.positional) {
      positional = words_offered(option);
      continue;
    }
    options += (options.empty() ? "" : " ") + joined(option.names);
    if (option.kind == ValueKind::none) continue;
    std::string pattern;
    for (const std::string& name : option.names) pattern += (pattern.empty() ? "" : "|") + name;
    values += fmt::format("        {}) list=\"{}\" ;;\n", pattern, words_offered(option));
  }
  std::string below;
  for (const CLI::App* one : commands_of(command)) below += (below.empty() ? "" : " ") + one->get_name();
  if (!below.empty()) positional = "-W '" + below + "'";
  return fmt::format(
      "    '{}')\n      options='{}'\n      list=\"{}\"\n      case \"$before\" in\n{}        *) ;;\n      "
      "esac\n"
      "      ;;\n",
      path, options, positional, values);
}

std::string cases_of_commands(const std::string& path, const CLI::App& command, const std::string& studies) {
  std::string text;
  for (const CLI::App* one : commands_of(command)) {
    const std::string here = path + (path.empty() ? "" : " ") + one->get_name();
    text += handed_on(*one)
                ? fmt::format("    '{}') _completion_loader {} 2>/dev/null; {} \"$@\"; return ;;\n", here,
                              studies, "_shakedown_studies")
                : case_of(here, *one);
    text += cases_of_commands(here, *one, studies);
  }
  return text;
}

/// Returns every command with commands of its own, as a pattern of the shell.
std::string groups_of(const CLI::App& parser) {
  std::string groups;
  for (const CLI::App* one : commands_of(parser))
    if (!commands_of(*one).empty()) groups += (groups.empty() ? "" : "|") + one->get_name();
  return groups.empty() ? "-" : groups;
}

std::string function_name(std::string program) {
  for (char& c : program)
    if (c == '-') c = '_';
  return "_" + program;
}

}  // namespace

std::string bash_completion(const std::string& program, const CLI::App& parser) {
  return fmt::format(
      "# Completion of {0} for bash, made by {0} --write-manual.\n"
      "{1}() {{\n"
      "  local word=\"${{COMP_WORDS[COMP_CWORD]}}\" before=\"${{COMP_WORDS[COMP_CWORD-1]}}\" command='' "
      "options='' list=''\n"
      "  COMPREPLY=()\n"
      "  [ \"$COMP_CWORD\" -lt 2 ] || command=\"${{COMP_WORDS[1]}}\"\n"
      "  case \"$command\" in\n"
      "    {2}) [ \"$COMP_CWORD\" -lt 3 ] || command=\"$command ${{COMP_WORDS[2]}}\" ;;\n"
      "  esac\n"
      "  case \"$command\" in\n"
      "{3}{4}"
      "    *) return ;;\n"
      "  esac\n"
      "  case \"$word\" in\n"
      "    -*) COMPREPLY=($(compgen -W \"$options\" -- \"$word\")) ;;\n"
      "    *) eval \"COMPREPLY=(\\$(compgen $list -- \\\"\\$word\\\"))\" ;;\n"
      "  esac\n"
      "}}\n"
      "complete -o filenames -F {1} {0}\n",
      program, function_name(program), groups_of(parser), case_of("", parser),
      cases_of_commands("", parser, program + "-studies"));
}

}  // namespace shakedown
