#pragma once

#include <array>
#include <string>
#include <string_view>

#include "scenario/observable_names.h"

namespace slipcheck {

inline constexpr std::string_view kComponents = "xyz";

/// What a name as in "i.final_velocity.x" says; looks into the name that it was read from.
struct ObservableKey {
  std::string_view owner;       ///< "i", "i-j", "all", or a pattern of them; "" where none is named
  std::string_view observable;  ///< "final_velocity"; of an unknown one all that follows the owner
  char component = '\0';        ///< 'x', 'y' or 'z'; none of a scalar, nor of a vector as a whole

  /// Null if there is no such observable.
  const ObservableName* known() const { return find_observable(observable); }

  ObservableKey of(std::string_view other_owner) const;
  /// Of a component the vector.
  ObservableKey whole() const { return {owner, observable}; }
  std::string text() const;
  /// The same into a string that may have room for it.
  void write(std::string& all) const;
  /// The text without the owner: "final_velocity.x".
  std::string bare() const { return of("").text(); }
  /// The texts of the vector's components, whichever of them, or the whole, this is.
  std::array<std::string, 3> components() const;
};

/// Names of bodies have no dot. "final_velocity.x" is of nobody.
ObservableKey observable_key(std::string_view name);

/// The owner of what two bodies, or a body and the substrate, show together: "i-j".
std::string pair_owner(std::string_view first, std::string_view second);

}  // namespace slipcheck
