#include "app/completion_scripts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <vector>

namespace slipcheck {
namespace {

using Strings = std::vector<std::string>;

std::string replaced(std::string_view text, char what, std::string_view by) {
  std::string result;
  for (const char c : text)
    if (c == what)
      result += by;
    else
      result += c;
  return result;
}

/// Within single quotes of a shell for POSIX, and of zsh.
std::string shell_quoted(std::string_view text) {
  return "'" + replaced(text, '\'', "'\\''") + "'";
}

Strings command_names(const CommandWords& command) {
  Strings names;
  for (const CommandWords& below : command.commands) names.push_back(below.name());
  return names;
}

// --- bash ----------------------------------------------------------------------------------------

/// Words that may stand where `command` is, but for values of its options.
Strings words_after(const CommandWords& command) {
  Strings words = command_names(command);
  for (const OptionWords& option : command.options) {
    words.insert(words.end(), option.names.begin(), option.names.end());
    if (!option.place.empty())
      words.insert(words.end(), option.choices.begin(), option.choices.end());
  }
  return words;
}

/// Cases of `path option`: what that option takes. Nothing is offered of a number or a name; files
/// are the shell's own answer then.
std::string bash_values(const CommandWords& command) {
  std::string cases;
  for (const OptionWords& option : command.options) {
    if (option.names.empty() || option.value.empty()) continue;
    Strings patterns;
    for (const std::string& name : option.names)
      patterns.push_back(fmt::format("'{} {}'", command.path, name));
    cases += fmt::format("    {}) words='{}' ;;\n", fmt::join(patterns, "|"),
                         fmt::join(option.choices, " "));
  }
  return cases;
}

// --- zsh -----------------------------------------------------------------------------------------

/// A text inside of _arguments' brackets.
std::string zsh_about(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string zsh_action(const OptionWords& option) {
  if (!option.choices.empty()) return fmt::format("({})", fmt::join(option.choices, " "));
  return option.value == "TEXT" ? "_files" : " ";
}

std::string zsh_options(const CommandWords& command) {
  std::string lines;
  for (const OptionWords& option : command.options) {
    if (option.names.empty()) {
      const std::string where = option.is_repeated ? "*" : option.is_required ? "" : ":";
      lines += fmt::format(
          " \\\n      {}",
          shell_quoted(fmt::format("{}:{}:{}", where, option.place, zsh_action(option))));
      continue;
    }
    for (const std::string& name : option.names) {
      const std::string take =
          option.value.empty() ? "" : fmt::format(":{}:{}", option.value, zsh_action(option));
      lines +=
          fmt::format(" \\\n      {}",
                      shell_quoted(fmt::format("*{}[{}]{}", name, zsh_about(option.about), take)));
    }
  }
  return lines;
}

std::string zsh_function(const CommandWords& command) {
  return "_" + replaced(command.path, ' ', "_");
}

/// A function for each command; one with commands below it hands over to theirs.
std::string zsh_functions(const CommandWords& command) {
  std::string text;
  for (const CommandWords& below : command.commands) text += zsh_functions(below);
  text += zsh_function(command) + "() {\n";
  if (command.commands.empty()) return text + "  _arguments -s" + zsh_options(command) + "\n}\n";
  text += "  local line state\n  _arguments -s -C" + zsh_options(command) +
          " \\\n      '1:command:->command' \\\n      '*::argument:->argument'\n"
          "  case $state in\n    command)\n      local -a commands=(\n";
  for (const CommandWords& below : command.commands)
    text +=
        "        " + shell_quoted(below.name() + ":" + replaced(below.about, ':', "\\:")) + "\n";
  text +=
      "      )\n      _describe command commands\n      ;;\n    argument)\n      case $line[1] "
      "in\n";
  for (const CommandWords& below : command.commands)
    text += fmt::format("        {}) {} ;;\n", below.name(), zsh_function(below));
  return text + "      esac\n      ;;\n  esac\n}\n";
}

// --- fish ----------------------------------------------------------------------------------------

std::string fish_quoted(std::string_view text) {
  return "'" + replaced(replaced(text, '\\', "\\\\"), '\'', "\\'") + "'";
}

/// Holds where the words so far are those of this command, and of none below it.
std::string fish_condition(const CommandWords& command) {
  std::string condition;
  const std::size_t space = command.path.find(' ');
  const std::string below = space == std::string::npos ? "" : command.path.substr(space + 1);
  for (std::size_t begin = 0; begin < below.size();) {
    const std::size_t end = std::min(below.find(' ', begin), below.size());
    condition += fmt::format("{}__fish_seen_subcommand_from {}", condition.empty() ? "" : "; and ",
                             below.substr(begin, end - begin));
    begin = end + 1;
  }
  if (!command.commands.empty())
    condition +=
        fmt::format("{}not __fish_seen_subcommand_from {}", condition.empty() ? "" : "; and ",
                    fmt::join(command_names(command), " "));
  return fish_quoted(condition);
}

std::string fish_option(const CommandWords& command, const OptionWords& option) {
  std::string line = "complete -c slipcheck -n " + fish_condition(command);
  for (const std::string& name : option.names)
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (!option.choices.empty())
    line += fmt::format(" {} -a {}", option.names.empty() ? "-f" : "-x",
                        fish_quoted(fmt::format("{}", fmt::join(option.choices, " "))));
  else if (option.value == "TEXT")
    line += option.names.empty() ? " -F" : " -r -F";
  else if (!option.value.empty())
    line += " -x";
  return line + " -d " + fish_quoted(option.about) + "\n";
}

}  // namespace

std::string bash_completion(const CommandWords& top) {
  std::string commands, values, words;
  for (const CommandWords* command : all_commands(top)) {
    if (!command->commands.empty())
      for (const CommandWords& below : command->commands)
        commands += fmt::format("      '{} {}') path+=' {}' ;;\n", command->path, below.name(),
                                below.name());
    values += bash_values(*command);
    words += fmt::format("    '{}') words='{}' ;;\n", command->path,
                         fmt::join(words_after(*command), " "));
  }
  return fmt::format(R"(# bash completion for slipcheck, made by `slipcheck completion bash`.
_slipcheck() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} path=slipcheck words='' word
  for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
    case "$path $word" in
{}    esac
  done
  case "$path $before" in
{}    *) case $path in
{}    esac ;;
  esac
  COMPREPLY=($(compgen -W "$words" -- "$current"))
}}
complete -o default -F _slipcheck slipcheck
)",
                     commands, values, words);
}

std::string zsh_completion(const CommandWords& top) {
  return "#compdef slipcheck\n# Made by `slipcheck completion zsh`.\n" + zsh_functions(top) +
         "if [ \"$funcstack[1]\" = _slipcheck ]; then\n  _slipcheck \"$@\"\nelse\n"
         "  compdef _slipcheck slipcheck\nfi\n";
}

std::string fish_completion(const CommandWords& top) {
  std::string text = "# fish completion for slipcheck, made by `slipcheck completion fish`.\n";
  for (const CommandWords* command : all_commands(top)) {
    for (const CommandWords& below : command->commands)
      text += fmt::format("complete -c slipcheck -n {} -f -a {} -d {}\n", fish_condition(*command),
                          below.name(), fish_quoted(below.about));
    for (const OptionWords& option : command->options) text += fish_option(*command, option);
  }
  return text;
}

}  // namespace slipcheck
