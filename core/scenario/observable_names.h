#pragma once

#include <span>
#include <string_view>

#include "scenario/units.h"

namespace slipcheck {

/// What an observable belongs to.
enum class ObservableScope { body, pair, all };

struct ObservableName {
  std::string_view name;  ///< "sliding_time", without the body's name
  std::string_view doc;
  Dimension dimension;
  ObservableScope scope;
  bool is_vector = false;       ///< has the components .x, .y and .z
  bool is_restitution = false;  ///< its errors are absolute
};

/// All observables, in alphabetical order.
std::span<const ObservableName> observable_names();

/// The observable of this name, without a component; null if there is none.
const ObservableName* find_observable(std::string_view name);

}  // namespace slipcheck
