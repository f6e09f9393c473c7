#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "scene/contact_scene.h"

namespace slipcheck {

/// Whether a weight on the substrate rubs, which can press bodies together.
bool is_rubbed(const Scene& scene);

/// Whether hard spheres of this scene stay in contact, which collisions at instants cannot show:
/// nothing moves at the start and a body above the plane rests on others, or a pair does not
/// rebound at all (e_n = 0) while friction with the substrate, or a third body, can press it
/// together.
bool has_lasting_contacts(const Scene& scene);

/// Whether bodies rested on others at the start and no longer do so in `states`: one has moved by
/// more than 1e-2 of its radius.
bool has_come_apart(const Scene& scene, std::span<const BodyState> states);

/// The duration of a collision [s] that is short against all that the scene does otherwise: 1e-4 of
/// the time in which its smallest body falls, or moves, by its own radius; 1e-3 of it where bodies
/// rest on each other, whose contacts have nothing else to be short against.
double short_collision_time(const Scene& scene);

/// The hard scene with contacts that last: the linear law of each pair's restitution, at least
/// 1e-5, whose collisions take `collision_time` [s], and viscous friction up to the same Coulomb
/// limit, which holds but for a creep. Between bodies that rest on each other nothing collides, and
/// their contacts are at least critically damped. Nothing where a pair has no such law: its
/// restitution depends on the speed, or friction gives back a part of the slip; and where the
/// integrator does not run the scene: in a box, on a periodic plane, with too many bodies.
std::optional<ContactScene> with_lasting_contacts(const Scene& scene, double collision_time);
/// The same with short_collision_time().
std::optional<ContactScene> with_lasting_contacts(const Scene& scene);

/// Bodies in contacts that last which ContactSolver, whose steps all bodies share, is given at
/// most.
inline constexpr std::size_t kMostIntegrated = 200;

}  // namespace slipcheck
