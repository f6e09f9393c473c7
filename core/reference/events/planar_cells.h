#pragma once

#include <cstdint>
#include <span>

#include "physics/sphere.h"
#include "reference/events/cell_grid.h"
#include "scene/scene.h"

namespace slipcheck {

/// Cells for the bodies of a planar scene (PlanarWorld), about one body to a cell where it is as
/// dense as at the start, and none smaller than the largest body. Empty.
CellGrid planar_cells(const Scene& scene, std::span<const BodyState> initial);

/// Bits of both numbers in turn (Morton): what lies close in the plane lies close in the order.
std::uint64_t morton_number(std::uint32_t x, std::uint32_t y);

}  // namespace slipcheck
