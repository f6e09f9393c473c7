#include "reference/pair/pair_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "../support/runge_kutta.h"
#include "free_collision.h"
#include "physics/contact/elastic_pair.h"
#include "physics/contact/linear_contact.h"
#include "reference/pair/pair_batch.h"

namespace slipcheck {
namespace {

using Form = AsperityForce::Form;

/// Ice as B has it: Y = 10 GPa, ν = 0.3, 1000 kg/m³, A = 1e-6 s.
constexpr double kIceModulus = 1e10, kIcePoisson = 0.3, kIceDensity = 1000, kIceTime = 1e-6;

Sphere ice_sphere(double radius = 0.01) {
  return {radius, kIceDensity * 4 * M_PI / 3 * std::pow(radius, 3), 0.4};
}

ViscoelasticForce ice_force(double effective_radius) {
  const ElasticMaterial ice{kIceModulus, kIcePoisson, kIceTime};
  return {hertz_modulus(ice, ice, effective_radius), kIceTime};
}

/// Two ice spheres of 1 cm with asperities of the size ζ0 = relative_size R_eff.
SoftContact rough_ice(double friction, double relative_size, Form form) {
  const double effective_radius = 0.005;
  return {ice_force(effective_radius), ContactEnd::zero_overlap,
          AsperityForce{friction, relative_size * effective_radius, form}};
}

/// B's μ = α √ζ0 with α = 1 cm^-1/2.
double papers_friction(double relative_size) { return std::sqrt(100 * relative_size * 0.005); }

/// Unlike spheres, so that no factor of equal masses goes unseen.
const Sphere kFirst{0.01, 0.02, 0.4}, kSecond{0.015, 0.05, 2.0 / 3};

/// 1/(κ m_eff) = Σ (1/m + R²/I).
double slip_mobility(const Sphere& first, const Sphere& second) {
  const auto of = [](const Sphere& s) {
    return 1 / s.mass + s.radius * s.radius / s.moment_of_inertia();
  };
  return of(first) + of(second);
}

TEST(PairMap, B8SolidSpheresHaveTwoSevenths) {
  const Sphere ball{0.01, 0.02, 0.4};
  EXPECT_DOUBLE_EQ(slip_mobility(ball, ball) * effective_mass(ball, ball), 3.5);
}

TEST(PairMap, SmoothSpheresKeepTheirSlip) {
  const SoftContact contact{ice_force(0.005), ContactEnd::zero_overlap, NoTangentialForce{}};
  const PairCollision c = test::collide_freely(contact, kFirst, kSecond, 0.3, 0.2);
  EXPECT_EQ(c.tangential_restitution, 1);
  EXPECT_LT(c.normal_restitution, 1);
  EXPECT_LT(c.energy_change, 0);
}

TEST(PairMap, LinearContactMeetsItsClosedForm) {
  const double mass = effective_mass(kFirst, kSecond);
  for (const bool clamp : {false, true}) {
    const LinearContact exact = LinearContact::with_collision_time(
        mass, 0.7, 1e-4, clamp ? ContactEnd::zero_force : ContactEnd::zero_overlap);
    const SoftContact contact{LinearForce{exact.stiffness(), exact.damping_rate() * mass},
                              clamp ? ContactEnd::zero_force : ContactEnd::zero_overlap,
                              NoTangentialForce{}};
    const PairCollision c = test::collide_freely(contact, kFirst, kSecond, 0.3, 0.2);
    // 1e-10: some hundred steps at a local error of 1e-12.
    EXPECT_NEAR(c.normal_restitution, 0.7, 1e-10);
    EXPECT_NEAR(c.duration, 1e-4, 1e-14);
    EXPECT_NEAR(c.energy_change, 0.5 * mass * 0.09 * (0.49 - 1), 1e-10 * mass);
  }
}

TEST(PairMap, B24SmallDissipationSeries) {
  // 1 − ε^N = 1.15344 x − 0.79826 x² + … with x = A κ_v^{2/5} g^{1/5}: the quotient tends to the
  // first coefficient, and the next term makes it fall in proportion to x.
  const Sphere ball = ice_sphere();
  const double mass = effective_mass(ball, ball);
  const auto quotient = [&](double dissipation_time) {
    ViscoelasticForce law = ice_force(0.005);
    law.dissipation_time = dissipation_time;
    const double x = dissipation_time * std::pow(viscoelastic_constant(mass, law.modulus), 0.4) *
                     std::pow(0.1, 0.2);
    const SoftContact contact{law, ContactEnd::zero_overlap, NoTangentialForce{}};
    return (1 - test::collide_freely(contact, ball, ball, 0.1, 1).normal_restitution) / x;
  };
  const double coarse = quotient(2e-9), fine = quotient(1e-9);
  // The extrapolation leaves x² ~ 1e-8 and the integration's 1e-12/x ~ 1e-8.
  EXPECT_NEAR(2 * fine - coarse, 1.15344, 1e-5);
}

TEST(PairMap, BA13HertzDuration) {
  const Sphere ball = ice_sphere();
  ViscoelasticForce law = ice_force(0.005);
  const SoftContact contact{HertzForce{law.modulus}, ContactEnd::zero_overlap, NoTangentialForce{}};
  const PairCollision c = test::collide_freely(contact, ball, ball, 0.25, 1);
  const double mass = effective_mass(ball, ball);
  EXPECT_NEAR(c.duration / hertz_duration(mass, law.modulus, 0.25), 1, 1e-9);
  EXPECT_NEAR(c.normal_restitution, 1, 1e-9);
}

TEST(PairMap, B39ViscousForceBelowTheCapDecaysExponentially) {
  const double mass = effective_mass(kFirst, kSecond), damping = 30;
  const LinearContact exact =
      LinearContact::with_collision_time(mass, 0.8, 1e-4, ContactEnd::zero_overlap);
  // With F_N(0) = c g_N > 0 a huge coefficient keeps the cap away but for the instant where F_N
  // changes sign; ~1e-9 of the collision.
  const SoftContact contact{LinearForce{exact.stiffness(), exact.damping_rate() * mass},
                            ContactEnd::zero_overlap, ViscousForce{damping, 1e9}};
  const PairCollision c = test::collide_freely(contact, kFirst, kSecond, 0.3, 0.2);
  const double expected = std::exp(-damping * slip_mobility(kFirst, kSecond) * 1e-4);
  EXPECT_LT(expected, 0.9);
  EXPECT_NEAR(c.tangential_restitution, expected, 1e-8);
}

TEST(PairMap, L5SlidingLimit) {
  // |F_T| = μ F_N all along, and the impulse of F_N is m_eff (1 + ε^N) g_N.
  const double friction = 0.1, g_n = 0.2, g_t = 0.5;
  for (const ContactEnd end : {ContactEnd::zero_overlap, ContactEnd::zero_force}) {
    const SoftContact contact{HertzForce{1e9}, end, ViscousForce{1e7, friction}};
    const PairCollision c = test::collide_freely(contact, kFirst, kSecond, g_n, g_t);
    const double kappa = 1 / (slip_mobility(kFirst, kSecond) * effective_mass(kFirst, kSecond));
    const double expected = 1 - friction * (1 + c.normal_restitution) * g_n / (kappa * g_t);
    EXPECT_NEAR(c.tangential_restitution, expected, 1e-9);
  }
}

TEST(PairMap, DampedSlidingLimitWithAClamp) {
  const SoftContact contact{ice_force(0.005), ContactEnd::zero_force, ViscousForce{1e7, 0.05}};
  const PairCollision c = test::collide_freely(contact, kFirst, kSecond, 0.2, 0.5);
  const double kappa = 1 / (slip_mobility(kFirst, kSecond) * effective_mass(kFirst, kSecond));
  const double expected = 1 - 0.05 * (1 + c.normal_restitution) * 0.2 / (kappa * 0.5);
  EXPECT_NEAR(c.tangential_restitution, expected, 1e-9);
}

TEST(PairMap, StrongViscousForceStopsTheSlip) {
  // The cap holds until the slip is c/(κ m_eff) slow; then it decays within 1e-3 of the collision.
  const SoftContact contact{HertzForce{1e9}, ContactEnd::zero_overlap, ViscousForce{1e5, 0.5}};
  const PairCollision c = test::collide_freely(contact, kFirst, kSecond, 0.5, 0.1);
  EXPECT_GE(c.tangential_restitution, -1e-10);
  EXPECT_LT(c.tangential_restitution, 1e-3);
}

TEST(PairMap, TheTablesErrorFallsWithTheSquareOfItsStep) {
  // Between points of a smooth function a plane is wrong by its curvature: mean errors at a
  // thousand places fall fourfold where the step is halved. Both restitutions change with the
  // normal speed.
  const SoftContact contact{ice_force(0.005), ContactEnd::zero_overlap, ViscousForce{30, 1e9}};
  const Sphere ball = ice_sphere();
  constexpr double kSlowest = 0.05, kFastest = 1;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> speed(kSlowest, kFastest);
  std::vector<double> normal, tangential;
  for (int k = 0; k < 1000; ++k) {
    normal.push_back(speed(random));
    tangential.push_back(speed(random));
  }
  std::vector<PairCollision> exact(normal.size());
  collide_batch(contact, ball, ball, normal, tangential, 256, exact);
  std::array<double, 3> normal_error{}, tangential_error{};
  for (std::size_t n = 0; n < 3; ++n) {
    const PairMap map(contact, ball, kSlowest, kFastest, 4 << n);
    for (std::size_t k = 0; k < exact.size(); ++k) {
      const PairMap::Restitution read = map.at(normal[k], tangential[k]);
      normal_error[n] += std::abs(read.normal - exact[k].normal_restitution);
      tangential_error[n] += std::abs(read.tangential - exact[k].tangential_restitution);
    }
  }
  for (const auto& error : {normal_error, tangential_error}) {
    EXPECT_GT(error[2], 0);
    EXPECT_NEAR(error[0] / error[1], 4, 0.5);
    EXPECT_NEAR(error[1] / error[2], 4, 0.5);
  }
}

TEST(PairMap, TheTableIsConstantOutside) {
  const SoftContact contact{ice_force(0.005), ContactEnd::zero_overlap, ViscousForce{30, 1e9}};
  const Sphere ball = ice_sphere();
  const PairMap map(contact, ball, 0.05, 1);
  EXPECT_DOUBLE_EQ(map.at(1e-6, 0.1).normal, map.at(0.05, 0.1).normal);
  EXPECT_DOUBLE_EQ(map.at(0.3, 1e-6).tangential, map.at(0.3, 0.05).tangential);
  EXPECT_DOUBLE_EQ(map.at(0, 0).tangential, map.at(0.05, 0.05).tangential);
  EXPECT_NEAR(map.at(50, 70).normal, map.at(10, 10).normal, 1e-12);
}

/// An independent integration of the printed law: Runge-Kutta with equal steps, the saw-tooth
/// evaluated as it stands, so that each break costs an error of first order in the step.
double printed_by_runge_kutta(const SoftContact& contact, const Sphere& ball, double g_n,
                              double g_t, double h) {
  const auto& law = std::get<ViscoelasticForce>(contact.normal);
  const auto& rough = std::get<AsperityForce>(contact.tangential);
  const double mass = effective_mass(ball, ball);
  using State = Eigen::Vector4d;
  const auto rate = [&](double, const State& y) {
    const double normal = law(std::max(0.0, y[0]), y[1]);
    const double bend = y[3] / rough.size;
    const double tooth = bend - std::trunc(bend);
    return State(y[1], -normal / mass, -3.5 * rough.friction * normal * tooth / mass, y[2]);
  };
  State y(0, g_n, g_t, 0);
  while (y[0] >= 0) y = test::runge_kutta_step(rate, 0, y, h);
  return y[2] / g_t;
}

TEST(PairMap, B35PrintedLawCreatesEnergyAsMeasured) {
  const Sphere ball = ice_sphere();
  const SoftContact contact = rough_ice(0.1, 2e-4, Form::printed);
  const PairCollision c = test::collide_freely(contact, ball, ball, 1, 0.1);
  // physics-notes.md gives two digits after the point.
  EXPECT_NEAR(c.tangential_restitution, -1.26, 0.005);
  // A break is late by a step of 1e-9 s; ε^T changes by 1e-4 of its size.
  EXPECT_NEAR(c.tangential_restitution, printed_by_runge_kutta(contact, ball, 1, 0.1, 1e-9), 2e-3);
}

TEST(PairMap, B35PapersFrictionIsPassiveFrom1MillimetreTo1MetrePerSecond) {
  const Sphere ball = ice_sphere();
  const SoftContact contact = rough_ice(papers_friction(2e-4), 2e-4, Form::printed);
  for (double g_n = 1e-3; g_n < 1.1; g_n *= std::sqrt(10.0))
    for (double g_t = 1e-3; g_t < 1.1; g_t *= std::sqrt(10.0)) {
      const PairCollision c = test::collide_freely(contact, ball, ball, g_n, g_t, 1e-10);
      EXPECT_LE(std::abs(c.tangential_restitution), 1) << g_n << ", " << g_t;
    }
}

TEST(PairMap, BFig2SlidingAtSmallNormalSpeedReversalAtSmallTangentialSpeed) {
  const Sphere ball = ice_sphere();
  for (const double size : {2e-4, 2e-5}) {
    const double friction = papers_friction(size);
    const SoftContact contact = rough_ice(friction, size, Form::printed);
    // Hundreds of asperities break: on average half of μ F_N acts.
    const PairCollision sliding = test::collide_freely(contact, ball, ball, 1e-3, 1, 1e-10);
    const double lost = 0.5 * friction * (1 + sliding.normal_restitution) * 3.5 * 1e-3;
    EXPECT_NEAR((1 - sliding.tangential_restitution) / lost, 1, 0.02) << size;
    // The bent asperity that no slip breaks throws the slip back.
    EXPECT_LT(test::collide_freely(contact, ball, ball, 1, 1e-3, 1e-10).tangential_restitution,
              -0.5)
        << size;
    // From one to the other, ε^T falls with g_N.
    double before = 1;
    for (double g_n : {1e-3, 1e-2, 0.1, 0.4}) {
      const double now =
          test::collide_freely(contact, ball, ball, g_n, 3e-3, 1e-10).tangential_restitution;
      EXPECT_LT(now, before) << size << ", " << g_n;
      before = now;
    }
  }
}

TEST(PairMap, PassiveAsperityThatDoesNotBreakIsASpringWhileTheForceFalls) {
  // While F_N grows, F_T = −(μ/ζ0) ∫F_N du; the closed form needs F_N(t): the undamped linear
  // contact, F_N = F sin ωt. To first order in μ/ζ0 the slip stays g_T, so that with s = ωt
  //   F_N b = (F g_T/ω)(1 − cos s) up to s = π/2, then b = g_T/ω (1 + s − π/2),
  //   κ m_eff Δu = −(μ/ζ0)(F g_T/ω²)[∫(1 − cos s) ds + ∫ sin s (1 + s − π/2) ds]
  //              = −(μ/ζ0)(F g_T/ω²)[(π/2 − 1) + π/2].
  const double mass = effective_mass(kFirst, kSecond), stiffness = 1e6, g_n = 0.1, g_t = 0.02;
  const double omega = std::sqrt(stiffness / mass), force = stiffness * g_n / omega;
  const double size = 1e-4, friction = 1e-6 * size / 1e-4;
  const SoftContact contact{LinearForce{stiffness, 0}, ContactEnd::zero_overlap,
                            AsperityForce{friction, size, Form::passive}};
  const PairCollision c = test::collide_freely(contact, kFirst, kSecond, g_n, g_t);
  const double lost =
      friction / size * force / (omega * omega) * (M_PI - 1) * slip_mobility(kFirst, kSecond);
  ASSERT_LT(g_t * M_PI / omega, size);
  // Second order in `lost` (1e-6) and the integration's 1e-12 over it.
  EXPECT_NEAR((1 - c.tangential_restitution) / lost, 1, 1e-5) << lost;
}

TEST(PairMap, PassiveFormNeverCreatesEnergy) {
  std::mt19937_64 random(5);
  const auto within = [&](double low, double high) {  // uniform in the logarithm
    const double u = static_cast<double>(random() >> 11) * 0x1p-53;
    return low * std::pow(high / low, u);
  };
  int reversed = 0, lossless = 0;
  for (int n = 0; n < 400; ++n) {
    const Sphere first{within(1e-3, 1e-1), within(1e-3, 1), within(0.3, 1)};
    const Sphere second{within(1e-3, 1e-1), within(1e-3, 1), within(0.3, 1)};
    const double g_n = within(1e-3, 3), g_t = g_n * within(1e-3, 10);
    const double mass = effective_mass(first, second);
    SoftContact contact;
    const double modulus = within(1e6, 1e10);
    // The overlap that the speed reaches sets the scale of dissipation and of asperities.
    const double overlap = hertz_largest_overlap(mass, modulus, g_n), time = overlap / g_n;
    const double loss = random() % 3 == 0 ? 0 : within(0.01, 2);
    const double stiffness = mass / (time * time);
    switch (random() % 5) {
      case 0:
        contact.normal = LinearForce{stiffness, 0.7 * loss * mass / time};
        break;
      case 1:
        contact.normal = HertzForce{modulus};
        break;
      case 2:
        contact.normal = PowerForce{modulus, loss * mass / (time * overlap), 1.5, 1};
        break;
      case 3:
        contact.normal = ViscoelasticForce{modulus, 0.3 * loss * time};
        break;
      default:
        contact.normal = CompactViscoelasticForce{modulus, 0.3 * loss * time};
    }
    contact.end = random() % 2 ? ContactEnd::zero_overlap : ContactEnd::zero_force;
    const double size = overlap * within(0.1, 10);
    contact.tangential = AsperityForce{within(0.01, 3), size, Form::passive};
    const PairCollision c = test::collide_freely(contact, first, second, g_n, g_t, 1e-10);
    const double kappa = tangential_mass_ratio(first, second);
    const double energy = 0.5 * mass * (g_n * g_n + kappa * g_t * g_t);
    // 1e-7: up to a thousand breaks of a tolerance of 1e-10 each.
    EXPECT_LE(c.energy_change, 1e-7 * energy) << n;
    EXPECT_LE(std::abs(c.tangential_restitution), 1 + 1e-7) << n;
    reversed += c.tangential_restitution < 0;
    lossless += c.energy_change > -1e-3 * energy;
  }
  // The cases are of both kinds.
  EXPECT_GT(reversed, 20);
  EXPECT_GT(lossless, 20);
}

TEST(PairMap, ToleranceDoesNotMatter) {
  const Sphere ball = ice_sphere();
  for (const Form form : {Form::printed, Form::passive}) {
    const SoftContact contact = rough_ice(0.1, 2e-4, form);
    const double coarse =
        test::collide_freely(contact, ball, ball, 0.3, 0.1, 1e-10).tangential_restitution;
    const double fine =
        test::collide_freely(contact, ball, ball, 0.3, 0.1, 1e-13).tangential_restitution;
    EXPECT_NEAR(coarse, fine, 1e-7);
  }
}

TEST(PairMap, EndlessContactIsSaidToBe) {
  // Three times critical damping: ξ falls exponentially and never reaches 0.
  const SoftContact contact{LinearForce{1e6, 6 * std::sqrt(1e6 * 0.01)}, ContactEnd::zero_overlap,
                            NoTangentialForce{}};
  const Sphere ball{0.01, 0.02, 0.4};
  const PairCollision c = test::collide_freely(contact, ball, ball, 0.1, 0.1);
  EXPECT_TRUE(std::isinf(c.duration));
  EXPECT_EQ(c.normal_restitution, 0);
}

}  // namespace
}  // namespace slipcheck
