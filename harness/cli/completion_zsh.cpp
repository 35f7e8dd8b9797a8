// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "manual.hpp"
#include "option_words.hpp"

namespace shakedown {

namespace {

/// Returns a text for single quotes, where zsh's _arguments takes brackets and colons for its own.
std::string quoted(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\'')
      escaped += "'\\''";
    else if (c == '[' || c == ']' || c == ':' || c == '\\')
      escaped += std::string("\\") + c;
    else
      escaped += c == '\n' ? ' ' : c;
  }
  return escaped;
}

std::string action_of(const OptionWords& option) {
  std::string words;
  switch (option.kind) {
    case ValueKind::words:
      for (const std::string& word : option.choices) words += (words.empty() ? "" : " ") + word;
      return "(" + words + ")";
    case ValueKind::folder: return "_files -/";
    case ValueKind::file: return "_files";
    default: return " ";
  }
}

/// Returns the specification that zsh's _arguments takes of one option or positional argument.
std::string specification(const OptionWords& option, int position) {
  const std::string value = quoted(option.type.empty() ? "value" : option.type) + ":" + action_of(option);
  if (option.positional) {
    const std::string name = quoted(option.names.front());
    return option.repeated ? fmt::format("'*:{}:{}'", name, action_of(option))
                           : fmt::format("'{}:{}:{}'", position, name, action_of(option));
  }
  std::string text;
  for (const std::string& name : option.names) {
    text += (text.empty() ? "'" : " '") + std::string(option.repeated ? "*" : "") + name + "[" +
            quoted(option.sentence) + "]";
    if (option.kind != ValueKind::none) text += (option.value_optional ? "::" : ":") + value;
    text += "'";
  }
  return text;
}

std::string arguments_of(const CLI::App& command, const std::string& indent) {
  std::string text = commands_of(command).empty() ? "_arguments -s" : "_arguments -s -C";
  int position = 0;
  for (const OptionWords& option : options_of(command))
    text += " \\\n" + indent + "  " + specification(option, option.positional ? ++position : 0);
  return text;
}

std::string names_of_commands(const CLI::App& command) {
  std::string text;
  for (const CLI::App* one : commands_of(command))
    text += fmt::format(" '{}:{}'", one->get_name(), quoted(one->get_description()));
  return text;
}

/// Returns what completes the words of a command; of one with commands below it first their names, then
/// theirs.
std::string body_of(const CLI::App& command, const std::string& indent) {
  if (handed_on(command))
    return indent + "words=(shakedown-studies \"${words[@]}\"); (( CURRENT++ )); _shakedown-studies\n";
  if (commands_of(command).empty()) return indent + arguments_of(command, indent) + "\n";
  const std::string state = command.get_parent() == nullptr ? "arguments" : command.get_name();
  std::string text = indent + arguments_of(command, indent) + " \\\n" + indent +
                     "  '1: :->commands' '*:: :->" + state + "'\n" + indent + "case $state in\n";
  text += fmt::format("{0}  commands) local -a known; known=({1}); _describe command known ;;\n", indent,
                      names_of_commands(command));
  text += indent + "  " + state + ")\n" + indent + "    case $words[1] in\n";
  for (const CLI::App* one : commands_of(command))
    text += fmt::format("{0}      {1})\n{2}{0}        ;;\n", indent, one->get_name(),
                        body_of(*one, indent + "        "));
  return text + indent + "    esac ;;\n" + indent + "esac\n";
}

}  // namespace

std::string zsh_completion(const std::string& program, const CLI::App& parser) {
  return fmt::format(
      "#compdef {0}\n# Completion of {0} for zsh, made by {0} --write-manual.\n"
      "_{0}() {{\n  local context state state_descr line\n  typeset -A opt_args\n{1}}}\n_{0} \"$@\"\n",
      program, body_of(parser, "  "));
}

}  // namespace shakedown
