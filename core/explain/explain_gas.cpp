#include <algorithm>
#include <cmath>
#include <numbers>

#include "explain/explain_parts.h"
#include "physics/closed_forms.h"
#include "physics/granular_gas.h"
#include "reference/reference_solver.h"

namespace slipcheck {
namespace {

/// Of a gas of hard disks [m], l = v/ν with the mean speed v = √(π T/2m) of a two-dimensional gas
/// and the collision rate of a disk after Enskog, ν = 2 √π n d χ √(T/m):
///
///   l = 1/(2 √2 n d χ),  χ of contact_correlation(),
///
/// n disks of diameter d per area that cover the share φ of it.
double mean_free_path(double density, double diameter, double covered) {
  const double chi = contact_correlation(2, covered);
  return 1 / (2 * std::numbers::sqrt2 * density * diameter * chi);
}

/// Root of the mean square of the bodies' speeds [m/s].
double rms_speed(const Scene& scene) {
  double sum = 0;
  for (const BodyState& state : scene.initial) sum += state.velocity.squaredNorm();
  return std::sqrt(sum / static_cast<double>(scene.initial.size()));
}

/// K (44) at the root mean square of the speed at which two bodies of the gas pass each other.
void add_sliding(ExplainSection& section, const Scene& scene, double path) {
  const double mu = scene.on_substrate(0).kinetic_friction;
  const double v_rel = std::numbers::sqrt2 * rms_speed(scene);
  const bool alike = std::ranges::all_of(scene.bodies, [&](const Sphere& sphere) {
    return sphere.radius == scene.bodies[0].radius &&
           sphere.inverse_shape_factor() == scene.bodies[0].inverse_shape_factor();
  });
  if (!alike || !has_exact_phases(scene) || !(mu > 0) || !(scene.gravity > 0) || !(v_rel > 0))
    return;
  HeadOnCollision hit;
  hit.A = scene.bodies[0].inverse_shape_factor();
  hit.restitution = restitution_at(scene.between(0, 1).restitution, v_rel);
  const double s = std::abs(hit.symmetric_sliding_distance(v_rel, mu, scene.gravity));
  section.add("v_rel", quantity(v_rel, kVelocity),
              "√2 times the root mean square of the speeds at the start");
  section.add("s", quantity(s, kLength),
              "slid by each of two that meet head-on at v_rel and roll, K (44)");
  section.add("e_eff", pure(hit.effective_restitution()), "of these two, once both roll");
  section.add("l/s", pure(path / s),
              "well above 1 they roll before they meet again; near 1 and below they still slide");
}

}  // namespace

ExplainSections explain_gas(const Scene& scene) {
  if (scene.periodic == Vector2::Zero()) return {};
  ExplainSection section{.title = "Periodic cell"};
  section.add("L_x", quantity(scene.periodic.x(), kLength), "length in x");
  section.add("L_y", quantity(scene.periodic.y(), kLength), "length in y");
  const double area = scene.periodic.x() * scene.periodic.y();
  if (!(area > 0) || scene.bodies.size() < 2) return {section};
  double diameters = 0, disks = 0;
  for (const Sphere& sphere : scene.bodies) {
    diameters += 2 * sphere.radius;
    disks += std::numbers::pi * sphere.radius * sphere.radius;
  }
  const auto bodies = static_cast<double>(scene.bodies.size());
  const double covered = disks / area;
  const double path = mean_free_path(bodies / area, diameters / bodies, covered);
  section.add("φ", pure(covered), "share of the cell that the bodies cover");
  section.add("l", quantity(path, kLength), "mean free path of a gas of hard disks, 1/(2√2 n d χ)");
  add_sliding(section, scene, path);
  return {section};
}

}  // namespace slipcheck
