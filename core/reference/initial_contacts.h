#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "scene/contact_scene.h"

namespace slipcheck {

/// Two bodies that overlap from the start.
struct InitialContact {
  std::size_t first = 0, second = 0;  ///< first < second
  double overlap = 0;                 ///< ξ [m], > 0
};

/// All of them, in order; touching within round-off is no overlap. None in a box or on a periodic
/// plane, where nothing overlaps at the start.
std::vector<InitialContact> overlapping_pairs(const Scene& scene,
                                              std::span<const BodyState> states);

/// Those whose contact is soft.
std::vector<InitialContact> initial_contacts(const ContactScene& scene,
                                             std::span<const BodyState> states);

/// √(2E/m̄), the speed that the energy E(ξ) of an overlap gives two free bodies [m/s].
double release_speed(const SoftContact& contact, double overlap, double reduced_mass);

/// The largest of these contacts [m/s], 0 where there are none.
double release_speed(const ContactScene& scene, std::span<const InitialContact> contacts);

/// speed_scale() of the initial states, and what their overlaps release [m/s].
double speed_scale(const ContactScene& scene);

}  // namespace slipcheck
