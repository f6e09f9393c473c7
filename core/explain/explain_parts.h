#pragma once

#include <cstddef>
#include <optional>

#include "explain/explain_rows.h"
#include "explain/first_meeting.h"
#include "physics/contact/linear_contact.h"
#include "scenario/scenario.h"
#include "scene/contact_scene.h"

// The parts of explain_scene().

namespace slipcheck {

/// A row for each body, or for several in a row that look alike: size, inertia, speed, and on a
/// substrate the slip on it.
ExplainSection explain_bodies(const Scenario& scenario, const Scene& scene);

/// What follows from the numbers of a scene in a box: its floor's speed and acceleration, the bed
/// of bodies at rest, L's estimate of K/R, when it is looked at. Runs nothing.
ExplainSections explain_box(const Scenario& scenario, const ContactScene& scene);

/// The cell of a periodic substrate, how densely bodies cover it, and the mean free path beside the
/// distance that one collision makes them slide; nothing where it does not repeat itself.
ExplainSections explain_gas(const Scene& scene);

/// What follows from the parameters of each contact between bodies, and with a box, for the two
/// that meet first or else the first that can have it: duration, restitution, stiffness, damping,
/// step limits. What depends on the speed is told at that of the first meeting, or at
/// `typical_speed` [m/s], > 0, where there is none.
ExplainSections explain_contacts(const Scenario& scenario, const ContactScene& scene,
                                 const std::optional<Meeting>& meeting, double typical_speed);

/// The contact of two bodies as K (2), if it is linear.
std::optional<LinearContact> linear_contact_between(const ContactScene& scene, std::size_t i,
                                                    std::size_t j);

/// Who meets first, when and how, and where their contact is linear and they roll into a central
/// collision what closed forms say of it (pair_insight.h).
ExplainSections explain_meeting(const Scenario& scenario, const ContactScene& scene,
                                const Meeting& meeting);

}  // namespace slipcheck
