#pragma once

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "../scenes.h"
#include "physics/contact/linear_contact.h"
#include "reference/events/event_solver.h"
#include "scene/contact_scene.h"

namespace slipcheck::test {

inline constexpr double kCollisionTime = 2.55e-5;  // K, steel [s]
inline const RunEnd kRolling{Run::Until::rolling, 0, 10};

inline ContactScene with_contact(Scene hard, const SoftContact& contact) {
  ContactScene scene;
  scene.hard = std::move(hard);
  scene.soft.assign(scene.hard.pairs.size(), contact);
  return scene;
}

/// Bodies without a contact law between each other: one body, or apart.
inline ContactScene alone(Scene hard) {
  return with_contact(std::move(hard), {LinearForce{1e6, 0}, ContactEnd::zero_overlap, {}});
}

inline SoftContact linear_contact(double mass, double restitution, double collision_time,
                                  ContactEnd end) {
  const LinearContact law =
      LinearContact::with_collision_time(mass, restitution, collision_time, end);
  return {LinearForce{law.stiffness(), law.damping_rate() * mass}, end, NoTangentialForce{}};
}

inline double overlap(const Scene& scene, const std::vector<BodyState>& s) {
  return scene.bodies[0].radius + scene.bodies[1].radius - (s[0].position - s[1].position).norm();
}

inline double closing(const std::vector<BodyState>& s) {
  return -(s[0].position - s[1].position).normalized().dot(s[0].velocity - s[1].velocity);
}

/// The order at which `error` falls when its argument, a number of steps, is doubled.
inline double order(const std::function<double(int)>& error, int steps) {
  return std::log2(error(steps) / error(2 * steps));
}

/// Two rolling balls, K Sec. IV A, in K's forces.
inline ContactScene colliding(double v_i, double v_j, double restitution, double collision_time,
                              const TangentialForce& tangential = NoTangentialForce{},
                              double half_distance = 0.0021) {
  const Scene hard = head_on(v_i, v_j, restitution, half_distance);
  SoftContact contact = linear_contact(0.5 * hard.bodies[0].mass, restitution, collision_time,
                                       ContactEnd::zero_overlap);
  contact.tangential = tangential;
  return with_contact(hard, contact);
}

}  // namespace slipcheck::test
