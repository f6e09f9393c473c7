#include "app/command_words.h"

#include <string_view>

namespace slipcheck {
namespace {

/// "a", "b" of "{a,b}".
std::vector<std::string> list_in_braces(std::string_view text) {
  std::vector<std::string> items;
  if (!text.starts_with('{') || !text.ends_with('}')) return items;
  text = text.substr(1, text.size() - 2);
  while (true) {
    const std::size_t comma = text.find(',');
    items.emplace_back(text.substr(0, comma));
    if (comma == std::string_view::npos) return items;
    text.remove_prefix(comma + 1);
  }
}

OptionWords words_of(const CLI::Option& option) {
  OptionWords words;
  for (const std::string& name : option.get_snames()) words.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) words.names.push_back("--" + name);
  if (words.names.empty()) words.place = option.get_name(true);
  words.about = option.get_description();
  words.is_required = option.get_required();
  if (option.get_items_expected_max() > 0) {
    // "UINT:INT in [1 - 360]", "TEXT:{single,double}"
    const std::string type = option.get_type_name();
    const std::size_t colon = type.find(':');
    words.value = type.substr(0, colon);
    if (colon != std::string::npos) words.rule = type.substr(colon + 1);
    words.choices = list_in_braces(words.rule);
    words.is_repeated = option.get_expected_max() > 1;
    words.usual = option.get_default_str();
  }
  return words;
}

CommandWords words_of(const CLI::App& app, const std::string& path) {
  CommandWords words;
  words.path = path;
  words.about = app.get_description();
  words.footer = app.get_footer();
  for (const CLI::Option* option : app.get_options()) words.options.push_back(words_of(*option));
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    words.commands.push_back(words_of(*command, path + " " + command->get_name()));
  return words;
}

void collect(const CommandWords& command, std::vector<const CommandWords*>& all) {
  all.push_back(&command);
  for (const CommandWords& below : command.commands) collect(below, all);
}

}  // namespace

std::string CommandWords::name() const { return path.substr(path.rfind(' ') + 1); }

CommandWords command_words(const CLI::App& app) { return words_of(app, "slipcheck"); }

std::vector<const CommandWords*> all_commands(const CommandWords& top) {
  std::vector<const CommandWords*> all;
  collect(top, all);
  return all;
}

}  // namespace slipcheck
