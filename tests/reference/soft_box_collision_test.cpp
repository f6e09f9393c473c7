#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "physics/contact/collision.h"
#include "reference/forces/contact_solver.h"
#include "scene/impact.h"
#include "soft_box_scenes.h"

namespace slipcheck {
namespace {

using namespace test;

constexpr double kRadius = BeadBox::kRadius;

double restitution(const ContactScene& scene, double g, double time, double steps = 25) {
  const std::vector<BodyState> s = after(scene, time, steps);
  return (s[1].velocity.x() - s[0].velocity.x()) / g;
}

TEST(SoftBoxCollision, RestitutionOfABinaryCollision) {
  BeadBox box;
  box.gravity = 0;
  for (const ContactEnd end : {ContactEnd::zero_overlap, ContactEnd::zero_force})
    for (const double e : {1.0, 0.9, 0.5, 0.1}) {
      box.end = end;
      box.restitution = e;
      const ContactScene scene = box.scene(meeting(0.3));
      // 25 steps of the fourth order leave about (π/25)⁴/120 = 2e-6 of the phase.
      EXPECT_NEAR(restitution(scene, 0.3, 1e-4), e, 1e-5) << e;
    }
}

TEST(SoftBoxCollision, FourthOrderInTheStepOfALinearContact) {
  BeadBox box;
  box.gravity = 0;
  box.restitution = 0.6;
  box.end = ContactEnd::zero_overlap;
  const ContactScene scene = box.scene(meeting(0.3));
  const auto error = [&](double steps) {
    return std::abs(restitution(scene, 0.3, 1e-4, steps) - 0.6);
  };
  // The next term of the error is a step, 1/20 of the contact, smaller.
  EXPECT_NEAR(std::log2(error(20) / error(40)), 4, 0.4);
  EXPECT_NEAR(std::log2(error(40) / error(80)), 4, 0.3);
}

TEST(SoftBoxCollision, RestitutionOfNonlinearLaws) {
  BeadBox box;
  box.gravity = 0;
  const double g = 0.3, mass = 0.5 * BeadBox::mass();
  for (const ContactEnd end : {ContactEnd::zero_overlap, ContactEnd::zero_force})
    for (const NormalForce& law :
         {NormalForce(HertzForce{3e9}), NormalForce(ViscoelasticForce{3e9, 3e-7}),
          NormalForce(CompactViscoelasticForce{3e9, 3e-7}),
          NormalForce(PowerForce{3e9, 1e4, 1.5, 1}), NormalForce(PowerForce{1e8, 3, 1.25, 0.25})}) {
      ContactScene scene = box.scene(meeting(g));
      scene.soft[0] = SoftContact{law, end, {}};
      const Impact exact = impact(law, mass, g, end);
      const double time = 4e-6 + 2 * exact.duration;
      // The steps at both ends, of 1/800 of the contact, leave the power 3/2 of that, 4e-5, of the
      // part of the force that begins like √t; with 200 steps 2e-6.
      EXPECT_NEAR(restitution(scene, g, time), exact.restitution, 5e-5) << law.index();
      EXPECT_NEAR(restitution(scene, g, time, 200), exact.restitution, 1e-6) << law.index();
    }
}

TEST(SoftBoxCollision, TangentialLawsAgainstTheOtherContactSolver) {
  BeadBox box;
  box.gravity = 0;
  box.restitution = 0.8;
  std::vector<BodyState> initial = meeting(0.3);
  initial[0].angular_velocity.y() = 150;
  initial[1].velocity.z() = 0.02;
  initial[1].position.z() += 1e-4;
  const double damping = 0.5 * BeadBox::mass() / box.collision_time;
  for (const ContactEnd end : {ContactEnd::zero_overlap, ContactEnd::zero_force})
    for (const TangentialForce& law :
         {TangentialForce(NoTangentialForce{}), TangentialForce(ViscousForce{0.3 * damping, 10}),
          TangentialForce(ViscousForce{damping, 0.1}),
          TangentialForce(ViscousForce{20 * damping, 0.1}),
          TangentialForce(AsperityForce{0.2, 3e-7, AsperityForce::Form::printed}),
          TangentialForce(AsperityForce{0.2, 3e-8, AsperityForce::Form::printed}),
          TangentialForce(AsperityForce{0.2, 3e-7, AsperityForce::Form::passive}),
          TangentialForce(AsperityForce{0.2, 3e-8, AsperityForce::Form::passive}),
          TangentialForce(ImpactAngleForce{0.05, 0.4, 2.0 / 7, 0.8}),
          TangentialForce(ImpactAngleForce{10, 0.4, 2.0 / 7, 0.8})}) {
      box.end = end;
      ContactScene scene = box.scene(initial);
      scene.soft[0]->tangential = law;
      ContactSolver other(scene, initial);
      other.run(until_time(4e-5), nullptr);
      const std::vector<BodyState> exact = other.states();
      const std::vector<BodyState> states = after(scene, 4e-5, 50);
      for (std::size_t i = 0; i < 2; ++i) {
        // Steps of the contact over 50 leave 1e-6 of the speeds.
        EXPECT_LT((states[i].velocity - exact[i].velocity).norm(), 1e-6) << law.index();
        EXPECT_NEAR(kRadius * states[i].angular_velocity.y(),
                    kRadius * exact[i].angular_velocity.y(), 1e-6)
            << law.index();
      }
    }
}

TEST(SoftBoxCollision, LAppBExchangesTheImpulseOfTheHardRule) {
  // To first order in t_col, in which the line of centres turns: a tenth of it for a tenth of that.
  // The first two slide, the others stick and are thrown back, stopped, and let go on.
  BeadBox box;
  box.gravity = 0;
  box.restitution = 0.8;
  std::vector<BodyState> initial = meeting(0.3);
  initial[0].angular_velocity.y() = 150;
  initial[1].angular_velocity.y() = 40;
  initial[1].velocity.z() = 0.02;
  initial[1].position.z() += 1e-4;
  const PairContact rules[] = {
      {0.8, 0.02, 0.4}, {0.8, 0.05, 0.4}, {0.8, 10, 0.6}, {0.8, 10, 0}, {0.8, 10, -0.7}};
  for (const ContactEnd end : {ContactEnd::zero_overlap, ContactEnd::zero_force})
    for (const PairContact& rule : rules) {
      box.end = end;
      const auto difference = [&](double collision_time) {
        box.collision_time = collision_time;
        ContactScene scene = box.scene(initial);
        scene.soft[0]->tangential = ImpactAngleForce{std::get<double>(rule.friction),
                                                     rule.tangential_restitution, 2.0 / 7, 0.8};
        const std::vector<BodyState> soft = after(scene, 1e-4, 100);
        // The hard rule where they touch, after 0.3 m/s and more along the line of centres.
        Vector3 dx = initial[0].position - initial[1].position;
        const Vector3 dv = initial[0].velocity - initial[1].velocity;
        const double b = dx.dot(dv), c = dx.squaredNorm() - 4 * kRadius * kRadius;
        const double t = (-b - std::sqrt(b * b - dv.squaredNorm() * c)) / dv.squaredNorm();
        std::vector<BodyState> hard = initial;
        for (BodyState& s : hard) s.position += t * s.velocity;
        const Sphere ball{kRadius, BeadBox::mass(), 0.4};
        const SubstrateContact none;
        collide(rule, {}, {ball, none, hard[0], false}, {ball, none, hard[1], false});
        double most = 0;
        for (std::size_t i = 0; i < 2; ++i) {
          most = std::max(most, (soft[i].velocity - hard[i].velocity).norm());
          most = std::max(most,
                          kRadius * (soft[i].angular_velocity - hard[i].angular_velocity).norm());
        }
        return most;
      };
      const double left = difference(1e-5), tenth = difference(1e-6);
      EXPECT_LT(left, 0.3 * 0.3 * 1e-5 / kRadius);
      EXPECT_NEAR(left / tenth, 10, 1)
          << std::get<double>(rule.friction) << ' ' << rule.tangential_restitution;
    }
}

TEST(SoftBoxCollision, ViscousWallStopsTheSlipExponentially) {
  BeadBox box;
  box.gravity = 0;
  box.restitution = 0.7;
  box.friction = 1e6;  // capped only where F_N passes zero
  box.slowing = 1.5;
  box.end = ContactEnd::zero_overlap;
  const ContactScene scene = box.scene({bead(kRadius + 1e-6, 0.01, -0.2, 0.05, 30)});
  const BodyState s = after(scene, 5e-5)[0];
  // n = x, t = −z: u = −v_z − R w, falls by e^−1.5 while they touch; c is that over t_col times the
  // mobility.
  const double u = -0.05 - kRadius * 30, change = u * (std::exp(-1.5) - 1);
  EXPECT_NEAR(s.velocity.x(), 0.14, 1e-6);
  EXPECT_NEAR(s.velocity.z(), 0.05 - change / 3.5, 2e-6);
  EXPECT_NEAR(kRadius * s.angular_velocity.y(), kRadius * 30 - 2.5 * change / 3.5, 5e-6);
}

TEST(SoftBoxCollision, SlidingWallTakesCoulombsImpulse) {
  BeadBox box;
  box.gravity = 0;
  box.friction = 0.2;
  const ContactScene scene = box.scene({bead(kRadius + 1e-6, 0.01, -0.2, 0.5)});
  const BodyState s = after(scene, 5e-5)[0];
  // F_T = μ F_N throughout: μ (1 + e) v_x off the velocity along the wall. L's β1.
  const double impulse = 0.2 * 1.9 * 0.2;
  EXPECT_NEAR(s.velocity.z(), 0.5 - impulse, 2e-6);
  EXPECT_NEAR(kRadius * s.angular_velocity.y(), -2.5 * impulse, 5e-6);
}

TEST(SoftBoxCollision, MovingWallsCarryAlongAndTheLidReflects) {
  BeadBox box;
  box.gravity = 0;
  box.restitution = 1;
  box.friction = 1e3;
  box.slowing = 50;
  box.end = ContactEnd::zero_overlap;
  box.collision_time = 1e-6;
  box.box.floor = {1e-3, 20};
  box.box.moving_walls = true;
  box.box.lid = 0.02;
  const double V = box.box.floor.largest_speed();
  // Meets the wall at rest after 1 µs: u = −v_z + V becomes 0, at 2/7 of V.
  const BodyState s = after(box.scene({bead(kRadius + 1e-6, 0.01, -1, 0)}), 3e-6)[0];
  // cos ωt changes by 1e-7, and e^−50 is nothing.
  EXPECT_NEAR(s.velocity.z(), V / 3.5, 1e-5 * V);
  const BodyState t = after(box.scene({bead(0.01, 0.02 - kRadius - 1e-6, 0, 1)}), 4e-6)[0];
  EXPECT_NEAR(t.velocity.z(), -1 + 2 * V, 1e-5 * V);
  box.box.moving_walls = false;
  const BodyState r = after(box.scene({bead(0.01, 0.02 - kRadius - 1e-6, 0, 1)}), 4e-6)[0];
  EXPECT_NEAR(r.velocity.z(), -1, 1e-5);
}

}  // namespace
}  // namespace slipcheck
