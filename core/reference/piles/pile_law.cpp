#include "reference/piles/pile_law.h"

#include <algorithm>
#include <cmath>

#include "physics/contact/linear_contact.h"
#include "physics/numbers.h"
#include "reference/initial_contacts.h"
#include "reference/steps/step_length.h"
#include "scene/impact.h"

namespace slipcheck {
namespace {

/// Of the smaller radius, how far hard bodies may enter each other; soft ones by all of it.
constexpr double kDeepest = 0.1;

/// The substrate's friction in an impact as that of a pair: a slip that sticks is used up.
PairContact as_pair(const SubstrateContact& contact) {
  return {contact.restitution, contact.kinetic_friction, 0.0};
}

/// m_eff κ of a sphere on a body that cannot move is m/(1 + 1/q).
double kappa_on_surface(const Sphere& sphere) { return 1 / (1 + sphere.inverse_shape_factor()); }

double half_period(double stiffness, double mass) {
  return stiffness > 0 ? M_PI * std::sqrt(mass / stiffness) : kNever;
}

/// The overlap at which a body is held by the spring alone [m].
double overlap_under(const NormalForce& law, double weight, double most_overlap) {
  return std::visit(
      [&](const auto& normal) {
        double low = 0, high = most_overlap;
        for (int n = 0; n < 60; ++n) {
          const double mid = 0.5 * (low + high);
          (normal.elastic(mid) < weight ? low : high) = mid;
        }
        return high;
      },
      law);
}

double half_period(const SpringTorque& spring, double inertia) {
  return spring.length > 0 ? half_period(spring.stiffness, inertia) : kNever;
}

}  // namespace

PileLaws::PileLaws(const ContactScene& scene, double collision_time, double least_restitution)
    : scene_(&scene), collision_time_(collision_time), least_restitution_(least_restitution) {
  const Scene& of = scene.hard;
  if (of.box) throw Unsupported("piles in a box of two dimensions: compare.reference may be event");
  if (of.confined)
    throw Unsupported("contacts with memory have no plane that bodies never leave (confined)");
  const std::size_t materials = of.substrate.size(), surfaces = of.surfaces.size();
  const std::size_t rows = of.row_count();
  pairs_.resize(rows * rows);
  on_substrate_.resize(materials);
  on_surfaces_.resize(materials * surfaces);
  std::vector<std::size_t> count(materials), in_row(rows);
  for (std::size_t i = 0; i < of.bodies.size(); ++i) {
    ++count[of.material[i]];
    ++in_row[of.row_of(i)];
  }
  for (std::size_t m = 0; m < rows; ++m)
    for (std::size_t n = 0; n < rows; ++n)
      if (in_row[m] > 0 && in_row[n] > (m == n ? 1u : 0u) && !scene.soft[m * rows + n])
        pairs_[m * rows + n] = hard(of.pairs[m * rows + n]);
  for (std::size_t m = 0; m < materials; ++m) {
    if (count[m] == 0) continue;
    if (of.has_substrate) on_substrate_[m] = hard(as_pair(of.substrate[m]));
    for (std::size_t s = 0; s < surfaces; ++s) {
      const std::size_t at = m * surfaces + s;
      if (!scene.soft_surfaces.empty() && scene.soft_surfaces[at]) continue;
      on_surfaces_[at] = hard(of.on_surfaces[at].impact);
    }
  }
  has_hard_ = of.has_substrate || std::ranges::any_of(pairs_, [](const auto& p) { return !!p; }) ||
              std::ranges::any_of(on_surfaces_, [](const auto& p) { return !!p; });
  for (std::size_t i = 0; i < of.bodies.size(); ++i) {
    if (of.has_substrate) look_at(this->of(i, kSubstrate));
    for (std::size_t s = 0; s < surfaces; ++s) look_at(this->of(i, surface_touch(s)));
  }
  // What dilates remembers an offset, and its dashpot does not follow from its force.
  plain_ = plain_ && std::ranges::none_of(pairs_, [](const auto& p) { return !!p; });
  for (const auto& soft : scene.soft)
    if (soft) look_at(of_soft(*soft));
}

void PileLaws::look_at(const PileLaw& law) {
  linear_ = linear_ && std::holds_alternative<LinearForce>(law.normal);
  const SpringFriction& sliding = law.sliding;
  plain_ = plain_ && law.clamped &&
           (sliding.static_friction == 0 || (sliding.form == SpringFriction::Form::constant &&
                                             sliding.stiffness > 0 && sliding.damping_ratio == 0));
  turns_ = turns_ || law.rolling.length > 0 || law.drilling.length > 0 || law.rolling_table;
}

PileLaws::Hard PileLaws::hard(const PairContact& contact) const {
  const double* e = std::get_if<double>(&contact.restitution);
  if (!e)
    throw Unsupported(
        "contacts that last have one restitution for all speeds: a hard contact whose restitution "
        "is a law over the speed cannot be made one");
  const LinearContact linear = LinearContact::with_collision_time(
      1, std::max(*e, least_restitution_), collision_time_, ContactEnd::zero_force);
  return {linear.stiffness(), linear.damping_rate(),
          sticking_spring(contact.tangential_restitution, collision_time_)};
}

PileLaw PileLaws::of_hard(const Hard& hard, const PairContact& contact, double mass,
                          double kappa) const {
  PileLaw law;
  law.normal = LinearForce{hard.stiffness * mass, hard.damping * mass};
  const double slides = kappa * mass, omega = hard.sticking.frequency;
  law.hard = {slides, contact.tangential_restitution, contact.friction};
  law.sliding.stiffness = omega * omega * slides;
  law.sliding.damping = 2 * hard.sticking.damping * omega * slides;
  if (omega > 0)
    law.sliding.static_friction = law.sliding.kinetic_friction = friction_at(contact.friction, 0);
  return law;
}

PileLaw PileLaws::of_soft(const SoftContact& contact) const {
  PileLaw law;
  law.normal = contact.normal;
  law.clamped = contact.end == ContactEnd::zero_force;
  if (contact.memory) {
    law.sliding = contact.memory->sliding;
    law.rolling = contact.memory->rolling;
    law.drilling = contact.memory->drilling;
  } else if (const auto* viscous = std::get_if<ViscousForce>(&contact.tangential)) {
    if (viscous->caps == ViscousForce::Caps::apart)
      throw Unsupported("contacts with memory have no viscous friction with caps apart");
    law.sliding.damping = viscous->damping;
    law.sliding.static_friction = law.sliding.kinetic_friction = viscous->friction;
  } else if (!std::holds_alternative<NoTangentialForce>(contact.tangential)) {
    throw Unsupported(
        "asperities, and the tangential model hard of soft contacts, are not solved beside "
        "contacts "
        "with memory, surfaces or bodies that rest on each other");
  }
  return law;
}

void PileLaws::resist(const SubstrateContact& contact, const Sphere& sphere, PileLaw& law) const {
  if (contact.coupled_radius > 0)
    throw Unsupported(
        "coupled drilling is not solved beside contacts with memory, surfaces or bodies that rest "
        "on each other; drilling may be uncoupled");
  law.sliding.static_friction = contact.static_friction;
  law.sliding.kinetic_friction = contact.kinetic_friction;
  const double R = sphere.radius, inertia = sphere.moment_of_inertia();
  const double stiffness = law.sliding.stiffness * R * R;
  const double damping = 2 * std::sqrt(stiffness * inertia);
  // The torque that slows a rolling sphere by μ_r F_N/m: (1 + q) μ_r R F_N.
  law.rolling_lever = (1 + sphere.shape_factor) * R;
  law.rolling = {stiffness, damping, law.rolling_lever * contact.rolling(0)};
  if (!contact.rolling.is_constant()) law.rolling_table = &contact.rolling;
  law.rolls_while_sliding = contact.rolling_while_sliding;
  law.drilling = {stiffness, damping, contact.drilling_length};
}

PileLaw PileLaws::of(std::size_t body, int second) const {
  const Scene& scene = scene_->hard;
  const std::size_t m = scene.material[body];
  const Sphere& sphere = scene.bodies[body];
  if (second >= 0) {
    const auto other = static_cast<std::size_t>(second);
    const Sphere& partner = scene.bodies[other];
    const std::optional<SoftContact> soft = scene_->contact_of(body, other);
    PileLaw law =
        soft ? of_soft(*soft)
             : of_hard(*pairs_[scene.row_of(body) * scene.row_count() + scene.row_of(other)],
                       scene.between(body, other), effective_mass(sphere, partner),
                       tangential_mass_ratio(sphere, partner));
    law.deepest = soft ? 1 : kDeepest;
    law.most_overlap = law.deepest * std::min(sphere.radius, partner.radius);
    return law;
  }
  PileLaw law;
  const double kappa = kappa_on_surface(sphere);
  const auto no_deeper_than = [&](double deepest) {
    law.deepest = deepest;
    law.most_overlap = deepest * sphere.radius;
  };
  if (second == kSubstrate) {
    const SubstrateContact& contact = scene.substrate[m];
    law = of_hard(on_substrate_[m], as_pair(contact), sphere.mass, kappa);
    no_deeper_than(kDeepest);
    resist(contact, sphere, law);
    return law;
  }
  const std::size_t k = touched_surface(second), at = m * scene.surfaces.size() + k;
  if (!scene_->soft_surfaces.empty() && scene_->soft_surfaces[at]) {
    law = of_soft(*scene_->soft_surfaces[at]);
    no_deeper_than(1);
    return law;
  }
  const SurfaceContact& contact = scene.on_surfaces[at];
  law = of_hard(*on_surfaces_[at], contact.impact, sphere.mass, kappa);
  no_deeper_than(kDeepest);
  resist(contact.lasting, sphere, law);
  return law;
}

std::vector<SpringSpeeds> PileLaws::spring_speeds() const {
  std::vector<SpringSpeeds> all;
  all.reserve(scene_->hard.bodies.size());
  for (std::size_t i = 0; i < scene_->hard.bodies.size(); ++i) all.push_back(spring_speeds_of(i));
  return all;
}

SpringSpeeds PileLaws::spring_speeds_of(std::size_t body) const {
  const Scene& scene = scene_->hard;
  const Sphere& sphere = scene.bodies[body];
  const double g = scene.gravity_vector().norm(), weight = sphere.mass * g;
  const double slides = kappa_on_surface(sphere) * sphere.mass;
  SpringSpeeds fastest;
  const auto look = [&](int second) {
    const PileLaw law = of(body, second);
    const double overlap = overlap_under(law.normal, weight, law.most_overlap);
    fastest.rise = std::max(fastest.rise, std::sqrt(g * overlap));
    if (const double k = law.sliding.stiffness_at(overlap); k > 0)
      fastest.slip =
          std::max(fastest.slip, law.sliding.static_friction * weight / std::sqrt(slides * k));
  };
  if (scene.has_substrate) look(kSubstrate);
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) look(surface_touch(s));
  return fastest;
}

