#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "scenario/rules/rules.h"
#include "scenario/rules/scene_rules.h"

namespace slipcheck {

// The parts of a contact, each written by a rule of its own; contact_rules.cpp puts them together.

/// "normal": the force along the line of centres.
Rule<NormalModel> normal_rule();
/// "tangential": the force across it.
Rule<TangentialModel> tangential_rule();
/// "rolling" between two bodies: the torque against rolling on each other.
Rule<std::optional<RollingResistance>> rolling_resistance_rule();
/// "rolling" on the substrate: μ_r of K (16), or a table of it over the speed.
Rule<RollingLaw> rolling_rule();
/// "drilling" on the substrate: friction against spin about the vertical.
Rule<Drilling> drilling_rule();

/// Coulomb's coefficients: one number, or {static: …, kinetic: …}.
Rule<FrictionCoefficients> friction_rule();

/// Speed (m/s) and coefficient; that the speeds rise is checked later.
using SpeedTable = std::vector<std::pair<double, double>>;
Rule<SpeedTable> speed_table_rule();

}  // namespace slipcheck
