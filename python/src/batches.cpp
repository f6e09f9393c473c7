// Many answers of the reference in one call.

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "harness/observe/observer.h"
#include "harness/run/reference_run.h"
#include "physics/contact/elastic_pair.h"
#include "physics/contact/planar_collision.h"
#include "reference/initial_contacts.h"
#include "reference/pair/pair_batch.h"
#include "scene.h"

namespace slipcheck::python {
namespace {

using namespace pybind11::literals;

/// Where the values that are asked for stand in flat_values(): known once for each set of pairs
/// that collided.
class ValuePlaces {
 public:
  ValuePlaces(std::vector<std::string> asked, std::vector<std::string> bodies)
      : asked_(std::move(asked)), bodies_(std::move(bodies)) {}

  void put(const Observables& seen, double* out) {
    pairs_.clear();
    for (const PairObservables& pair : seen.pairs) pairs_.emplace_back(pair.first, pair.second);
    const auto [found, is_new] = places_.try_emplace(pairs_);
    const std::vector<double> values = flat_values(seen);
    if (is_new) found->second = places_of(seen, values.size());
    for (std::size_t k = 0; k < asked_.size(); ++k) {
      const std::size_t place = found->second[k];
      out[k] = place < values.size() ? values[place] : std::numeric_limits<double>::quiet_NaN();
    }
  }

 private:
  std::vector<std::size_t> places_of(const Observables& seen, std::size_t count) const {
    std::vector<std::size_t> places(asked_.size(), std::numeric_limits<std::size_t>::max());
    for (std::size_t index = 0; index < count; ++index) {
      const std::string name = value_name(seen, bodies_, index);
      for (std::size_t k = 0; k < asked_.size(); ++k)
        if (asked_[k] == name) places[k] = index;
    }
    return places;
  }

  std::vector<std::string> asked_, bodies_;
  std::vector<std::pair<int, int>> pairs_;
  std::map<std::vector<std::pair<int, int>>, std::vector<std::size_t>> places_;
};

std::string place_text(py::ssize_t run) { return " of run " + std::to_string(run); }

/// What the rules of a scene ask of initial states.
void check_start(const Scene& scene, py::ssize_t run) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const double height = scene.initial[i].position.z(), least = scene.bodies[i].radius;
    if (scene.has_substrate && height < least * (1 - 1e-12))
      throw py::value_error("position: z must be the radius or more, got " +
                            std::to_string(height) + " m" + place_text(run) + ", the radius is " +
                            std::to_string(least) + " m");
    for (std::size_t j = i + 1; j < scene.bodies.size(); ++j) {
      const double reach = scene.bodies[i].radius + scene.bodies[j].radius;
      const double apart =
          scene.to_nearest_image(scene.initial[i].position - scene.initial[j].position).norm();
      if (apart < reach * (1 - 1e-12))
        throw py::value_error("position: spheres must not overlap, got " + std::to_string(apart) +
                              " m between centres" + place_text(run) + ", radii sum to " +
                              std::to_string(reach) + " m");
    }
  }
}

/// Values of shape (n, observables): of each run, from these states, what the one observer of the
/// reference and of engines sees. Beside them how each run ended.
py::tuple solve_many(const LoadedScene& loaded, const Array& position, const Array& velocity,
                     const Array& angular_velocity, const std::vector<std::string>& observables) {
  ContactScene scene = loaded.contact();
  if (scene.hard.box)
    throw py::value_error("scene: must have no box, whose observables are means over one long run");
  const auto bodies = static_cast<py::ssize_t>(scene.hard.bodies.size());
  check_shape("position", position, {-1, bodies, 3});
  const py::ssize_t runs = position.shape(0);
  check_shape("velocity", velocity, {runs, bodies, 3});
  check_shape("angular_velocity", angular_velocity, {runs, bodies, 3});
  check_finite("position", position);
  check_finite("velocity", velocity);
  check_finite("angular_velocity", angular_velocity);
  Array values({runs, static_cast<py::ssize_t>(observables.size())});
  Array end_time(runs);
  py::array_t<bool> reached(runs);
  double* const out = values.mutable_data();
  double* const ends = end_time.mutable_data();
  bool* const well = reached.mutable_data();
  const double *p = position.data(), *v = velocity.data(), *w = angular_velocity.data();
  const RunEnd end = run_end(loaded.scenario());
  ValuePlaces places(observables, body_names(loaded.scenario()));
  {
    const py::gil_scoped_release others_run;
    for (py::ssize_t run = 0; run < runs; ++run) {
      for (BodyState& state : scene.hard.initial) {
        state = {vector_at(p), vector_at(v), vector_at(w)};
        p += 3, v += 3, w += 3;
      }
      check_start(scene.hard, run);
      const ReferenceSolver solver = loaded.solver_for(scene);
      Observer observer(solver.scene().hard, 0, speed_scale(solver.scene()), solver.is_resolved());
      const SolvedRun solved = solver.run(end, &observer);
      places.put(observer.finish(solved.end_time),
                 out + run * static_cast<py::ssize_t>(observables.size()));
      ends[run] = solved.end_time;
      well[run] = solved.reached && !solved.failed && !solved.lasting;
      if (run % 4096 == 4095) {  // Ctrl-C
        const py::gil_scoped_acquire for_signals;
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      }
    }
  }
  return py::make_tuple(values, end_time, reached);
}

