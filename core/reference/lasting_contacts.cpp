#include "reference/lasting_contacts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "physics/contact/elastic_pair.h"
#include "physics/contact/linear_contact.h"
#include "physics/numbers.h"
#include "reference/events/event_solver.h"

namespace slipcheck {
namespace {

/// Bodies touch whose gap is no larger a part of the sum of their radii: positions are typed.
constexpr double kTouching = 1e-5;

/// e_n of critical damping where a contact ends with its force, e^−2.
const double kCritical = std::exp(-2.0);

bool is_integrable(const Scene& scene) {
  return !scene.box && scene.periodic.isZero(0) && scene.bodies.size() <= kMostIntegrated;
}

bool rests_on(const Scene& scene, std::size_t i, std::size_t j) {
  const BodyState &upper = scene.initial[i], &lower = scene.initial[j];
  const double radius = scene.bodies[i].radius;
  if (scene.has_substrate && upper.position.z() <= radius * (1 + kTouching))
    return false;  // the substrate carries it
  const Vector3 way = upper.position - lower.position;
  const double contact = radius + scene.bodies[j].radius;
  return way.norm() <= (1 + kTouching) * contact && way.z() >= 1e-3 * contact;
}

bool never_rebounds(const PairContact& pair) {
  const double* e = std::get_if<double>(&pair.restitution);
  return e && *e == 0;
}

/// Two that nothing presses together meet once; what a third drives into them meets without end.
bool sticks(const Scene& scene) {
  const std::size_t few = is_rubbed(scene) ? 1 : 2;
  return scene.bodies.size() > few && std::ranges::any_of(scene.pairs, never_rebounds);
}

/// Each body a class of its own: the law of a pair depends on its masses.
Scene one_class_each(Scene scene) {
  const std::size_t count = scene.bodies.size();
  Scene each = scene;
  each.substrate.clear();
  each.pairs.clear();
  each.rows = {};
  each.on_surfaces.clear();
  for (std::size_t i = 0; i < count; ++i) {
    each.substrate.push_back(scene.on_substrate(i));
    for (std::size_t j = 0; j < count; ++j) each.pairs.push_back(scene.between(i, j));
    for (std::size_t s = 0; s < scene.surfaces.size(); ++s)
      each.on_surfaces.push_back(scene.on_surface(i, s));
  }
  std::iota(each.material.begin(), each.material.end(), std::size_t{0});
  return each;
}

std::optional<SoftContact> lasting(const PairContact& hard, const Sphere& a, const Sphere& b,
                                   double collision_time) {
  constexpr double kLeastRestitution = 1e-5, kLeastSlip = 1e-4;
  const double* e = std::get_if<double>(&hard.restitution);
  const double* mu = std::get_if<double>(&hard.friction);
  if (!e || !mu || (*mu > 0 && hard.tangential_restitution > 0)) return std::nullopt;
  const double mass = effective_mass(a, b);
  SoftContact made;
  made.end = ContactEnd::zero_force;
  made.after_impact = never_rebounds(hard);
  const double restitution = made.after_impact ? kCritical : std::max(*e, kLeastRestitution);
  const LinearContact linear =
      LinearContact::with_collision_time(mass, restitution, collision_time, made.end);
  made.normal = LinearForce{linear.stiffness(), linear.damping_rate() * mass};
  if (*mu > 0) {
    // Over a collision what is left of the slip falls to −β0 of itself.
    const double left = std::max(-hard.tangential_restitution, kLeastSlip);
    made.tangential =
        ViscousForce{-std::log(left) * tangential_mass_ratio(a, b) * mass / collision_time, *mu};
  }
  return made;
}

/// Along x, so that only bodies whose shadows meet are looked at.
template <class Holds>
bool any_shadows_meet(const Scene& scene, Holds holds) {
  const auto left = [&](std::size_t i) {
    return scene.initial[i].position.x() - (1 + kTouching) * scene.bodies[i].radius;
  };
  std::vector<std::size_t> order(scene.bodies.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, left);
  for (std::size_t p = 0; p < order.size(); ++p) {
    const double right = left(order[p]) + 2 * (1 + kTouching) * scene.bodies[order[p]].radius;
    for (std::size_t q = p + 1; q < order.size() && left(order[q]) <= right; ++q)
      if (holds(order[p], order[q]) || holds(order[q], order[p])) return true;
  }
  return false;
}

}  // namespace

bool rests_on_bodies(const Scene& scene) {
  const auto is_still = [](const BodyState& state) {
    return state.velocity.isZero(0) && state.angular_velocity.isZero(0);
  };
  if (scene.gravity == 0 || scene.box || !scene.periodic.isZero(0) || scene.confined ||
      !scene.motion.is_still() || !std::ranges::all_of(scene.initial, is_still) ||
      !std::ranges::all_of(scene.surfaces, [](const Surface& s) { return s.motion.is_still(); }))
    return false;
  return any_shadows_meet(scene,
                          [&](std::size_t i, std::size_t j) { return rests_on(scene, i, j); });
}

bool is_rubbed(const Scene& scene) {
  return scene.gravity != 0 && std::ranges::any_of(scene.substrate, [](const auto& contact) {
           return contact.kinetic_friction > 0;
         });
}

bool has_lasting_contacts(const Scene& scene) { return is_integrable(scene) && sticks(scene); }

double short_collision_time(const Scene& scene) {
  constexpr double kPart = 1e-4;
  double radius = kNever;
  for (const Sphere& sphere : scene.bodies) radius = std::min(radius, sphere.radius);
  const double fall = std::sqrt(2 * scene.gravity * radius);
  return kPart * radius / std::max(fall, speed_scale(scene, scene.initial));
}

std::optional<ContactScene> with_lasting_contacts(const Scene& scene, double collision_time) {
  if (!is_integrable(scene)) return std::nullopt;
  ContactScene made;
  made.hard = one_class_each(scene);
  made.touching = kTouching;
  const bool others_part = sticks(scene);
  const std::size_t count = scene.bodies.size();
  made.soft.resize(count * count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < count; ++j) {
      if (others_part && !never_rebounds(scene.between(i, j))) continue;
      made.soft[i * count + j] =
          lasting(scene.between(i, j), scene.bodies[i], scene.bodies[j], collision_time);
      if (!made.soft[i * count + j]) return std::nullopt;
    }
  return made;
}

std::optional<ContactScene> with_lasting_contacts(const Scene& scene) {
  return with_lasting_contacts(scene, short_collision_time(scene));
}

}  // namespace slipcheck
