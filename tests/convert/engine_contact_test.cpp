// Continuous forms against closed forms; steps against bare programs of MuJoCo 2.2.2, ODE 0.16.2
// and Bullet 3.24 (double) that drop a sphere of 0.37 kg without gravity at 1 m/s on a plane, ω0 =
// 100 1/s, γ = 20 1/s, with eight phases (k + ½)/8 of a step at the first contact. They print six
// digits.

#include "convert/engine_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace slipcheck {
namespace {

constexpr auto kEnd = LinearContact::End::zero_force;
constexpr double kPrinted = 0.5e-6 * 1.001;

LinearContact probe() { return {0.37, 0.37 * 1e4, 20, kEnd}; }

using Phases = std::array<double, 8>;

void expect_rebounds(ContactStep step, double time_step, const Phases& measured) {
  for (std::size_t k = 0; k < measured.size(); ++k)
    EXPECT_NEAR(rebound(probe(), step, time_step, (static_cast<double>(k) + 0.5) / 8), measured[k],
                kPrinted)
        << "phase " << k << " at " << time_step << " s";
}

// mj_step, Euler, solref -10000 -20, condim 1; solimp d d with d = 0.5 and 0.9, a plane and a
// second sphere of 1.3 kg give the same digits.
TEST(EngineContact, MuJoCosStepIsTheRecurrence) {
  expect_rebounds(ContactStep::force_at_start, 1e-3,
                  {0.737181, 0.738488, 0.739795, 0.741450, 0.743696, 0.745943, 0.748189, 0.750435});
  expect_rebounds(ContactStep::force_at_start, 2e-3,
                  {0.731998, 0.734270, 0.736541, 0.738813, 0.741085, 0.746119, 0.752197, 0.758275});
}

// dWorldStep, dContactSoftERP and dContactSoftCFM of erp_cfm(), mu 0.
TEST(EngineContact, OdesStepIsTheRecurrence) {
  expect_rebounds(ContactStep::force_at_end, 1e-3,
                  {0.643640, 0.646010, 0.648381, 0.650752, 0.653122, 0.655493, 0.657863, 0.660234});
  expect_rebounds(ContactStep::force_at_end, 2e-3,
                  {0.559601, 0.563112, 0.567827, 0.574127, 0.580426, 0.586726, 0.593025, 0.599324});
}

// setContactStiffnessAndDamping(3700, 7.4) on the ball, (1e18, 0) on the plane.
TEST(EngineContact, BulletsStepIsTheRecurrence) {
  expect_rebounds(ContactStep::foreseen, 1e-3,
                  {0.642436, 0.642398, 0.642361, 0.642323, 0.642286, 0.642248, 0.642211, 0.642173});
  const Phases coarse = {0.559601, 0.554974, 0.553881, 0.554602,
                         0.555323, 0.556044, 0.556765, 0.557486};
  for (std::size_t k = 0; k < coarse.size(); ++k) {
    // The gap before the first contact is 1.875 mm, beyond the breaking threshold of 1.73 mm.
    const ContactStep step = k == 0 ? ContactStep::force_at_end : ContactStep::foreseen;
    EXPECT_NEAR(rebound(probe(), step, 2e-3, (static_cast<double>(k) + 0.5) / 8), coarse[k],
                kPrinted)
        << "phase " << k;
  }
}

// solref -10000 -20 has ω0 = 100 1/s and γ = 20 1/s: e = exp(−γ τ), τ = atan(2ω/γ)/ω.
TEST(EngineContact, ContinuousRestitutionIsTheClosedForm) {
  const double omega = std::sqrt(1e4 - 100);
  const double e = std::exp(-20 * std::atan(2 * omega / 20) / omega);
  EXPECT_NEAR(contact_of_solref({-1e4, -20}, 0.37, 1e-3).restitution(), e, 1e-14);
  // dampratio 1 is critical, for which e = e^−2 at zero force.
  EXPECT_NEAR(contact_of_solref({0.02, 1}, 1, 1e-4).restitution(), std::exp(-2), 1e-7);
}

// What is left is of the order of the step: at the 1e-5 s of a bare MuJoCo, 0.744004 … 0.744134.
TEST(EngineContact, StepsConvergeToIt) {
  const double e = probe().restitution();
  for (const auto step :
       {ContactStep::force_at_start, ContactStep::force_at_end, ContactStep::foreseen}) {
    const auto error = [&](double h) {
      const ReboundRange range = rebounds(probe(), step, h);
      return std::max(e - range.least, range.most - e);
    };
    EXPECT_NEAR(error(1e-4) / error(1e-5), 10, 1);
  }
  const ReboundRange fine = rebounds(probe(), ContactStep::force_at_start, 1e-5, 8);
  EXPECT_NEAR(fine.least, 0.744004, kPrinted);
  EXPECT_NEAR(fine.most, 0.744134, kPrinted);
}

TEST(EngineContact, SolrefsReadBackAsTheSameContact) {
  for (const SolRef& solref : {time_solref(probe()), stiffness_solref(probe())}) {
    const LinearContact back = contact_of_solref(solref, 0.37, 1e-4);
    EXPECT_NEAR(back.damping_rate(), 20, 1e-12);
    EXPECT_NEAR(back.contact_frequency(), 100, 1e-12);
  }
  EXPECT_NEAR(time_solref(probe()).first, 0.1, 1e-15);
  EXPECT_NEAR(time_solref(probe()).second, 0.1, 1e-15);
}

// timeconst 1 ms in steps of 1 ms counts as 2 ms: γ = 1000 1/s, ω0 = 1/(2 ms · 0.5).
TEST(EngineContact, RefsafeRaisesTheTimeConstant) {
  const LinearContact contact = contact_of_solref({1e-3, 0.5}, 1, 1e-3);
  EXPECT_NEAR(contact.damping_rate(), 1000, 1e-9);
  EXPECT_NEAR(contact.contact_frequency(), 1000, 1e-9);
}

// h k = 3.7, c = 7.4 N s/m: ERP 1/3, CFM 1/11.1.
TEST(EngineContact, ErpAndCfmOfASpringAndADashpot) {
  const ErpCfm both = erp_cfm(probe(), 1e-3);
  EXPECT_NEAR(both.erp, 1.0 / 3, 1e-14);
  EXPECT_NEAR(both.cfm, 1 / 11.1, 1e-14);
  EXPECT_NEAR(damping_constant(probe()), 7.4, 1e-14);
}

// Without damping the recurrence at the start of a step gains or loses by the phase alone; what
// ends the collision is that the spring lets go.
TEST(EngineContact, AnElasticContactHasNoTimeConstant) {
  const LinearContact elastic(0.37, 3700, 0, kEnd);
  EXPECT_TRUE(std::isinf(time_solref(elastic).first));
  EXPECT_NEAR(rebound(elastic, ContactStep::force_at_start, 1e-6, 0.5), 1, 1e-3);
}

}  // namespace
}  // namespace slipcheck
