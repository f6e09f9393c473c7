#include "reference/pair/pair_batch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <string>
#include <vector>

#include "../support/instruction_set.h"
#include "../support/refusal.h"
#include "free_collision.h"
#include "physics/contact/elastic_pair.h"
#include "physics/contact/linear_contact.h"
#include "scene/scaled_impact.h"

namespace slipcheck {
namespace {

using test::collide_freely;

using Form = AsperityForce::Form;

/// Unlike spheres, so that no factor of equal masses goes unseen.
const Sphere kFirst{0.01, 0.02, 0.4}, kSecond{0.015, 0.05, 2.0 / 3};
const double kMass = effective_mass(kFirst, kSecond);
const double kKappa = tangential_mass_ratio(kFirst, kSecond);
constexpr double kModulus = 6e8;    // ρ [N/m^1.5]
constexpr double kStiffness = 1e7;  // [N/m]

/// Speeds of collisions, each normal with each tangential one.
struct Speeds {
  std::vector<double> normal, tangential;

  Speeds(const std::vector<double>& g_n, const std::vector<double>& g_t) {
    for (double n : g_n)
      for (double t : g_t) normal.push_back(n), tangential.push_back(t);
  }
  std::vector<PairCollision> collide(const SoftContact& contact, int steps) const {
    std::vector<PairCollision> out(normal.size());
    collide_batch(contact, kFirst, kSecond, normal, tangential, steps, out);
    return out;
  }
};

struct Case {
  std::string name;
  SoftContact contact;
};

/// All normal with all tangential laws and both ends. Durations are of the order of 1e-4 s,
/// overlaps of 1e-5 m.
std::vector<Case> all_laws() {
  const std::pair<const char*, NormalForce> normals[] = {
      {"linear", LinearForce{kStiffness, 0.2 * std::sqrt(kStiffness * kMass)}},
      {"Hertz", HertzForce{kModulus}},
      {"viscoelastic", ViscoelasticForce{kModulus, 3e-6}},
      {"compact", CompactViscoelasticForce{kModulus, 3e-6}}};
  const std::pair<const char*, TangentialForce> tangentials[] = {
      {"none", NoTangentialForce{}},
      {"viscous", ViscousForce{40, 0.2}},
      {"printed", AsperityForce{0.1, 3e-6, Form::printed}},
      {"passive", AsperityForce{0.1, 3e-6, Form::passive}}};
  std::vector<Case> cases;
  for (const auto& [normal_name, normal] : normals)
    for (const auto& [tangential_name, tangential] : tangentials)
      for (const ContactEnd end : {ContactEnd::zero_overlap, ContactEnd::zero_force})
        cases.push_back({std::string(normal_name) + ", " + tangential_name +
                             (end == ContactEnd::zero_force ? ", zero force" : ", zero overlap"),
                         {normal, end, tangential}});
  return cases;
}

bool same_bits(const std::vector<PairCollision>& a, const std::vector<PairCollision>& b) {
  return a.size() == b.size() &&
         std::memcmp(a.data(), b.data(), a.size() * sizeof(PairCollision)) == 0;
}

TEST(PairBatch, LinearContactMeetsItsClosedFormToSecondOrder) {
  for (const ContactEnd end : {ContactEnd::zero_overlap, ContactEnd::zero_force}) {
    const LinearContact exact = LinearContact::with_collision_time(kMass, 0.7, 1e-4, end);
    const SoftContact contact{LinearForce{exact.stiffness(), exact.damping_rate() * kMass}, end,
                              NoTangentialForce{}};
    const Speeds one({0.3}, {0.2});
    double restitution[2], duration[2];
    for (int k = 0; k < 2; ++k) {
      const PairCollision c = one.collide(contact, 200 << k)[0];
      restitution[k] = std::abs(c.normal_restitution - 0.7);
      duration[k] = std::abs(c.duration / 1e-4 - 1);
      EXPECT_EQ(c.tangential_restitution, 1);
      const double e = c.normal_restitution;
      EXPECT_NEAR(c.energy_change, 0.5 * kMass * 0.09 * (e * e - 1), 1e-15 * kMass);
    }
    // (π/200)²/24 = 1e-5, the phase error of a leap-frog step; e feels it by the damping alone.
    EXPECT_LT(duration[0], 2e-5);
    EXPECT_LT(restitution[0], 1e-5);
    // A quarter at half the step, but for the place of the last step's ends, O(h).
    EXPECT_NEAR(duration[0] / duration[1], 4, 0.1);
    EXPECT_NEAR(restitution[0] / restitution[1], 4, 0.1);
  }
}

TEST(PairBatch, BA13HertzDuration) {
  const Speeds speeds({0.01, 0.1, 1}, {1});
  const std::vector<PairCollision> c =
      speeds.collide({HertzForce{kModulus}, ContactEnd::zero_overlap, NoTangentialForce{}}, 400);
  for (std::size_t k = 0; k < c.size(); ++k) {
    // (3.2/400)²/24 times what the force's growing stiffness makes of it.
    EXPECT_NEAR(c[k].duration / hertz_duration(kMass, kModulus, speeds.normal[k]), 1, 1e-5);
    EXPECT_NEAR(c[k].normal_restitution, 1, 1e-7);
  }
}

TEST(PairBatch, TendsToCvodeToSecondOrderForAllLaws) {
  // From spheres that slide to asperities that do not break. g^T is of the order of g^N for laws
  // with a cap: what lasts for less than a step is not seen to the order.
  const Speeds speeds({0.03, 0.1, 0.4}, {0.05, 0.2, 0.7});
  for (const Case& test : all_laws()) {
    std::vector<PairCollision> exact;
    for (std::size_t k = 0; k < speeds.normal.size(); ++k)
      exact.push_back(collide_freely(test.contact, kFirst, kSecond, speeds.normal[k],
                                     speeds.tangential[k], 1e-11));
    struct Error {
      double normal = 0, tangential = 0, duration = 0;
    };
    const auto error = [&](int steps) {
      // Errors by breaks lie anywhere within a step: the mean over neighbouring steps is smooth.
      Error sum;
      int count = 0;
      for (int n = steps; n < steps * 1.1; n += steps / 20) {
        const std::vector<PairCollision> c = speeds.collide(test.contact, n);
        for (std::size_t k = 0; k < c.size(); ++k) {
          const auto difference = [&](double PairCollision::*part) {
            return std::abs(c[k].*part - exact[k].*part);
          };
          sum.normal += difference(&PairCollision::normal_restitution);
          sum.tangential += difference(&PairCollision::tangential_restitution);
          sum.duration += difference(&PairCollision::duration) / exact[k].duration;
          ++count;
        }
      }
      return Error{sum.normal / count, sum.tangential / count, sum.duration / count};
    };
    const Error coarse = error(100), fine = error(400);
    // Times 16 for the order 2; 10 allows for order 1.66, as the kinks are met or missed. CVODE's
    // own errors are 1e-9.
    EXPECT_LT(fine.normal, 1e-8 + coarse.normal / 10) << test.name;
    EXPECT_LT(fine.tangential, 1e-8 + coarse.tangential / 10) << test.name;
    EXPECT_LT(fine.duration, 1e-8 + coarse.duration / 10) << test.name;
    EXPECT_LT(coarse.normal, 3e-5) << test.name;
    EXPECT_LT(coarse.tangential, 1e-3) << test.name;
    EXPECT_LT(coarse.duration, 1e-4) << test.name;
  }
}

TEST(PairBatch, StrongDampingTendsToTheScaledImpact) {
  for (const NormalForce& law :
       {NormalForce(LinearForce{kStiffness, 0}), NormalForce(ViscoelasticForce{kModulus, 0}),
        NormalForce(CompactViscoelasticForce{kModulus, 0})})
    for (const double D : {0.5, 1.5, 4.0})
      for (const ContactEnd end : {ContactEnd::zero_overlap, ContactEnd::zero_force}) {
        if (std::holds_alternative<LinearForce>(law) && D > 2 && end == ContactEnd::zero_overlap)
          continue;  // these stay
        const SoftContact contact{with_dissipation(law, kMass, 0.3, D), end, NoTangentialForce{}};
        const ImpactScales scales = impact_scales(contact.normal, kMass, 0.3);
        const Impact exact = scaled_impact(scales.law, D, end, 1e-12);
        const Speeds one({0.3}, {0.2});
        const auto error = [&](int steps) {
          return std::abs(one.collide(contact, steps)[0].normal_restitution - exact.restitution);
        };
        // How fast the damping acts, in 1/T, times the step of 3.2 T/400: second order in that.
        const bool compact = std::holds_alternative<CompactViscoelasticForce>(law);
        const double rate = std::max(1.0, compact ? 1.5 * D * std::sqrt(D) : D);
        const double coarse = error(400);
        EXPECT_LT(coarse, 0.2 * std::pow(rate * 3.2 / 400, 2)) << D << ", law " << law.index();
        // Times 64; 1e-9: where errors of unlike sign meet.
        EXPECT_LT(error(3200), 1e-9 + coarse / 30) << D << ", law " << law.index();
      }
}

TEST(PairBatch, L5SlidingLimitIsExact) {
  // |F_T| = ν |F_N| all along, and the impulse of F_N is m_eff (1 + ε^N) g_N, whatever the step.
  for (const NormalForce& normal :
       {NormalForce(HertzForce{kModulus}), NormalForce(ViscoelasticForce{kModulus, 3e-6})}) {
    const Speeds speeds({0.1, 0.2}, {0.5, 0.7});
    const std::vector<PairCollision> c =
        speeds.collide({normal, ContactEnd::zero_force, ViscousForce{1e7, 0.1}}, 50);
    for (std::size_t k = 0; k < c.size(); ++k) {
      const double lost =
          0.1 * (1 + c[k].normal_restitution) * speeds.normal[k] / (kKappa * speeds.tangential[k]);
      // Rounding of 50 steps.
      EXPECT_NEAR(c[k].tangential_restitution, 1 - lost, 1e-13);
    }
  }
}

TEST(PairBatch, B39ViscousForceBelowTheCapDecaysExponentially) {
  const LinearContact exact =
      LinearContact::with_collision_time(kMass, 0.8, 1e-4, ContactEnd::zero_overlap);
  const SoftContact contact{LinearForce{exact.stiffness(), exact.damping_rate() * kMass},
                            ContactEnd::zero_overlap, ViscousForce{30, 1e9}};
  const PairCollision c = Speeds({0.3}, {0.2}).collide(contact, 200)[0];
  // The decay is exact, the duration is not.
  EXPECT_NEAR(c.tangential_restitution, std::exp(-30 / (kKappa * kMass) * c.duration), 1e-9);
  EXPECT_LT(c.tangential_restitution, 0.9);
}

TEST(PairBatch, StrongViscousForceStopsTheSlip) {
  // Thousands of times faster than a step.
  const SoftContact contact{HertzForce{kModulus}, ContactEnd::zero_overlap, ViscousForce{1e8, 0.5}};
  const PairCollision c = Speeds({0.5}, {0.1}).collide(contact, 100)[0];
  EXPECT_GE(c.tangential_restitution, 0);
  EXPECT_LT(c.tangential_restitution, 1e-6);
}

TEST(PairBatch, PassiveAsperityThatDoesNotBreakIsASpringWhileTheForceFalls) {
  // The closed form of pair_map_test.cpp for the undamped linear contact and small μ/ζ0.
  const double g_n = 0.1, g_t = 0.02, omega = std::sqrt(kStiffness / kMass);
  const double size = 1e-4, friction = 1e-6;
  const SoftContact contact{LinearForce{kStiffness, 0}, ContactEnd::zero_overlap,
                            AsperityForce{friction, size, Form::passive}};
  const double lost = friction / size * (kStiffness * g_n / omega) / (omega * omega) * (M_PI - 1) /
                      (kKappa * kMass);
  ASSERT_LT(g_t * M_PI / omega, size);
  const auto error = [&](int steps) {
    const PairCollision c = Speeds({g_n}, {g_t}).collide(contact, steps)[0];
    return std::abs((1 - c.tangential_restitution) / lost - 1);
  };
  // Second order in π/200; rounding of 1e-16 over lost ~ 1e-7 is far below.
  EXPECT_LT(error(200), 1e-3);
  EXPECT_LT(error(800), error(200) / 12);
}

TEST(PairBatch, ManyBreaksInAStepSlideByHalfTheFriction) {
  // Twenty asperities break in each step: on average half of μ F_N acts.
  const double g_n = 0.01, g_t = 5;
  for (const Form form : {Form::printed, Form::passive}) {
    const SoftContact contact{HertzForce{kModulus}, ContactEnd::zero_overlap,
                              AsperityForce{0.1, 5e-7, form}};
    const double step = hertz_duration(kMass, kModulus, g_n) / 100;
    ASSERT_GT(g_t * step, 20 * 5e-7);
    const PairCollision c = Speeds({g_n}, {g_t}).collide(contact, 100)[0];
    const double lost = 0.5 * 0.1 * (1 + c.normal_restitution) * g_n / (kKappa * g_t);
    // One in 2000 asperities, the last one, is half bent.
    EXPECT_NEAR((1 - c.tangential_restitution) / lost, 1, 1e-2);
  }
}

TEST(PairBatch, PassiveFormCreatesNoEnergyBeyondItsDoubt) {
  const Speeds speeds({1e-3, 1e-2, 0.1, 1}, {1e-3, 1e-2, 0.1, 1});
  for (const double size : {1e-8, 1e-7, 1e-6, 1e-5}) {
    const SoftContact contact{HertzForce{kModulus}, ContactEnd::zero_overlap,
                              AsperityForce{0.3, size, Form::passive}};
    const std::vector<PairCollision> c = speeds.collide(contact, 2000);
    for (std::size_t k = 0; k < c.size(); ++k) {
      const double g_n = speeds.normal[k], g_t = speeds.tangential[k];
      // The undamped normal motion returns its energy to (3.2/2000)^3.
      EXPECT_LT(c[k].energy_change, 1e-8 * kMass * (g_n * g_n + kKappa * g_t * g_t))
          << size << ", " << g_n << ", " << g_t;
    }
  }
}

TEST(PairBatch, AllInstructionSetsGiveTheSameBits) {
  // 99 collisions of unlike length, which no number of lanes divides.
  std::vector<double> g_n, g_t;
  for (int k = 0; k < 11; ++k) g_n.push_back(0.01 * std::pow(1.5, k));
  for (int k = 0; k < 9; ++k) g_t.push_back(0.01 * std::pow(1.7, k));
  const Speeds speeds(g_n, g_t);
  std::set<std::string> targets;
  for (const Case& each : all_laws()) {
    const std::vector<PairCollision> best = speeds.collide(each.contact, 64);
    for (const std::int64_t target : test::InstructionSet::all()) {
      const test::InstructionSet set(target);
      targets.insert(batch_target());
      EXPECT_TRUE(same_bits(speeds.collide(each.contact, 64), best))
          << each.name << ", " << batch_target();
    }
  }
#ifdef SLIPCHECK_SANITIZE
  GTEST_SKIP() << "a sanitized build has one instruction set";
#endif
  // The fallback without vectors and at least one with them.
  EXPECT_GE(targets.size(), 2u);
}

TEST(PairBatch, ACollisionDependsOnNoOther) {
  // More than are prepared at once, in another order, and each alone.
  std::vector<double> g_n, g_t;
  for (int k = 0; k < 50; ++k) g_n.push_back(0.01 * std::pow(1.09, k));
  for (int k = 0; k < 50; ++k) g_t.push_back(0.02 * std::pow(1.07, k));
  const Speeds speeds(g_n, g_t);
  const SoftContact contact{ViscoelasticForce{kModulus, 3e-6}, ContactEnd::zero_overlap,
                            AsperityForce{0.1, 3e-6, Form::passive}};
  const std::vector<PairCollision> all = speeds.collide(contact, 32);
  Speeds backwards = speeds;
  std::reverse(backwards.normal.begin(), backwards.normal.end());
  std::reverse(backwards.tangential.begin(), backwards.tangential.end());
  std::vector<PairCollision> reversed = backwards.collide(contact, 32);
  std::reverse(reversed.begin(), reversed.end());
  EXPECT_TRUE(same_bits(all, reversed));
  for (std::size_t k = 0; k < all.size(); k += 97)
    EXPECT_TRUE(same_bits({all[k]},
                          Speeds({speeds.normal[k]}, {speeds.tangential[k]}).collide(contact, 32)));
  EXPECT_TRUE(Speeds({}, {}).collide(contact, 32).empty());
}

TEST(PairBatch, DoubtIsAboutThreeTimesTheError) {
  const Speeds speeds({0.03, 0.1, 0.4}, {0.05, 0.2, 0.7});
  const SoftContact contact{LinearForce{kStiffness, 0.2 * std::sqrt(kStiffness * kMass)},
                            ContactEnd::zero_overlap, AsperityForce{0.1, 3e-5, Form::printed}};
  std::vector<PairCollision> c(speeds.normal.size());
  std::vector<PairDoubt> doubt(c.size());
  collide_batch(contact, kFirst, kSecond, speeds.normal, speeds.tangential, 200, c, doubt);
  EXPECT_TRUE(same_bits(c, speeds.collide(contact, 200)));
  for (std::size_t k = 0; k < c.size(); ++k) {
    const PairCollision exact =
        collide_freely(contact, kFirst, kSecond, speeds.normal[k], speeds.tangential[k], 1e-12);
    const auto within = [&](double d, double error) {
      EXPECT_LT(std::abs(error), d) << k;
      EXPECT_GT(std::abs(error), 0.1 * d) << k;
    };
    within(doubt[k].normal_restitution, c[k].normal_restitution - exact.normal_restitution);
    within(doubt[k].duration, c[k].duration - exact.duration);
    EXPECT_LT(std::abs(c[k].tangential_restitution - exact.tangential_restitution),
              doubt[k].tangential_restitution);
  }
}

TEST(PairBatch, EndlessContactsAreSaidToBe) {
  // Three times critical damping: ξ falls exponentially and never reaches 0. By force it ends.
  const double damping = 6 * std::sqrt(kStiffness * kMass);
  SoftContact contact{LinearForce{kStiffness, damping}, ContactEnd::zero_overlap,
                      ViscousForce{40, 0.2}};
  const Speeds speeds({0.1, 0.2, 0.4}, {0.1, 0.2, 0.3});
  for (const PairCollision& c : speeds.collide(contact, 50)) {
    EXPECT_TRUE(std::isinf(c.duration));
    EXPECT_EQ(c.normal_restitution, 0);
    EXPECT_GE(c.tangential_restitution, 0);
    EXPECT_LT(c.tangential_restitution, 1);
  }
  contact.end = ContactEnd::zero_force;
  for (const PairCollision& c : speeds.collide(contact, 50)) {
    EXPECT_TRUE(std::isfinite(c.duration));
    EXPECT_GT(c.normal_restitution, 0);
  }
}

/// What collide_batch() throws for one collision.
template <class Exception>
std::string refusal(const SoftContact& contact, int steps) {
  return test::refusal_of<Exception>([&] { Speeds({0.3}, {0.2}).collide(contact, steps); });
}

TEST(PairBatch, RefusesWhatItCannotDo) {
  const SoftContact hertz{HertzForce{kModulus}, ContactEnd::zero_overlap, NoTangentialForce{}};
  SoftContact power = hertz, strong = hertz;
  power.normal = PowerForce{kModulus, 1, 1.5, 0.5};
  EXPECT_FALSE(can_batch(power));
  EXPECT_TRUE(can_batch(hertz));
  EXPECT_EQ(refusal<std::invalid_argument>(power, 100), "a batch has no power law");
  EXPECT_EQ(refusal<std::invalid_argument>(hertz, 7), "steps must be at least 8, got 7");
  // D h = 1 is the limit; the undamped spring takes π.
  strong.normal = with_dissipation(LinearForce{kStiffness, 0}, kMass, 0.3, 100);
  EXPECT_EQ(refusal<std::domain_error>(strong, 100),
            "a collision at 0.3 m/s is damped so strongly that it needs 315 steps, got 100");
  EXPECT_EQ(refusal<std::domain_error>(strong, 315), "");

  const std::vector<double> three(3, 0.1), two(2, 0.1);
  std::vector<PairCollision> out(3);
  std::vector<PairDoubt> doubt(3);
  EXPECT_THROW(collide_batch(hertz, kFirst, kSecond, three, two, 100, out), std::invalid_argument);
  EXPECT_THROW(collide_batch(hertz, kFirst, kSecond, two, three, 100, out), std::invalid_argument);
  EXPECT_THROW(collide_batch(hertz, kFirst, kSecond, three, three, 101, out, doubt),
               std::invalid_argument);
  doubt.pop_back();
  EXPECT_THROW(collide_batch(hertz, kFirst, kSecond, three, three, 100, out, doubt),
               std::invalid_argument);
}

}  // namespace
}  // namespace slipcheck
