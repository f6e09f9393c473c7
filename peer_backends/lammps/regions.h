#pragma once

#include <cstddef>
#include <string>

#include "scene/scene.h"

namespace slipcheck::lammps {

/// A number that LAMMPS reads back as the same.
std::string exact(double value);

std::string region_name(std::size_t surface);

/// The commands that make a region of each surface beside the substrate for fix wall/gran/region,
/// its variables among them, in a world that starts at `time` [s]. A region's axes are the box's,
/// so that a plate or cylinder is turned into its place. A belt is a plane that moves along itself.
/// Throws Refused for a surface whose motion no region has.
std::string region_commands(const Scene& scene, double time);

}  // namespace slipcheck::lammps
