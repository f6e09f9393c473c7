#pragma once

#include "scenario/scenario.h"

namespace slipcheck {

/// All lengths times lambda, > 0, at the same gravity and densities (Froude's similarity): times
/// and speeds times √λ, masses times λ³, and every quantity of the scene by its dimension, contact
/// laws, limits of the run, tolerances with a unit and rates of engines included. What happens is
/// exactly similar; what an engine shows otherwise comes from lengths, speeds or times of its own.
/// Expectations of engines are dropped: they are of the scene as it was.
Scenario scaled_lengths(Scenario scenario, double lambda);

}  // namespace slipcheck
