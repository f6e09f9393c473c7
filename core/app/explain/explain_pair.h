#pragma once

#include "app/explain/first_meeting.h"
#include "scenario/scenario.h"
#include "scene/contact_scene.h"

namespace slipcheck {

/// Prints who meets first, when and how, and where their contact is linear and they roll into a
/// central collision what closed forms say of it (pair_insight.h).
void explain_meeting(const Scenario& scenario, const ContactScene& scene, const Meeting& meeting);

}  // namespace slipcheck
