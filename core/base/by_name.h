#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <memory_resource>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

namespace slipcheck {

/// Values in the order of their names, all in one piece of memory; the names' texts, which it
/// copies, lie in a few.
template <class Value>
class ByName {
  using Values = std::vector<std::pair<std::string_view, Value>>;

 public:
  using key_type = std::string_view;
  using mapped_type = Value;
  using value_type = typename Values::value_type;
  using iterator = typename Values::iterator;
  using const_iterator = typename Values::const_iterator;

  ByName() = default;
  ByName(std::initializer_list<value_type> values) {
    for (const auto& [name, value] : values) emplace(name, value);
  }
  ByName(ByName&&) noexcept = default;
  ByName& operator=(ByName&&) noexcept = default;
  ByName(const ByName& other) {
    reserve(other.size());
    for (const auto& [name, value] : other) append(name, value);
  }
  ByName& operator=(const ByName& other) { return *this = ByName(other); }
  ~ByName() = default;

  iterator begin() { return values_.begin(); }
  iterator end() { return values_.end(); }
  const_iterator begin() const { return values_.begin(); }
  const_iterator end() const { return values_.end(); }
  std::size_t size() const { return values_.size(); }
  bool empty() const { return values_.empty(); }
  bool operator==(const ByName& other) const { return values_ == other.values_; }

  const_iterator find(std::string_view name) const {
    const const_iterator place = place_of(name);
    return is_at(place, name) ? place : end();
  }
  bool contains(std::string_view name) const { return find(name) != end(); }
  /// Throws std::out_of_range where there is none.
  const Value& at(std::string_view name) const {
    const const_iterator found = find(name);
    if (found == end()) throw std::out_of_range("no value of this name");
    return found->second;
  }
  Value& at(std::string_view name) { return const_cast<Value&>(std::as_const(*this).at(name)); }

  void reserve(std::size_t count) { values_.reserve(count); }
  void clear() { *this = ByName(); }
  /// The value of that name, a new one where there is none.
  Value& operator[](std::string_view name) { return emplace(name, Value{}); }
  /// The value of that name, this one where there is none.
  Value& emplace(std::string_view name, Value value) {
    const const_iterator place = place_of(name);
    if (is_at(place, name)) return values_[static_cast<std::size_t>(place - begin())].second;
    return values_.emplace(place, kept(name), std::move(value))->second;
  }
  /// Of a name that comes after all that are there: no name is looked at.
  void append(std::string_view name, Value value) {
    assert(empty() || values_.back().first < name);
    values_.emplace_back(kept(name), std::move(value));
  }
  /// Does nothing where there is none.
  void erase(std::string_view name) {
    const const_iterator place = place_of(name);
    if (is_at(place, name)) values_.erase(place);
  }

 private:
  const_iterator place_of(std::string_view name) const {
    return std::ranges::lower_bound(values_, name, {}, &value_type::first);
  }
  bool is_at(const_iterator place, std::string_view name) const {
    return place != end() && place->first == name;
  }
  std::string_view kept(std::string_view name) {
    if (!texts_) texts_ = std::make_unique<std::pmr::monotonic_buffer_resource>();
    char* const text = static_cast<char*>(texts_->allocate(name.size(), alignof(char)));
    name.copy(text, name.size());
    return {text, name.size()};
  }

  std::unique_ptr<std::pmr::monotonic_buffer_resource> texts_;
  Values values_;
};

/// The value of that name in a map, null where it has none.
template <class Map, class Name>
const typename Map::mapped_type* find_in(const Map& map, const Name& name) {
  const auto found = map.find(name);
  return found == map.end() ? nullptr : &found->second;
}

}  // namespace slipcheck
