// Closed forms and contact laws over arrays: each argument a number or an array, broadcast as numpy
// does.

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "physics/closed_forms.h"
#include "physics/contact/elastic_pair.h"
#include "physics/contact/hard_contact.h"
#include "physics/contact/linear_contact.h"
#include "physics/contact/normal_force.h"
#include "physics/contact/tangential_force.h"
#include "scene.h"

namespace slipcheck::python {
namespace {

using namespace pybind11::literals;

void add_head_on(py::module_& module) {
  module.def("head_on_velocity_after", py::vectorize([](double v_i, double v_j, double e) {
               return HeadOnCollision{.restitution = e}.velocity_after(v_i, v_j);
             }),
             "v_i"_a, "v_j"_a, "restitution"_a);
  module.def("head_on_rolling_velocity",
             py::vectorize([](double v_i, double v_j, double e, double A, double c) {
               return HeadOnCollision{A, e, c}.rolling_velocity(v_i, v_j);
             }),
             "v_i"_a, "v_j"_a, "restitution"_a, "A"_a = 2.5, "spin_exchange"_a = 0.0);
  module.def("effective_restitution", py::vectorize([](double e, double A) {
               return HeadOnCollision{.A = A, .restitution = e}.effective_restitution();
             }),
             "restitution"_a, "A"_a = 2.5);
  module.def(
      "symmetric_sliding_distance",
      py::vectorize([](double v_rel, double e, double mu, double g, double A) {
        return HeadOnCollision{.A = A, .restitution = e}.symmetric_sliding_distance(v_rel, mu, g);
      }),
      "relative_speed"_a, "restitution"_a, "kinetic_friction"_a, "gravity"_a = 9.81, "A"_a = 2.5);
}

/// K's slide to rolling, for vectors of shape (n, 3).
py::dict slide_to_roll(const Array& velocity, const Array& angular_velocity, double radius,
                       double kinetic_friction, double gravity, double shape_factor) {
  check_shape("velocity", velocity, {-1, 3});
  const py::ssize_t count = velocity.shape(0);
  check_shape("angular_velocity", angular_velocity, {count, 3});
  for (const auto& [name, value] : {std::pair{"radius", radius},
                                    {"kinetic_friction", kinetic_friction},
                                    {"gravity", gravity},
                                    {"shape_factor", shape_factor}})
    if (!(value > 0))
      throw py::value_error(std::string(name) + ": must be > 0, got " + std::to_string(value));
  const Sphere sphere{radius, 1, shape_factor};
  const std::vector<py::ssize_t> vectors{count, 3};
  Array slip(vectors), rolling_velocity(vectors), displacement(vectors);
  Array time(count), distance(count), energy(count);
  for (py::ssize_t k = 0; k < count; ++k) {
    const SlideToRoll slide(sphere, kinetic_friction, gravity, vector_at(velocity.data(k, 0)),
                            vector_at(angular_velocity.data(k, 0)));
    put_vector(slide.slip, slip.mutable_data(k, 0));
    put_vector(slide.rolling_velocity, rolling_velocity.mutable_data(k, 0));
    put_vector(slide.displacement, displacement.mutable_data(k, 0));
    *time.mutable_data(k) = slide.sliding_time;
    *distance.mutable_data(k) = slide.sliding_distance;
    *energy.mutable_data(k) = slide.energy_change;
  }
  return py::dict("slip"_a = slip, "sliding_time"_a = time, "rolling_velocity"_a = rolling_velocity,
                  "displacement"_a = displacement, "sliding_distance"_a = distance,
                  "energy_change"_a = energy);
}

void add_forces(py::module_& module) {
  module.def("linear_force", py::vectorize([](double xi, double rate, double k, double c) {
               return LinearForce{k, c}(xi, rate);
             }),
             "overlap"_a, "rate"_a, "stiffness"_a, "damping"_a = 0.0);
  module.def("hertz_force",
             py::vectorize([](double xi, double rho) { return HertzForce{rho}(xi, 0); }),
             "overlap"_a, "modulus"_a);
  module.def(
      "power_force",
      py::vectorize([](double xi, double rate, double E, double eta, double alpha, double gamma) {
        return PowerForce{E, eta, alpha, gamma}(xi, rate);
      }),
      "overlap"_a, "rate"_a, "modulus"_a, "viscosity"_a = 0.0, "alpha"_a = 1.5, "gamma"_a = 0.5);
  module.def("viscoelastic_force", py::vectorize([](double xi, double rate, double rho, double A) {
               return ViscoelasticForce{rho, A}(xi, rate);
             }),
             "overlap"_a, "rate"_a, "modulus"_a, "dissipation_time"_a);
  module.def("compact_viscoelastic_force",
             py::vectorize([](double xi, double rate, double rho, double A) {
               return CompactViscoelasticForce{rho, A}(xi, rate);
             }),
             "overlap"_a, "rate"_a, "modulus"_a, "dissipation_time"_a);
  module.def("viscous_friction",
             py::vectorize([](double slip, double normal, double damping, double friction) {
               const ViscousForce force{damping, friction};
               return std::min(force.viscous(std::abs(slip)), force.cap(normal));
             }),
             "slip"_a, "normal"_a, "damping"_a, "friction"_a);
  module.def("power_law_restitution",
             py::vectorize([](double g, double coefficient, double exponent, double speed) {
               return restitution_at(PowerLawRestitution{coefficient, exponent, speed}, g);
             }),
             "speed"_a, "coefficient"_a = 0.32, "exponent"_a = 0.234, "reference_speed"_a = 0.01);
  module.def("exponential_friction", py::vectorize([](double v, double a, double b, double c) {
               return friction_at(FrictionLaw(ExponentialFriction{a, b, c}), v);
             }),
             "slip"_a, "a"_a, "b"_a, "c"_a);
}

void add_pair_numbers(py::module_& module) {
  module.def("effective_mass", py::vectorize([](double m1, double m2) {
               return effective_mass(Sphere{1, m1}, Sphere{1, m2});
             }),
             "first"_a, "second"_a);
  module.def("hertz_duration", py::vectorize([](double mass, double rho, double g) {
               return hertz_duration(mass, rho, g);
             }),
             "mass"_a, "modulus"_a, "speed"_a);
  module.def("hertz_largest_overlap", py::vectorize([](double mass, double rho, double g) {
               return hertz_largest_overlap(mass, rho, g);
             }),
             "mass"_a, "modulus"_a, "speed"_a);
  module.def("linear_restitution", py::vectorize([](double mass, double k, double rate) {
               return LinearContact(mass, k, rate, ContactEnd::zero_overlap).restitution();
             }),
             "mass"_a, "stiffness"_a, "damping_rate"_a);
}

}  // namespace

void add_laws(py::module_& module) {
  add_head_on(module);
  module.def("slide_to_roll", slide_to_roll, "velocity"_a, "angular_velocity"_a, "radius"_a,
             "kinetic_friction"_a, "gravity"_a = 9.81, "shape_factor"_a = 0.4);
  add_forces(module);
  add_pair_numbers(module);
}

}  // namespace slipcheck::python
