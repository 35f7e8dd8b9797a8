// SPDX-License-Identifier: MIT
#include "manual.hpp"

#include <fmt/format.h>

#include "option_words.hpp"
#include "output_file.hpp"
#include "provenance.hpp"

namespace shakedown {

namespace {

/// Returns a text as man(7) must have it: every dash one that can be copied, and no line that begins as a
/// request does.
std::string roff(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    const bool begins_line = escaped.empty() || escaped.back() == '\n';
    if (begins_line && (c == '.' || c == '\'')) escaped += "\\&";
    if (c == '\\')
      escaped += "\\e";
    else if (c == '-')
      escaped += "\\-";
    else
      escaped += c;
  }
  return escaped;
}

std::string with_capital(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

std::string in_capitals(std::string text) {
  for (char& c : text)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return text;
}

/// Returns "shakedown 0.1.0", without the commit, which is no matter of a page.
std::string release() {
  const std::string line = version_line();
  return line.substr(0, line.find(" ("));
}

std::string words_as_typed(const std::string& program, const CLI::App& command) {
  if (command.get_parent() == nullptr) return program;
  return words_as_typed(program, *command.get_parent()) + " " + command.get_name();
}

std::string synopsis(const std::string& program, const CLI::App& command) {
  std::string text = ".B " + roff(words_as_typed(program, command)) + "\n";
  std::string rest;
  for (const OptionWords& option : options_of(command)) {
    const std::string words = in_capitals(option.names.front()) + (option.repeated ? "..." : "");
    if (option.positional)
      rest += option.required ? " " + words : " [" + words + "]";
    else if (option.required)
      rest += fmt::format(" {} {}", option.names.front(), option.type);
  }
  if (!commands_of(command).empty()) rest += " COMMAND ...";
  return text + roff("[OPTIONS]" + rest) + "\n";
}

std::string entry(const OptionWords& option) {
  std::string names;
  for (const std::string& name : option.names)
    names += (names.empty() ? "" : ", ") + (option.positional ? in_capitals(name) : name);
  std::string text = ".TP\n.B " + roff(names);
  if (!option.type.empty()) text += " " + roff(option.type);
  text += "\n";
  if (!option.sentence.empty()) text += roff(with_capital(option.sentence)) + ".\n";
  if (!option.bounds.empty()) text += roff("Allowed: " + option.bounds + ".") + "\n";
  if (!option.otherwise.empty()) text += roff("Default: " + option.otherwise + ".") + "\n";
  return text;
}

std::string entries(const CLI::App& command, bool positional, const char* title) {
  std::string text;
  for (const OptionWords& option : options_of(command))
    if (option.positional == positional) text += entry(option);
  return text.empty() ? "" : std::string(".SH ") + title + "\n" + text;
}

std::string list_of_commands(const std::string& program, const CLI::App& command) {
  std::string text;
  for (const CLI::App* one : commands_of(command))
    text += fmt::format(".TP\n.BR {} (1)\n{}.\n", roff(dashed_name(program, *one)),
                        roff(with_capital(one->get_description())));
  return text.empty() ? "" : ".SH COMMANDS\n" + text;
}

std::string see_also(const std::string& program, const CLI::App& parser, const CLI::App& command) {
  std::vector<std::string> names;
  if (&command != &parser) names.push_back(program);
  for (const CLI::App* one : commands_of(parser))
    if (one != &command) names.push_back(dashed_name(program, *one));
  std::string text = ".SH SEE ALSO\n";
  for (std::size_t i = 0; i < names.size(); ++i)
    text += fmt::format(".BR {} (1){}\n", roff(names[i]), i + 1 < names.size() ? "," : "");
  return names.empty() ? "" : text;
}

void write_pages(const std::filesystem::path& folder, const std::string& program, const CLI::App& parser,
                 const CLI::App& above) {
  for (const CLI::App* command : commands_of(above)) {
    const std::string name = dashed_name(program, *command);
    // The options of a command that is handed on are told by the program that takes it.
    write_file(folder / "man1" / (name + ".1"),
               handed_on(*command) ? ".so man1/" + dashed_name(program + "-studies", *command) + ".1\n"
                                   : manual_page(program, parser, *command));
    write_pages(folder, program, parser, *command);
  }
}

}  // namespace

std::string manual_page(const std::string& program, const CLI::App& parser, const CLI::App& command) {
  const bool whole = &command == &parser;
  const std::string name = whole ? program : dashed_name(program, command);
  std::string sentence = command.get_description();
  if (sentence.ends_with('.')) sentence.pop_back();
  std::string text =
      fmt::format(".TH {} 1 \"\" \"{}\" \"User Commands\"\n", roff(in_capitals(name)), release());
  text += fmt::format(".SH NAME\n{} \\- {}\n", roff(name), roff(sentence));
  text += ".SH SYNOPSIS\n" + synopsis(program, command);
  text += ".SH DESCRIPTION\n" + roff(with_capital(sentence)) + ".\n";
  text += list_of_commands(program, command);
  text += entries(command, true, "ARGUMENTS") + entries(command, false, "OPTIONS");
  if (!whole && !command.get_footer().empty()) text += ".SH NOTES\n" + roff(command.get_footer()) + "\n";
  text += ".SH EXIT STATUS\n" + roff(parser.get_footer()) + "\n";
  return text + see_also(program, parser, command);
}

void write_manual(const std::filesystem::path& folder, const std::string& program, const CLI::App& parser) {
  write_file(folder / "man1" / (program + ".1"), manual_page(program, parser, parser));
  write_pages(folder, program, parser, parser);
  write_file(folder / "bash" / program, bash_completion(program, parser));
  write_file(folder / "zsh" / ("_" + program), zsh_completion(program, parser));
}

}  // namespace shakedown
