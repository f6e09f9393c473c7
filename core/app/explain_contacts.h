#pragma once

#include <optional>

#include "scenario/scenario.h"

namespace slipcheck {

/// Prints what follows from each linear contact's parameters for the first bodies that have it:
/// t_col, e_n, γ_N, ω0, ε, k, C.
void explain_contacts(const Scenario& scenario);

/// The scene with every linear contact replaced by a hard one of its restitution, without rubbing;
/// nothing if another model is in the way. Closed forms hold for it whatever the contact's law.
std::optional<Scenario> hard_equivalent(const Scenario& scenario);

}  // namespace slipcheck
