#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "../support/extremes.h"
#include "physics/contact/linear_contact.h"
#include "reference/events/event_solver.h"
#include "reference/forces/soft_box_solver.h"
#include "scene/contact_scene.h"

namespace slipcheck::test {

/// Steel beads of 1 mm diameter in a box, all contacts alike but for the reduced mass.
struct BeadBox {
  double restitution = 0.9;
  double collision_time = 1e-5;  ///< [s]
  ContactEnd end = ContactEnd::zero_force;
  double friction = 0;  ///< μ; the viscous damping is `slowing` over the collision time
  double slowing = 100;
  Box box;
  double gravity = 9.81;

  static constexpr double kRadius = 0.5e-3;
  static double mass() { return 7850 * 4 * M_PI / 3 * kRadius * kRadius * kRadius; }

  BeadBox() { box.width = 0.02; }

  SoftContact contact(double reduced_mass) const {
    const LinearContact law =
        LinearContact::with_collision_time(reduced_mass, restitution, collision_time, end);
    SoftContact made{LinearForce{law.stiffness(), law.damping_rate() * reduced_mass}, end, {}};
    // The slip's mobility is 7/2 over the reduced mass for solid spheres.
    if (friction > 0)
      made.tangential = ViscousForce{slowing * reduced_mass / (3.5 * collision_time), friction};
    return made;
  }

  ContactScene scene(const std::vector<BodyState>& initial) const {
    ContactScene made;
    Scene& hard = made.hard;
    hard.gravity = gravity;
    hard.bodies.assign(initial.size(), Sphere{kRadius, mass(), 0.4});
    hard.material.assign(initial.size(), 0);
    hard.initial = initial;
    hard.substrate.resize(1);
    hard.pairs.resize(1);
    hard.box = box;
    made.soft = {contact(0.5 * mass())};
    made.soft_box.on_floor = made.soft_box.on_wall = made.soft_box.on_lid = {contact(mass())};
    return made;
  }
};

inline BodyState bead(double x, double z, double vx, double vz, double w = 0) {
  return {{x, 0, z}, {vx, 0, vz}, {0, w, 0}};
}

inline std::vector<BodyState> after(const ContactScene& scene, double time, double steps = 25) {
  SoftBoxSolver solver(scene, scene.hard.initial, {steps});
  EXPECT_TRUE(solver.run(until_time(time), nullptr).reached);
  return solver.states();
}

/// Two beads without gravity in the middle of the box that meet at g [m/s] after `gap`/g.
inline std::vector<BodyState> meeting(double g, double gap = 1e-6) {
  return {bead(0.01 - BeadBox::kRadius - 0.5 * gap, 0.01, 0.5 * g, 0),
          bead(0.01 + BeadBox::kRadius + 0.5 * gap, 0.01, -0.5 * g, 0)};
}

/// The same box with hard contacts, L (5)-(12) with sliding friction alone, from event to event
/// with all pairs looked at each time. Written apart from the solvers, in two dimensions; side
/// walls and floor, no lid.
class PlainHardBox {
 public:
  PlainHardBox(const BeadBox& box, std::vector<BodyState> state)
      : box_(box), state_(std::move(state)) {}

  std::size_t pairs = 0, bounces = 0;
  /// The smallest |u|/g after an event with friction: it still slid.
  double least_slip = std::numeric_limits<double>::infinity();

  const std::vector<BodyState>& run(double end) {
    while (true) {
      double first = end;
      std::size_t a = 0;
      int b = -1;
      for (std::size_t i = 0; i < state_.size(); ++i) {
        for (int k = 0; k < 3; ++k) look(first, a, b, surface_time(i, k), i, -1 - k);
        for (std::size_t j = 0; j < i; ++j)
          look(first, a, b, pair_time(i, j), i, static_cast<int>(j));
      }
      const bool is_end = first >= end;
      const double dt = first - now_;
      for (BodyState& s : state_) s = flown(s, dt);
      now_ = first;
      if (is_end) return state_;
      collide(a, b);
    }
  }

