#include "scene.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

#include "base/stop_scope.h"
#include "harness/run/prepared_scene.h"
#include "harness/run/reference_run.h"
#include "scenario/load.h"

namespace slipcheck::python {
namespace {

using namespace pybind11::literals;

Array vectors_of(const std::vector<BodyState>& states, Vector3 BodyState::*which) {
  Array array({static_cast<py::ssize_t>(states.size()), py::ssize_t{3}});
  for (std::size_t i = 0; i < states.size(); ++i)
    put_vector(states[i].*which, array.mutable_data(static_cast<py::ssize_t>(i), 0));
  return array;
}

py::dict dict_of(const ReferenceResult& result) {
  py::dict observables, closed_form;
  for (const auto& [name, value] : result.closed_form) closed_form[py::str(name)] = value;
  for (const auto& [name, value] : result.observables)
    observables[py::str(name)] = py::make_tuple(value.value, value.uncertainty);
  const SolvedRun& run = result.run;
  return py::dict("solver"_a = result.solver, "cpu_seconds"_a = result.cpu_seconds,
                  "observables"_a = observables, "closed_form"_a = closed_form,
                  "end_time"_a = run.end_time, "reached"_a = run.reached, "failed"_a = run.failed,
                  "reason"_a = run.reason, "first_contact"_a = result.first_contact,
                  "collisions"_a = run.collisions, "events"_a = run.events, "steps"_a = run.steps,
                  "warnings"_a = result.warnings);
}

py::dict solve(const LoadedScene& scene, double time_limit) {
  ReferenceResult result;
  {
    const py::gil_scoped_release others_run;
    std::vector<Scenario> scenarios{scene.scenario()};
    result =
        std::move(prepare_scenes(std::move(scenarios), false, 1, time_limit).front().reference);
  }
  return dict_of(result);
}

/// Positions, velocities and angular velocities at these times.
py::tuple trajectory(const LoadedScene& scene, const Array& times, double time_limit) {
  check_shape("times", times, {-1});
  check_finite("times", times);
  const double* first = times.data();
  const std::vector<double> at(first, first + times.size());
  if (!at.empty() && at.front() < 0)
    throw py::value_error("times: must be >= 0 s, got " + std::to_string(at.front()));
  if (const auto falls = std::ranges::adjacent_find(at, std::greater_equal{}); falls != at.end())
    throw py::value_error("times: must rise, got " + std::to_string(falls[0]) + " before " +
                          std::to_string(falls[1]));
  if (scene.contact().hard.box)
    throw py::value_error("scene: must have no box, whose motion is not kept");
  std::vector<std::vector<BodyState>> states;
  {
    const py::gil_scoped_release others_run;
    const StopScope limit(time_limit);
    states = scene.solver().states_along(at);
  }
  const auto count = static_cast<py::ssize_t>(states.size());
  const auto bodies = static_cast<py::ssize_t>(scene.contact().hard.bodies.size());
  const std::vector<py::ssize_t> shape{count, bodies, 3};
  Array position(shape), velocity(shape), angular_velocity(shape);
  for (py::ssize_t k = 0; k < count; ++k)
    for (py::ssize_t i = 0; i < bodies; ++i) {
      const BodyState& state = states[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)];
      put_vector(state.position, position.mutable_data(k, i, 0));
      put_vector(state.velocity, velocity.mutable_data(k, i, 0));
      put_vector(state.angular_velocity, angular_velocity.mutable_data(k, i, 0));
    }
  return py::make_tuple(position, velocity, angular_velocity);
}

std::vector<std::string> names_of_bodies(const LoadedScene& scene) {
  std::vector<std::string> names;
  for (const Body& body : scene.scenario().bodies) names.push_back(body.name);
  return names;
}

template <class Value>
Array by_body(const LoadedScene& scene, Value value) {
  const std::vector<Sphere>& bodies = scene.contact().hard.bodies;
  Array array(static_cast<py::ssize_t>(bodies.size()));
  std::ranges::transform(bodies, array.mutable_data(), value);
  return array;
}

}  // namespace

LoadedScene::LoadedScene(Scenario scenario)
    : scenario_(std::move(scenario)),
      contact_(std::make_unique<const ContactScene>(make_contact_scene(scenario_))) {}

ReferenceSolver LoadedScene::solver_for(const ContactScene& scene) const {
  return {scene, reference_settings(scenario_)};
}

std::size_t LoadedScene::body(const std::string& name) const {
  const auto found = std::ranges::find(scenario_.bodies, name, &Body::name);
  if (found == scenario_.bodies.end())
    throw py::key_error("body: must be one of the scene's, got " + name);
  return static_cast<std::size_t>(found - scenario_.bodies.begin());
}

py::class_<LoadedScene> add_scene(py::module_& module) {
  py::class_<LoadedScene> scene(module, "LoadedScene");
  scene
      .def_static("parse",
                  [](const std::string& text, const std::string& file) {
                    return LoadedScene(parse_scenario(text, file));
                  })
      .def_static(
          "load",
          [](const std::filesystem::path& file) { return LoadedScene(load_scenario(file)); })
      .def_property_readonly("name", [](const LoadedScene& s) { return s.scenario().name; })
      .def_property_readonly("title", [](const LoadedScene& s) { return s.scenario().title; })
      .def_property_readonly("bodies", names_of_bodies)
      .def_property_readonly("solver", [](const LoadedScene& s) { return s.solver().name(); })
      .def_property_readonly("warnings", [](const LoadedScene& s) { return s.contact().warnings; })
      .def_property_readonly(
          "radius",
          [](const LoadedScene& s) { return by_body(s, [](const Sphere& b) { return b.radius; }); })
      .def_property_readonly(
          "mass",
          [](const LoadedScene& s) { return by_body(s, [](const Sphere& b) { return b.mass; }); })
      .def_property_readonly("position",
                             [](const LoadedScene& s) {
                               return vectors_of(s.contact().hard.initial, &BodyState::position);
                             })
      .def_property_readonly("velocity",
                             [](const LoadedScene& s) {
                               return vectors_of(s.contact().hard.initial, &BodyState::velocity);
                             })
      .def_property_readonly("angular_velocity",
                             [](const LoadedScene& s) {
                               return vectors_of(s.contact().hard.initial,
                                                 &BodyState::angular_velocity);
                             })
      .def("solve", solve, "time_limit"_a = std::numeric_limits<double>::infinity())
      .def("trajectory", trajectory, "times"_a,
           "time_limit"_a = std::numeric_limits<double>::infinity());
  return scene;
}

}  // namespace slipcheck::python
