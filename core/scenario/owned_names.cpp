#include "scenario/owned_names.h"

#include <fmt/format.h>
#include <fnmatch.h>

#include <map>
#include <utility>
#include <vector>

#include "scenario/rules/rules.h"

namespace slipcheck {
namespace {

using nlohmann::json;

/// What may stand before the observable's name, as a regular expression.
std::string owner_pattern(ObservableScope scope, Wildcards wildcards) {
  if (scope == ObservableScope::all) return "all";
  const char* word = wildcards == Wildcards::yes ? "[A-Za-z0-9_*]+" : "[A-Za-z0-9_]+";
  const bool is_pair = scope == ObservableScope::pair;
  const std::string joined = fmt::format("{0}(-{0}){1}", word, is_pair ? '+' : '*');
  return is_pair && wildcards == Wildcards::yes ? fmt::format(R"((\*|{}))", joined) : joined;
}

/// Whether the text has that form: words that are joined by '-'.
bool has_form_of_owner(std::string_view text, ObservableScope scope, Wildcards wildcards) {
  if (scope == ObservableScope::all) return text == "all";
  bool after_word = false, is_joined = false;
  for (const char c : text) {
    const bool of_word = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                         (c >= '0' && c <= '9') || c == '_' ||
                         (c == '*' && wildcards == Wildcards::yes);
    if (!of_word && !(c == '-' && after_word)) return false;
    is_joined |= c == '-';
    after_word = of_word;
  }
  return after_word && (scope == ObservableScope::body || is_joined || text == "*");
}

}  // namespace

std::string fault_of_owned_name(std::string_view name, Wildcards wildcards) {
  const ObservableKey key = observable_key(name);
  const ObservableName* observable = key.known();
  if (!observable) {
    std::vector<std::string> known;
    for (const ObservableName& each : observable_names()) known.emplace_back(each.name);
    const std::string near = nearest(key.bare(), known);
    return near.empty() ? "must be an observable of a body, a pair or all, as in i.sliding_time"
                        : fmt::format("must be an observable (did you mean {}?)", near);
  }
  if (has_form_of_owner(key.owner, observable->scope, wildcards)) return "";
  const char* example = observable->scope == ObservableScope::body   ? "a body, i."
                        : observable->scope == ObservableScope::pair ? "a pair, i-j."
                                                                     : "the scene, all.";
  return fmt::format("must be of {}{}", example, key.bare());
}

json owned_names_schema(Wildcards wildcards,
                        const std::function<json(const ObservableName&)>& schema_of) {
  // Observables with the same form of owner and the same dimension share a pattern.
  std::map<std::pair<ObservableScope, std::string>, std::vector<const ObservableName*>> alike;
  for (const ObservableName& each : observable_names())
    alike[{each.scope, each.dimension.name}].push_back(&each);
  json schemas = json::object();
  for (const auto& [key, group] : alike) {
    std::string names;
    for (const ObservableName* each : group)
      names += fmt::format("{}{}{}", names.empty() ? "" : "|", each->name,
                           each->is_vector ? R"((\.[xyz])?)" : "");
    const std::string pattern =
        fmt::format(R"(^{}\.({})$)", owner_pattern(group[0]->scope, wildcards), names);
    schemas[pattern] = schema_of(*group[0]);
  }
  return schemas;
}

bool matches(std::string_view pattern, std::string_view text) {
  return fnmatch(std::string(pattern).c_str(), std::string(text).c_str(), FNM_NOESCAPE) == 0;
}

}  // namespace slipcheck
