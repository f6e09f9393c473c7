#pragma once

#include "app/first_meeting.h"
#include "reference/contact_scene.h"
#include "scenario/scenario.h"

namespace slipcheck {

/// Prints who meets first, when and how, and where their contact is linear and they roll into a
/// central collision what closed forms say of it (pair_insight.h).
void explain_meeting(const Scenario& scenario, const ContactScene& scene, const Meeting& meeting);

}  // namespace slipcheck
