#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "scene/contact_scene.h"

namespace slipcheck {

/// Whether a weight on the substrate rubs, which can press bodies together.
bool is_rubbed(const Scene& scene);

/// Whether nothing moves at the start, on a still plane and still surfaces, and gravity presses a
/// body that the plane does not carry onto another one below it.
bool rests_on_bodies(const Scene& scene);

/// Whether hard spheres of this scene are pressed together for good, which collisions at instants
/// cannot show: a pair does not rebound at all (e_n = 0) while friction with the substrate, or a
/// third body, can press it together.
bool has_lasting_contacts(const Scene& scene);

/// The duration of a collision [s] that is short against all that the scene does otherwise: 1e-4 of
/// the time in which its smallest body falls, or moves, by its own radius.
double short_collision_time(const Scene& scene);

/// The hard scene with contacts that last between pairs that do not rebound: the linear law of a
/// critically damped collision that takes `collision_time` [s], and viscous friction up to the same
/// Coulomb limit, which holds but for a creep; where all pairs rebound, that of each pair's
/// restitution, at least 1e-5. Nothing where a pair has no such law: its restitution depends on the
/// speed, or friction gives back a part of the slip; and where the integrator does not run the
/// scene: in a box, on a periodic plane, with too many bodies.
std::optional<ContactScene> with_lasting_contacts(const Scene& scene, double collision_time);
/// The same with short_collision_time().
std::optional<ContactScene> with_lasting_contacts(const Scene& scene);

/// Bodies in contacts that last which ContactSolver, whose steps all bodies share, is given at
/// most.
inline constexpr std::size_t kMostIntegrated = 200;

}  // namespace slipcheck
