#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

namespace slipcheck {

/// What the values of an enumeration are called in files, in their order from 0 on. An enumeration
/// that has names specialises it where it is declared.
template <class Enum>
inline constexpr std::array<const char*, 0> kNamesOf{};

template <class Enum>
requires(!kNamesOf<Enum>.empty()) constexpr const char* name_of(Enum value) {
  return kNamesOf<Enum>[static_cast<std::size_t>(value)];
}

}  // namespace slipcheck