double PileLaws::shortest_contact() const {
  const Scene& scene = scene_->hard;
  double least_radius = kNever;
  for (const Sphere& sphere : scene.bodies) least_radius = std::min(least_radius, sphere.radius);
  const double speed =
      std::max(speed_scale(*scene_), std::sqrt(2 * scene.gravity_vector().norm() * least_radius));
  double shortest = kNever;
  const auto look = [&](const PileLaw& law, double mass, double kappa, double inertia) {
    double overlap = law.most_overlap;
    if (const auto* linear = std::get_if<LinearForce>(&law.normal)) {
      shortest = std::min(shortest, half_period(linear->stiffness, mass));
      // A dashpot over critical damping is the faster one.
      if (linear->damping > 0) shortest = std::min(shortest, M_PI * mass / linear->damping);
    } else if (speed > 0) {
      const ContactEnd end = law.clamped ? ContactEnd::zero_force : ContactEnd::zero_overlap;
      const Impact hit = impact(law.normal, mass, speed, end, 1e-6);
      shortest = std::min(shortest, hit.duration);
      overlap = std::min(overlap, speed * hit.duration);
    }
    shortest = std::min({shortest, half_period(law.sliding.stiffness_at(overlap), kappa * mass),
                         half_period(law.rolling, inertia), half_period(law.drilling, inertia)});
    if (law.sliding.damping > 0)
      shortest = std::min(shortest, M_PI * kappa * mass / law.sliding.damping);
  };
  const auto lightest = lightest_two(scene);
  for (const std::vector<std::size_t>& of_row : lightest) {
    if (of_row.empty()) continue;
    const Sphere& sphere = scene.bodies[of_row.front()];
    const auto alone = [&](int second) {
      look(of(of_row.front(), second), sphere.mass, kappa_on_surface(sphere),
           sphere.moment_of_inertia());
    };
    if (scene.has_substrate) alone(kSubstrate);
    for (std::size_t s = 0; s < scene.surfaces.size(); ++s) alone(surface_touch(s));
  }
  for (std::size_t m = 0; m < lightest.size(); ++m)
    for (std::size_t n = 0; n <= m; ++n)
      for (const std::size_t i : lightest[m])
        for (const std::size_t j : lightest[n]) {
          if (i == j) continue;
          const Sphere &a = scene.bodies[i], &b = scene.bodies[j];
          const double inertia = 1 / (1 / a.moment_of_inertia() + 1 / b.moment_of_inertia());
          look(of(i, static_cast<int>(j)), effective_mass(a, b), tangential_mass_ratio(a, b),
               inertia);
        }
  return shortest;
}

double pile_collision_time(const ContactScene& scene) {
  constexpr double kShort = 1e-3, kFew = 10, kLongest = 10;
  double radius = kNever;
  for (const Sphere& sphere : scene.hard.bodies) radius = std::min(radius, sphere.radius);
  const double fall = std::sqrt(2 * scene.hard.gravity_vector().norm() * radius);
  const double speed = std::max(fall, speed_scale(scene));
  const double many = static_cast<double>(scene.hard.bodies.size()) / kFew;
  // Where nothing moves nor falls, any time will do.
  return kShort * std::clamp(many, 1.0, kLongest) * (speed > 0 ? radius / speed : 1);
}

}  // namespace slipcheck
