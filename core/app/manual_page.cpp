#include "app/manual_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>
#include <string_view>

#include "base/text.h"

namespace slipcheck {
namespace {

/// Text as man(7) has to be told it: a backslash, a hyphen that may be copied to a command line,
/// and a dot or quote that would be a request at the beginning of a line.
std::string roff(std::string_view text) {
  std::string escaped;
  bool begins = true;
  for (const char c : text) {
    if (begins && (c == '.' || c == '\'')) escaped += "\\&";
    begins = c == '\n';
    if (c == '\\')
      escaped += "\\e";
    else if (c == '-')
      escaped += "\\-";
    else
      escaped += c;
  }
  return escaped;
}

std::string bold(std::string_view text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(std::string_view text) { return "\\fI" + roff(text) + "\\fR"; }

std::string synopsis(const CommandWords& command) {
  std::string line = bold(command.path);
  for (const OptionWords& option : command.options) {
    if (!option.place.empty() || !option.is_required) continue;
    line += " " + bold(option.names.back()) + " " + italic(option.value);
  }
  line += " [" + italic("OPTIONS") + "]";
  for (const OptionWords& option : command.options) {
    if (option.place.empty()) continue;
    const std::string place = italic(option.place) + (option.is_repeated ? "..." : "");
    line += option.is_required ? " " + place : " [" + place + "]";
  }
  if (!command.commands.empty()) line += " " + italic("COMMAND");
  return line + "\n";
}

std::string entry(const OptionWords& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.names) names.push_back(bold(name));
  std::string text = ".TP\n";
  text += option.place.empty() ? fmt::format("{}", fmt::join(names, ", ")) : italic(option.place);
  if (option.place.empty() && !option.value.empty()) text += " " + italic(option.value);
  if (option.is_repeated) text += " ...";
  text += "\n" + roff(option.about) + ".\n";
  if (!option.choices.empty())
    text += roff(fmt::format("One of {}.\n", fmt::join(option.choices, ", ")));
  else if (!option.rule.empty())
    text += roff(fmt::format("Must be {}.\n", option.rule));
  if (!option.usual.empty()) text += roff(fmt::format("Else {}.\n", option.usual));
  return text;
}

std::string options_of(const CommandWords& command) {
  std::string text;
  for (const bool have_place : {true, false})
    for (const OptionWords& option : command.options)
      if (option.place.empty() != have_place) text += entry(option);
  return text;
}

/// A footer: paragraphs, and after "Example:" or "Examples:" lines as they stand.
std::string notes_of(const CommandWords& command, const char* heading) {
  std::string prose, examples;
  bool in_examples = false;
  std::istringstream lines(command.footer);
  for (std::string line; std::getline(lines, line);) {
    if (line == "Example:" || line == "Examples:")
      in_examples = true;
    else if (in_examples)
      examples += roff(line) + "\n";
    else
      prose += line.empty() ? ".PP\n" : roff(line) + "\n";
  }
  while (prose.ends_with(".PP\n")) prose.resize(prose.size() - 4);
  std::string text;
  if (!prose.empty()) text += ".PP\n" + prose;
  if (!examples.empty()) text += fmt::format("{} EXAMPLES\n.nf\n{}.fi\n", heading, examples);
  return text;
}

std::vector<const CommandWords*> direct(const CommandWords& command) {
  std::vector<const CommandWords*> commands;
  for (const CommandWords& below : command.commands) commands.push_back(&below);
  return commands;
}

/// What is written once, in the page of the program.
constexpr const char* kEnvironment = R"(.SH ENVIRONMENT
.TP
.B SLIPCHECK_ENGINE_PATH
Folders, separated by colons, in which engines are looked for before those beside the program: executables
.RI slipcheck\-engine\- NAME \- PRECISION .
.TP
.B SLIPCHECK_ENGINES
The folder of engines that
.B slipcheck engines add
installs; else slipcheck/engines in
.B XDG_DATA_HOME
or ~/.local/share.
.TP
.B NO_COLOR
No colour and no progress bar.
)";

}  // namespace

std::string page_name(const CommandWords& command) {
  std::string name = command.path;
  std::ranges::replace(name, ' ', '-');
  return name;
}

std::string manual_page(const CommandWords& top, const CommandWords& command,
                        const std::string& version) {
  const bool is_top = &command == &top;
  std::string upper = page_name(command);
  std::ranges::transform(upper, upper.begin(), [](char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c;
  });
  std::string text =
      fmt::format(".TH \"{}\" 1 \"\" \"slipcheck {}\" \"Slipcheck\"\n", roff(upper), roff(version));
  text += fmt::format(".SH NAME\n{} \\- {}\n.SH SYNOPSIS\n{}", roff(page_name(command)),
                      roff(command.about), synopsis(command));
  text += ".SH DESCRIPTION\n" + roff(command.about) + (command.about.ends_with('.') ? "\n" : ".\n");
  text += ".SH OPTIONS\n" + options_of(command);
  if (!command.commands.empty()) text += ".SH COMMANDS\n";
  for (const CommandWords* below : is_top ? direct(command) : all_commands(command)) {
    if (below == &command) continue;
    if (is_top)
      text += ".TP\n.BR " + roff(page_name(*below)) + " (1)\n" + roff(below->about) + ".\n";
    else
      text += ".SS " + roff(below->path) + "\n" + synopsis(*below) + ".PP\n" + roff(below->about) +
              ".\n" + options_of(*below) + notes_of(*below, ".SS");
  }
  text += notes_of(command, ".SH");
  if (is_top) return text + kEnvironment;
  return text + ".SH SEE ALSO\n.BR " + roff(page_name(top)) + " (1)\n";
}

}  // namespace slipcheck
