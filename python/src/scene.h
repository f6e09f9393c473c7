#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "arrays.h"
#include "reference/reference_solver.h"
#include "scenario/scenario.h"

namespace slipcheck::python {

/// A scene that was read and compiled.
class LoadedScene {
 public:
  /// Throws BadScenario, Unsupported.
  explicit LoadedScene(Scenario scenario);

  const Scenario& scenario() const { return scenario_; }
  const ContactScene& contact() const { return *contact_; }
  /// The solver that is the truth for it, or for one that differs in its initial states alone.
  ReferenceSolver solver() const { return solver_for(*contact_); }
  ReferenceSolver solver_for(const ContactScene& scene) const;
  /// The index of a body by its name. Throws KeyError.
  std::size_t body(const std::string& name) const;

 private:
  Scenario scenario_;
  std::unique_ptr<const ContactScene> contact_;
};

/// Adds the class and what solves one scene.
py::class_<LoadedScene> add_scene(py::module_& module);
/// Adds what answers for many initial states or impacts at once.
void add_batches(py::class_<LoadedScene>& scene);
/// Adds closed forms and contact laws over arrays.
void add_laws(py::module_& module);

}  // namespace slipcheck::python
