#pragma once

#include <vector>

#include "scenario/reading.h"
#include "scenario/written_scene.h"

namespace slipcheck {

/// A box as its plates.
std::vector<NamedSurface> plates_of(const WrittenSurface& surface, const BoxOfPlates& box);

/// Whether a surface is of this material.
bool is_of_surface(const std::string& material, const WrittenScene& written);

/// Every surface by itself, a box as its plates.
std::vector<NamedSurface> named_surfaces(const WrittenScene& written);

/// The shape and motion of a surface in numbers.
Surface made_surface(const NamedSurface& surface);

/// Its shape's highest place over a plane [m]; infinite for another plane that is not parallel.
double highest_over(const PlaneShape& plane, const SurfaceShape& shape);

/// How deep a body at a place is in a surface at the start [m]; negative beside it.
double overlap_of(const NamedSurface& surface, const Vector3& centre, double radius);

/// Faults of the surfaces by themselves: a belt that leaves its surface, a plane that turns out of
/// itself.
void check_surfaces(const WrittenScene& written, Reading& reading);

/// The surface that a body at a place touches at the start, up to rounding, or null.
const NamedSurface* touched_surface(const std::vector<NamedSurface>& surfaces,
                                    const Vector3& centre, double radius);

}  // namespace slipcheck