 private:
  BodyState flown(BodyState s, double dt) const {
    s.position += dt * s.velocity - Vector3(0, 0, 0.5 * box_.gravity * dt * dt);
    s.velocity.z() -= box_.gravity * dt;
    return s;
  }
  static void look(double& first, std::size_t& a, int& b, double t, std::size_t i, int partner) {
    if (t >= first) return;
    first = t;
    a = i;
    b = partner;
  }
  double pair_time(std::size_t i, std::size_t j) const {
    const Vector3 dx = state_[i].position - state_[j].position;
    const Vector3 dv = state_[i].velocity - state_[j].velocity;
    const double b = dx.dot(dv), c = dx.squaredNorm() - 4 * BeadBox::kRadius * BeadBox::kRadius;
    const double d = b * b - dv.squaredNorm() * c;
    if (b >= 0 || d < 0) return 1e300;
    return now_ + (-b - std::sqrt(d)) / dv.squaredNorm();
  }
  /// Floor (0): by steps of 1 µs and bisection. Side walls (1, 2).
  double surface_time(std::size_t i, int which) const {
    const BodyState& s = state_[i];
    if (which > 0) {
      const double sign = which == 1 ? -1 : 1;
      const double wall = which == 1 ? 0 : box_.box.width;
      const double speed = sign * s.velocity.x();
      const double gap = sign * (wall - s.position.x()) - BeadBox::kRadius;
      return speed > 0 ? now_ + gap / speed : 1e300;
    }
    const auto gap = [&](double dt) {
      return flown(s, dt).position.z() - BeadBox::kRadius - box_.box.floor.height(now_ + dt);
    };
    // A ball that has just bounced is at the floor and leaves it.
    for (double dt = 1e-7; dt < 0.1; dt += 1e-6) {
      if (gap(dt + 1e-6) > 0) continue;
      double low = dt, high = dt + 1e-6;
      for (int k = 0; k < 60; ++k) (gap(0.5 * (low + high)) > 0 ? low : high) = 0.5 * (low + high);
      return now_ + high;
    }
    return 1e300;
  }
  void collide(std::size_t i, int partner) {
    Vector3 n, other = Vector3::Zero();
    double share = 1, turn = BeadBox::kRadius * state_[i].angular_velocity.y();
    BodyState* second = nullptr;
    if (partner >= 0) {
      second = &state_[static_cast<std::size_t>(partner)];
      n = (state_[i].position - second->position).normalized();
      other = second->velocity;
      turn += BeadBox::kRadius * second->angular_velocity.y();
      share = 0.5;
      ++pairs;
    } else {
      n = partner == -1 ? Vector3(0, 0, 1) : Vector3(partner == -2 ? 1 : -1, 0, 0);
      const bool moves = partner == -1 || box_.box.moving_walls;
      if (moves) other.z() = box_.box.floor.velocity(now_);
      ++bounces;
    }
    const Vector3 t(n.z(), 0, -n.x());
    const Vector3 dv = state_[i].velocity - other;
    const double g = -dv.dot(n), u = dv.dot(t) - turn;
    const double normal = share * (1 + box_.restitution) * g;  // per mass
    const double tangential = -std::copysign(box_.friction * normal, u);
    if (box_.friction > 0) {
      const double after = std::abs(u) - 3.5 / share * box_.friction * normal;
      least_slip = test::least_of(least_slip, after / g);
    }
    const Vector3 impulse = normal * n + tangential * t;
    const double spin = -tangential / (0.4 * BeadBox::kRadius);
    state_[i].velocity += impulse;
    state_[i].angular_velocity.y() += spin;
    if (second) {
      second->velocity -= impulse;
      second->angular_velocity.y() += spin;
    }
  }

  BeadBox box_;
  std::vector<BodyState> state_;
  double now_ = 0;
};

}  // namespace slipcheck::test
