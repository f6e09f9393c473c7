#pragma once

#include <memory>
#include <variant>
#include <vector>

#include "harness/reference_run.h"
#include "reference/box_solver.h"
#include "reference/reference_solver.h"
#include "scenario/scenario.h"

namespace slipcheck {

/// A scene with its solver and its reference, which engines are then held against as often as
/// wanted.
struct PreparedScene {
  Scenario scenario;
  std::unique_ptr<const ContactScene> contact;  ///< the solver looks at it
  std::variant<ReferenceSolver, BoxSolver> solver;
  ReferenceResult reference;
};

/// Solves these scenes in their order. Throws Unsupported where no solver knows a model, before any
/// is run.
std::vector<PreparedScene> prepare_scenes(std::vector<Scenario> scenarios);

}  // namespace slipcheck
