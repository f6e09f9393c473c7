#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "physics/vector.h"
#include "scenario/reading.h"
#include "scenario/units.h"
#include "scenario/yaml_tree.h"

namespace slipcheck {

// What may stand at a place of a file. A rule both reads a node into a T and says the same as JSON
// Schema (draft-07); the two lie side by side so that they cannot drift apart.

template <class T>
struct Rule {
  using Value = T;
  /// Reads the node into the target; false after noting what is wrong with it.
  std::function<bool(const YamlNode&, Reading&, T&)> read;
  std::function<nlohmann::json()> schema;
};

/// Limits of a number in the unit of a bare one; angles in degrees.
struct Range {
  std::optional<double> least;  ///< >=
  std::optional<double> above;  ///< >
  std::optional<double> most;   ///< <=
  std::optional<double> below;  ///< <
};
inline const Range kAnyNumber{};
inline const Range kPositive{{}, 0, {}, {}};
inline const Range kNotNegative{0, {}, {}, {}};
inline const Range kFraction{0, {}, 1, {}};  ///< [0, 1]

/// A number in the file's units, or a text with its own unit; SI in the target.
Rule<double> number(const Dimension& dimension, const Range& range);
/// A whole number without a unit.
Rule<std::int64_t> integer(std::int64_t least, std::int64_t most);
Rule<bool> boolean();

/// Any text that is not empty.
Rule<std::string> free_text();
/// A name: words of letters, digits and '_', joined by '-'; `lower_case` without capitals and '_',
/// `engine` as that and with a version, "rapier@0.19.3".
enum class NameStyle { any_case, lower_case, engine };
Rule<std::string> name_text(NameStyle style);

/// [x, y], [x, y, z]: a list of numbers with as many entries as one of the counts.
Rule<std::vector<double>> numbers(const Dimension& dimension, const Range& range,
                                  const std::vector<std::size_t>& counts);
/// A row of a table, each column with its own dimension: [t, x, y].
Rule<std::vector<double>> row(const std::vector<std::pair<Dimension, Range>>& columns);
/// [x, y].
Rule<Vector2> pair_of(const Dimension& dimension, const Range& range);
/// [x, y, z].
Rule<Vector3> triple_of(const Dimension& dimension, const Range& range);

/// One of some words. Reads its index.
Rule<std::size_t> word(std::vector<std::string> words);

template <class E>
Rule<E> choice(std::vector<std::pair<std::string, E>> meanings) {
  std::vector<std::string> words;
  for (const auto& meaning : meanings) words.push_back(meaning.first);
  Rule<std::size_t> rule = word(std::move(words));
  return {[rule, meanings](const YamlNode& node, Reading& reading, E& target) {
            std::size_t index = 0;
            if (!rule.read(node, reading, index)) return false;
            target = meanings[index].second;
            return true;
          },
          rule.schema};
}

/// Whether the node is a list of `least` to `most` items; notes the fault if it is not.
bool is_list(const YamlNode& node, Reading& reading, std::size_t least, std::size_t most);
nlohmann::json list_schema(nlohmann::json items, std::size_t least, std::size_t most);

inline constexpr std::size_t kNoLimit = 0;

/// A list of `least` to `most` (or kNoLimit) items.
template <class T>
Rule<std::vector<T>> list(Rule<T> item, std::size_t least, std::size_t most = kNoLimit) {
  return {[item, least, most](const YamlNode& node, Reading& reading, std::vector<T>& target) {
            if (!is_list(node, reading, least, most)) return false;
            bool good = true;
            target.clear();
            for (std::size_t i = 0; i < node.items.size(); ++i) {
              const auto step = reading.item(i, *node.items[i]);
              T value{};
              good = item.read(*node.items[i], reading, value) && good;
              target.push_back(std::move(value));
            }
            return good;
          },
          [item, least, most] { return list_schema(item.schema(), least, most); }};
}

/// Reads by what kind of thing stands there: each alternative says which nodes it claims.
template <class T>
struct Form {
  std::function<bool(const YamlNode&)> claims;
  Rule<T> rule;
};

/// The first form that claims the node reads it; `expectation` is the fault where none does.
template <class T>
Rule<T> one_form_of(const std::string& expectation, std::vector<Form<T>> forms) {
  return {[expectation, forms](const YamlNode& node, Reading& reading, T& target) {
            for (const Form<T>& form : forms) {
              if (form.claims(node)) return form.rule.read(node, reading, target);
            }
            reading.fault(node, expectation);
            return false;
          },
          [forms] {
            nlohmann::json alternatives = nlohmann::json::array();
            for (const Form<T>& form : forms) alternatives.push_back(form.rule.schema());
            return nlohmann::json{{"anyOf", alternatives}};
          }};
}

/// The same rule, which also notes in the target where it was read and whether all of it was.
template <class T>
Rule<T> placed(Rule<T> rule) {
  return {[rule](const YamlNode& node, Reading& reading, T& target) {
            target.path = reading.path();
            target.complete = rule.read(node, reading, target);
            return target.complete;
          },
          rule.schema};
}

/// The same rule for a T that is made from what the rule reads.
template <class T, class U, class Make>
Rule<T> made_from(Rule<U> rule, Make make) {
  return {[rule, make](const YamlNode& node, Reading& reading, T& target) {
            U value{};
            if (!rule.read(node, reading, value)) return false;
            target = make(std::move(value));
            return true;
          },
          rule.schema};
}

/// The same rule for a variant that holds a T among others; keeps what could be read.
template <class V, class T>
Rule<V> as_alternative(Rule<T> rule) {
  return {[rule](const YamlNode& node, Reading& reading, V& target) {
            return rule.read(node, reading, target.template emplace<T>());
          },
          rule.schema};
}

bool is_scalar(const YamlNode& node);
bool is_list(const YamlNode& node);
bool is_mapping(const YamlNode& node);
/// Claims a scalar that is this word.
std::function<bool(const YamlNode&)> is_word(std::string expected);

/// "a, b or c"
std::string joined(const std::vector<std::string>& words);

/// The word with the fewest edits from what was written, "" where none is near.
std::string nearest(const std::string& written, const std::vector<std::string>& words);
/// " (did you mean tuned?)", "" where none is near.
std::string did_you_mean(const std::string& written, const std::vector<std::string>& words);

}  // namespace slipcheck
