#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "engine/engine.h"

namespace slipcheck {

/// A row of the table of an engine's settings, and the way between it and the struct `S` in which
/// the adapter keeps them. The struct's own values are what the engine ships with.
template <class S>
struct SettingRow {
  SettingInfo info;
  std::function<void(S&, const Setting&)> read;
  std::function<Setting(const S&)> write;

  SettingRow& about(std::string text) {
    info.about = std::move(text);
    return *this;
  }
  SettingRow& within(double low, double high) {
    info.low = low;
    info.high = high;
    return *this;
  }
  SettingRow& try_each(std::vector<Setting> candidates) {
    info.candidates = std::move(candidates);
    return *this;
  }
  SettingRow& search(double low, double high, bool logarithmic = false) {
    info.range = SettingInfo::Range{low, high, logarithmic};
    return *this;
  }
};

/// A row for each kind of member of `S`. Numbers and counts are >= 0 unless told otherwise.
template <class S>
struct SettingRows {
  using Row = SettingRow<S>;

  static Row row(std::string name, Setting shipped) {
    Row row;
    row.info.name = std::move(name);
    row.info.shipped = std::move(shipped);
    return row;
  }

  static Row flag(std::string name, bool S::*member) {
    Row made = row(std::move(name), S{}.*member);
    made.read = [member](S& to, const Setting& value) { to.*member = std::get<bool>(value); };
    made.write = [member](const S& from) { return Setting(from.*member); };
    return made.try_each({true, false});
  }

  static Row number(std::string name, std::string unit, double S::*member) {
    Row made = row(std::move(name), S{}.*member);
    made.info.unit = std::move(unit);
    made.info.low = 0;
    made.read = [member](S& to, const Setting& value) { to.*member = std::get<double>(value); };
    made.write = [member](const S& from) { return Setting(from.*member); };
    return made;
  }

  static Row count(std::string name, int S::*member) {
    Row made = row(std::move(name), static_cast<double>(S{}.*member));
    made.info.whole = true;
    made.info.low = 0;
    made.read = [member](S& to, const Setting& value) {
      to.*member = static_cast<int>(std::get<double>(value));
    };
    made.write = [member](const S& from) { return Setting(static_cast<double>(from.*member)); };
    return made;
  }

  /// `words` in the order of the enumeration.
  template <class Enum>
  static Row word(std::string name, Enum S::*member, std::vector<std::string> words) {
    const auto index = [](Enum value) { return static_cast<std::size_t>(value); };
    Row made = row(std::move(name), words[index(S{}.*member)]);
    made.info.choices = words;
    for (const std::string& each : words) made.info.candidates.emplace_back(each);
    made.read = [member, words](S& to, const Setting& value) {
      const std::string& text = std::get<std::string>(value);
      for (std::size_t k = 0; k < words.size(); ++k)
        if (words[k] == text) to.*member = static_cast<Enum>(k);
    };
    made.write = [member, words, index](const S& from) {
      return Setting(words[index(from.*member)]);
    };
    return made;
  }
};

/// What the rows tell of themselves.
template <class S>
std::vector<SettingInfo> infos_of(const std::vector<SettingRow<S>>& rows) {
  std::vector<SettingInfo> infos;
  for (const SettingRow<S>& each : rows) infos.push_back(each.info);
  return infos;
}

/// `chosen` names only settings of the rows, with values of their types and in their ranges.
template <class S>
S read_rows(const std::vector<SettingRow<S>>& rows, const Settings& chosen) {
  S settings;
  for (const SettingRow<S>& each : rows) {
    const auto found = chosen.find(each.info.name);
    if (found != chosen.end()) each.read(settings, found->second);
  }
  return settings;
}

/// All of them, by name.
template <class S>
Settings write_rows(const std::vector<SettingRow<S>>& rows, const S& settings) {
  Settings all;
  for (const SettingRow<S>& each : rows) all.emplace(each.info.name, each.write(settings));
  return all;
}

}  // namespace slipcheck
