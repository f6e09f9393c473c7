#pragma once

#include <boost/container/flat_map.hpp>
#include <functional>
#include <string>

namespace slipcheck {

/// Values in the order of their names, all in one piece of memory: what comes in that order is put
/// at its end at once, by emplace_hint() there.
template <class Value>
using ByName = boost::container::flat_map<std::string, Value, std::less<>>;

/// The value of that name in a map, null where it has none.
template <class Map>
const typename Map::mapped_type* find_in(const Map& map, const std::string& name) {
  const auto found = map.find(name);
  return found == map.end() ? nullptr : &found->second;
}

}  // namespace slipcheck
