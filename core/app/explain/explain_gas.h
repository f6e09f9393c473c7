#pragma once

#include "scene/scene.h"

namespace slipcheck {

/// Prints the cell of a periodic substrate, how densely bodies cover it, and the mean free path
/// beside the distance that one collision makes them slide.
void explain_gas(const Scene& scene);

}  // namespace slipcheck
