#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "engine/engine.h"
#include "peer_backends/shared/contact_values.h"

namespace slipcheck::peer {

/// The numbers of a body's contact with another or with a surface, as the engine has them.
using ValuesOf = std::function<ContactValues(int body, int other)>;

/// The first body of each material that there is.
std::vector<std::size_t> one_of_each_material(const Scene& scene);

/// Adds friction, restitution and, on the substrate, rolling and drilling lengths to the settings
/// in force: one entry of a name where all contacts have the same, else one for each body or two
/// bodies that stand for their materials. What depends on how bodies move is told in words.
void add_coefficients(Settings& settings, const Scene& scene, SlipRule rule, const ValuesOf& of);

/// Step [s] and gravity [m/s²].
void add_world(Settings& settings, const Scene& scene, double time_step);

}  // namespace slipcheck::peer
