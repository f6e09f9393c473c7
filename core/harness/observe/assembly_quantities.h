#pragma once

#include <span>

#include "harness/observe/assembly.h"

namespace slipcheck {

/// A number that tells of an AssemblyState, as tables name it.
struct AssemblyQuantity {
  const char* name;
  const char* unit;  ///< "" of a pure number
  double (*of)(const AssemblyState& state);
};

std::span<const AssemblyQuantity> assembly_quantities();

}  // namespace slipcheck
