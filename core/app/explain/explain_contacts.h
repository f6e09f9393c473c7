#pragma once

#include <optional>

#include "app/explain/first_meeting.h"
#include "physics/contact/linear_contact.h"
#include "scenario/scenario.h"
#include "scene/contact_scene.h"

namespace slipcheck {

/// Prints what follows from the parameters of each contact between bodies, and with a box, for the
/// two that meet first or else the first that can have it: duration, restitution, stiffness,
/// damping, step limits. What depends on the speed is told at that of the first meeting, or at
/// `typical_speed` [m/s], > 0, where there is none.
void explain_contacts(const Scenario& scenario, const ContactScene& scene,
                      const std::optional<Meeting>& meeting, double typical_speed);

/// The contact of two bodies as K (2), if it is linear.
std::optional<LinearContact> linear_contact_between(const ContactScene& scene, std::size_t i,
                                                    std::size_t j);

}  // namespace slipcheck