/// A hard pair's collision in the frame of its centres, by the rule of hard spheres.
PairCollision hard_collision(const PairContact& contact, const Sphere& first, const Sphere& second,
                             double normal, double tangential) {
  const double mass = effective_mass(first, second), kappa = tangential_mass_ratio(first, second);
  const double e = restitution_at(contact.restitution, normal);
  const PlanarImpulse impulse = planar_impulse(contact, e, mass, kappa, -normal, tangential);
  const double ratio = (tangential + impulse.tangential / (kappa * mass)) / tangential;
  return pair_collision(mass, kappa * mass, normal, tangential, e, ratio, 0);
}

py::tuple collide(const LoadedScene& loaded, const std::string& first, const std::string& second,
                  const Array& normal_speed, const Array& tangential_speed, int steps) {
  check_shape("normal_speed", normal_speed, {-1});
  check_shape("tangential_speed", tangential_speed, {normal_speed.shape(0)});
  check_finite("normal_speed", normal_speed);
  check_finite("tangential_speed", tangential_speed);
  const auto count = static_cast<std::size_t>(normal_speed.size());
  const std::span<const double> normal(normal_speed.data(), count);
  const std::span<const double> tangential(tangential_speed.data(), count);
  for (std::size_t k = 0; k < count; ++k)
    if (!(normal[k] > 0) || !(tangential[k] > 0))
      throw py::value_error("speeds: must be > 0 m/s, got " + std::to_string(normal[k]) + " and " +
                            std::to_string(tangential[k]) + " at " + std::to_string(k));
  if (steps < 8) throw py::value_error("steps: must be >= 8, got " + std::to_string(steps));
  const ContactScene& scene = loaded.contact();
  const std::size_t i = loaded.body(first), j = loaded.body(second);
  if (i == j) throw py::value_error("bodies: must be two, got " + first + " twice");
  if (!scene.hard.laws.empty())
    throw py::value_error("scene: must have no collision law of its own between its bodies");
  const Sphere &a = scene.hard.bodies[i], &b = scene.hard.bodies[j];
  std::vector<PairCollision> seen(count);
  {
    const py::gil_scoped_release others_run;
    if (const auto& soft = scene.between(i, j)) {
      if (!can_batch(*soft))
        throw std::invalid_argument("contact: many collisions at once have every law but power");
      collide_batch(*soft, a, b, normal, tangential, steps, seen);
    } else {
      for (std::size_t k = 0; k < count; ++k)
        seen[k] = hard_collision(scene.hard.between(i, j), a, b, normal[k], tangential[k]);
    }
  }
  const auto column = [&](double PairCollision::*which) {
    Array array(static_cast<py::ssize_t>(count));
    std::ranges::transform(seen, array.mutable_data(), [&](const auto& c) { return c.*which; });
    return array;
  };
  return py::make_tuple(column(&PairCollision::normal_restitution),
                        column(&PairCollision::tangential_restitution),
                        column(&PairCollision::duration), column(&PairCollision::energy_change));
}

}  // namespace

void add_batches(py::class_<LoadedScene>& scene) {
  scene
      .def("solve_many", solve_many, "position"_a, "velocity"_a, "angular_velocity"_a,
           "observables"_a)
      .def("collide", collide, "first"_a, "second"_a, "normal_speed"_a, "tangential_speed"_a,
           "steps"_a);
}

}  // namespace slipcheck::python
