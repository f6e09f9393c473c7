#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace slipcheck {

// What the program knows of its own commands, in words, for manual pages and for shells.

/// An option or flag of a command.
struct OptionWords {
  std::vector<std::string> names;    ///< "-q", "--quiet"; empty of what has a place instead
  std::string place;                 ///< "FILE"; empty of options
  std::string about;                 ///< one line
  std::string value;                 ///< "TEXT", "UINT"; empty of a flag
  std::string rule;                  ///< what values it takes, "1 - 100000"; may be empty
  std::vector<std::string> choices;  ///< those values, where they are a list
  std::string usual;                 ///< where it is left out; may be empty
  bool is_required = false;
  bool is_repeated = false;  ///< takes more than one value
};

/// A command with all below it.
struct CommandWords {
  std::string path;   ///< "slipcheck engines add"
  std::string about;  ///< one line
  std::string footer;
  std::vector<OptionWords> options;
  std::vector<CommandWords> commands;

  std::string name() const;  ///< "add"
};

/// Of a program named slipcheck, whatever the file is called.
CommandWords command_words(const CLI::App& app);

/// That command and all below it, each before those below it.
std::vector<const CommandWords*> all_commands(const CommandWords& top);

}  // namespace slipcheck
