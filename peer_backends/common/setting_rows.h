#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "engine/engine.h"

namespace slipcheck {

/// The table of an engine's settings, a row for each member of the struct `S` that holds them, with
/// the way between the two. A fresh S has the values that the engine ships with.
template <class S>
class SettingRows {
 public:
  /// A row and what else may be said of it.
  struct Row {
    SettingInfo info;
    std::function<void(S&, const Setting&)> read;
    std::function<Setting(const S&)> write;

    Row& about(std::string text) {
      info.about = std::move(text);
      return *this;
    }
    Row& within(double low, double high) {
      info.low = low;
      info.high = high;
      return *this;
    }
    Row& try_each(std::vector<Setting> candidates) {
      info.candidates = std::move(candidates);
      return *this;
    }
    Row& search(double low, double high) {
      info.range = SettingInfo::Range{low, high, low > 0};
      return *this;
    }
  };

  Row& flag(std::string name, bool S::*member) {
    Row& row = add(std::move(name), S{}.*member);
    row.read = [member](S& to, const Setting& value) { to.*member = std::get<bool>(value); };
    row.write = [member](const S& from) { return Setting(from.*member); };
    return row;
  }
  /// >= 0 unless within() says otherwise.
  Row& number(std::string name, std::string unit, double S::*member) {
    Row& row = add(std::move(name), S{}.*member);
    row.info.unit = std::move(unit);
    row.info.low = 0;
    row.read = [member](S& to, const Setting& value) { to.*member = std::get<double>(value); };
    row.write = [member](const S& from) { return Setting(from.*member); };
    return row;
  }
  Row& count(std::string name, int S::*member) {
    Row& row = add(std::move(name), static_cast<double>(S{}.*member));
    row.info.whole = true;
    row.info.low = 0;
    row.read = [member](S& to, const Setting& value) {
      to.*member = static_cast<int>(std::get<double>(value));
    };
    row.write = [member](const S& from) { return Setting(static_cast<double>(from.*member)); };
    return row;
  }
  /// `words` for the values of an enumeration from 0 on.
  template <class Enum>
  Row& word(std::string name, Enum S::*member, std::vector<std::string> words) {
    const auto index = [](Enum value) { return static_cast<std::size_t>(value); };
    Row& row = add(std::move(name), words[index(S{}.*member)]);
    row.info.choices = words;
    row.read = [member, words](S& to, const Setting& value) {
      const std::string& text = std::get<std::string>(value);
      for (std::size_t k = 0; k < words.size(); ++k)
        if (words[k] == text) to.*member = static_cast<Enum>(k);
    };
    row.write = [member, words, index](const S& from) {
      return Setting(words[index(from.*member)]);
    };
    return row;
  }

  std::vector<SettingInfo> infos() const {
    std::vector<SettingInfo> infos;
    for (const Row& row : rows_) infos.push_back(row.info);
    return infos;
  }
  /// `chosen` names only settings of the table, with values of their types and in their ranges.
  S read(const Settings& chosen) const {
    S settings;
    for (const Row& row : rows_) {
      const auto found = chosen.find(row.info.name);
      if (found != chosen.end()) row.read(settings, found->second);
    }
    return settings;
  }
  /// All of them, by name.
  Settings write(const S& settings) const {
    Settings all;
    for (const Row& row : rows_) all.emplace(row.info.name, row.write(settings));
    return all;
  }

 private:
  Row& add(std::string name, Setting shipped) {
    Row row;
    row.info.name = std::move(name);
    row.info.shipped = std::move(shipped);
    rows_.push_back(std::move(row));
    return rows_.back();
  }
  std::vector<Row> rows_;
};

}  // namespace slipcheck
