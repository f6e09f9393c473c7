#include "physics/contact/pair_insight.h"

#include <gtest/gtest.h>

#include <cmath>

#include "soft_pair.h"

namespace slipcheck {
namespace {

using test::integrated;
using test::SoftPair;
using test::SubstrateFriction;

constexpr double kGravity = 9.81;
constexpr double kRadius = 0.002;
const double kMass = 7850 * 4 * M_PI / 3 * std::pow(kRadius, 3);

/// K's steel: e_n = 0.9 and t_col = 2.55e-5 s by the relation of zero_overlap.
LinearContact steel(ContactEnd end = ContactEnd::zero_overlap) {
  const LinearContact set =
      LinearContact::with_collision_time(kMass / 2, 0.9, 2.55e-5, ContactEnd::zero_overlap);
  return {set.reduced_mass(), set.stiffness(), set.damping_rate(), end};
}

/// γ_S = γ_N/2, ν_s = 0.5, μ_s = 0.5, μ_k = 0.1.
RollingPair rolling_pair(double v_i, double v_j) {
  RollingPair pair;
  const Sphere ball{kRadius, kMass, 0.4};
  pair.spheres = {RollingSphere{ball, v_i, 0.5, 0.1}, RollingSphere{ball, v_j, 0.5, 0.1}};
  pair.gravity = kGravity;
  pair.rubbing_rate = 0.5 * steel().damping_rate();
  pair.rubbing_friction = 0.5;
  pair.confined = true;
  return pair;
}

RollingPair unlike_pair() {
  RollingPair pair = rolling_pair(0.12, -0.03);
  pair.spheres[1].sphere.mass = 3 * kMass;
  pair.spheres[1].sphere.shape_factor = 2.0 / 3;
  pair.spheres[1].static_friction = 0.3;
  return pair;
}
double reduced_mass(const RollingPair& pair) {
  const double a = pair.spheres[0].sphere.mass, b = pair.spheres[1].sphere.mass;
  return a * b / (a + b);
}
LinearContact contact_of(const RollingPair& pair, double damping_ratio) {
  const double m = reduced_mass(pair), k = steel().stiffness();
  return {m, k, damping_ratio * std::sqrt(k / m), ContactEnd::zero_overlap};
}

TEST(PairInsight, K55MeasuredShareWithTheCap) {
  // Physics notes, a rolling ball on one at rest at 10 cm/s: first order 0.132, exponential 0.116,
  // measured with the cap 0.113; K's clamp at the very end.
  const PairInsight insight = pair_insight(steel(ContactEnd::zero_force), rolling_pair(0.1, 0));
  EXPECT_NEAR(insight.rubbing_constant, 0.132, 5e-4);
  EXPECT_NEAR(insight.exponential_share, 0.116, 5e-4);
  EXPECT_NEAR(insight.rubbing.share, 0.113, 5e-4);
}

TEST(PairInsight, K55RubbedShareMatchesTheIntegratedForces) {
  // Switches of the integration fall on steps of 5e-5 radian.
  for (ContactEnd end : {ContactEnd::zero_overlap, ContactEnd::zero_force})
    for (bool confined : {true, false})
      for (double cap : {0.02, 0.1, 0.5, 1e9})
        for (double v_j : {-0.09, -0.05, 0.0, 0.05, -0.15}) {
          RollingPair pair = rolling_pair(0.1, v_j);
          pair.confined = confined;
          pair.rubbing_friction = cap;
          SoftPair soft = integrated(steel(end), pair, SubstrateFriction::off);
          soft.ends_at_zero_force = end == ContactEnd::zero_force;
          const SoftPair::Result expected = soft.collide();
          const PairInsight found = pair_insight(steel(end), pair);
          const double sum = expected.end.w[0] + expected.end.w[1];
          EXPECT_NEAR(found.rubbing.share, 0.5 * (1 - sum / pair.surface_speed()), 2e-5)
              << cap << ' ' << v_j << ' ' << confined;
          EXPECT_NEAR(found.rubbing.impulse / expected.end.rubbed, 1, 2e-4);
        }
}

TEST(PairInsight, K55WithoutTheCapIsTheExponential) {
  RollingPair pair = rolling_pair(0.1, 0);
  pair.rubbing_friction = std::numeric_limits<double>::infinity();
  const LinearContact elastic(kMass / 2, steel().stiffness(), 0, ContactEnd::zero_overlap);
  // C is made for t_col = π/ω0, that of no damping.
  const PairInsight insight = pair_insight(elastic, pair);
  EXPECT_NEAR(insight.rubbing.share, insight.exponential_share, 1e-15);
}

TEST(PairInsight, RubbingOverCriticallyDampedContact) {
  const LinearContact contact(kMass / 2, steel().stiffness(), 3 * steel().contact_frequency(),
                              ContactEnd::zero_force);
  const RollingPair pair = rolling_pair(0.1, 0);
  SoftPair soft = integrated(contact, pair, SubstrateFriction::off);
  soft.ends_at_zero_force = true;
  const SoftPair::Result expected = soft.collide();
  const PairInsight found = pair_insight(contact, pair);
  const double sum = expected.end.w[0] + expected.end.w[1];
  EXPECT_NEAR(found.rubbing.share, 0.5 * (1 - sum / 0.1), 2e-5);
  EXPECT_NEAR(found.collision_time / expected.time, 1, 1e-8);
}

TEST(PairInsight, K33SlidingOnsetWithoutDamping) {
  // t_min = 2.27e-8 s measured at v_rel = 10 cm/s (physics notes): the first step of 1e-10 s.
  const LinearContact elastic =
      LinearContact::with_collision_time(kMass / 2, 1, 2.55e-5, ContactEnd::zero_overlap);
  const RollingPair pair = rolling_pair(0.05, -0.05);
  const SlidingOnset onset = pair_insight(elastic, pair).onset;
  EXPECT_NEAR(onset.time, 2.27e-8, 1e-10);
  const SoftPair soft = integrated(elastic, pair, SubstrateFriction::on);
  const SoftPair::Result expected = soft.collide(1'000'000);
  const double step = 1e-6 / elastic.contact_frequency();
  EXPECT_NEAR(onset.exact_time, expected.slides_from, step);
  // ω0 t_min = 0.0028, whose square is what the first order leaves out.
  EXPECT_NEAR(onset.time / onset.exact_time, 1, 1e-5);
  EXPECT_NEAR(onset.overlap / (0.1 * onset.time), 1, 1e-15);
  EXPECT_NEAR(onset.overlap, 2 * 3.5 * 0.5 * kGravity / std::pow(elastic.contact_frequency(), 2),
              1e-18);
}

TEST(PairInsight, SlidingOnsetWithDampingAndUnlikeSpheres) {
  // v between the sliding speed and v^c, where it begins inside the collision.
  for (double ratio : {0.0, 0.3, 0.7, 0.95}) {
    RollingPair pair = unlike_pair();
    pair.rubbing_rate = 0;
    const LinearContact contact = contact_of(pair, ratio);
    const SlidingOnset any = pair_insight(contact, pair).onset;
    const double v = 0.5 * (any.sliding_speed + std::min(any.v_c, 2 * any.sliding_speed));
    pair.spheres[0].speed = v;
    pair.spheres[1].speed = 0;
    const SlidingOnset onset = pair_insight(contact, pair).onset;
    const SoftPair::Result expected = integrated(contact, pair, SubstrateFriction::on).collide();
    EXPECT_NEAR(onset.exact_time * contact.contact_frequency(),
                expected.slides_from * contact.contact_frequency(), 1e-4)
        << ratio;
  }
}

TEST(PairInsight, SlidingBeginsAtItsSpeedAndAtVc) {
  for (double ratio : {0.0, 0.3, 0.9, 1.4}) {
    RollingPair pair = unlike_pair();
    pair.rubbing_rate = 0;
    const LinearContact contact = contact_of(pair, ratio);
    const auto slides_from = [&](double v) {
      pair.spheres[0].speed = v;
      pair.spheres[1].speed = 0;
      return integrated(contact, pair, SubstrateFriction::on).collide().slides_from;
    };
    const SlidingOnset onset = pair_insight(contact, pair).onset;
    EXPECT_TRUE(std::isinf(slides_from(0.999 * onset.sliding_speed))) << ratio;
    EXPECT_FALSE(std::isinf(slides_from(1.001 * onset.sliding_speed))) << ratio;
    if (ratio > 0) {
      EXPECT_GT(slides_from(0.999 * onset.v_c), 0) << ratio;
      EXPECT_EQ(slides_from(1.001 * onset.v_c), 0) << ratio;
    }
    pair.spheres[0].speed = 0.999 * onset.sliding_speed;
    EXPECT_FALSE(pair_insight(contact, pair).slides);
    pair.spheres[0].speed = 1.001 * onset.sliding_speed;
    EXPECT_TRUE(pair_insight(contact, pair).slides);
  }
}

TEST(PairInsight, VbIsTheSpeedOfEqualSpheresWhoseOverlapReachesXmin) {
  const LinearContact elastic(kMass / 2, steel().stiffness(), 0, ContactEnd::zero_overlap);
  const PairInsight insight = pair_insight(elastic, rolling_pair(0.05, -0.05));
  EXPECT_NEAR(insight.onset.v_b, 2 * 3.5 * 0.5 * kGravity / elastic.contact_frequency(), 1e-18);
  EXPECT_NEAR(elastic.largest_overlap(insight.onset.v_b) / insight.onset.overlap, 1, 1e-14);
  // Spheres that roll carry 1.4 times their mass: they slide from √(A/(1 + A)) v^b on.
  EXPECT_NEAR(insight.onset.sliding_speed / insight.onset.v_b, std::sqrt(2.5 / 3.5), 1e-14);
}

TEST(PairInsight, AfterCollisionMatchesCollisionAndSlideInTime) {
  for (const RollingPair& pair :
       {rolling_pair(0.1, 0), rolling_pair(0.1, -0.1), rolling_pair(0.15, 0.05),
        rolling_pair(0.02, -0.1), unlike_pair()}) {
    const LinearContact contact = contact_of(pair, 0.067);
    const PairInsight found = pair_insight(contact, pair);
    SoftPair soft = integrated(contact, pair, SubstrateFriction::off);
    const SoftPair::State end = soft.collide().end;
    double parting = 0;
    for (std::size_t i : {0u, 1u}) {
      soft.mu_k[i] = pair.spheres[i].kinetic_friction;
      const SoftPair::Slid slid = soft.slide(end, i);
      const AfterCollision& after = found.after[i];
      // One step of the contact, 5e-5 radian, changes a speed by some 1e-6 of v_rel.
      const double dv = 2e-6 * pair.closing_speed(), slide = after.sliding_time;
      EXPECT_NEAR(after.velocity, end.v[i], dv);
      EXPECT_NEAR(after.surface_velocity, end.w[i], dv);
      EXPECT_NEAR(after.slip, end.v[i] - end.w[i], 2 * dv);
      EXPECT_NEAR(after.sliding_time, slid.time, 2e-5 * slide);
      EXPECT_NEAR(after.rolling_velocity, slid.velocity, 2 * dv);
      EXPECT_NEAR(after.sliding_distance, slid.displacement, 4 * dv * slide);
      EXPECT_NEAR(after.energy_change, end.v[i] * end.v[i] - slid.velocity * slid.velocity, dv);
      EXPECT_NEAR(after.momentum_change, end.v[i] - slid.velocity, 2 * dv);
      parting += i == 0 ? -slid.velocity : slid.velocity;
    }
    EXPECT_NEAR(found.effective_restitution, parting / pair.closing_speed(), 1e-5);
  }
}

TEST(PairInsight, LeavesOutOnlyWhatTheSubstrateDoesInTheCollision) {
  // μ_k g t_col (1 + A) of both and (1 + A) μ_k ∫F_R dt/m of the sphere pressed down.
  const RollingPair pair = rolling_pair(0.1, 0);
  const PairInsight found = pair_insight(steel(), pair);
  const SoftPair::State end = integrated(steel(), pair, SubstrateFriction::on).collide().end;
  const double pressed = 0.1 * found.rubbing.impulse / kMass;
  const double bound = 3.5 * (0.1 * kGravity * found.collision_time + pressed);
  EXPECT_LT(bound, 0.018 * 0.1);
  std::array<double, 2> rolling;
  for (std::size_t i : {0u, 1u}) {
    EXPECT_NEAR(found.after[i].slip, end.v[i] - end.w[i], 1.01 * bound);
    rolling[i] = (2.5 * end.v[i] + end.w[i]) / 3.5;  // whatever the friction at the lowest point
  }
  // That friction slows the pressed sphere and the normal force makes up for it, so that the pair
  // parts with e_n all the same: A μ_k ∫F_R dt/((1 + A) m v_rel) more, to the order of C.
  const double more = (rolling[1] - rolling[0]) / 0.1 - found.effective_restitution;
  EXPECT_NEAR(more / (2.5 / 3.5 * pressed / 0.1), 1, 0.15);
}

TEST(PairInsight, AppFJump) {
  // v^z of about 0.5 cm/s at v_rel = 10 cm/s and t^z = 2 v^z/g of about 1e-3 s.
  for (double v_j : {0.0, -0.05, 0.05}) {
    RollingPair pair = rolling_pair(0.1, v_j);
    pair.confined = false;
    const auto rise = [&](SubstrateFriction friction) {
      return integrated(steel(), pair, friction).collide().end.rise;
    };
    const Jump found = pair_insight(steel(), pair).jump;
    EXPECT_EQ(found.sphere, 0);
    EXPECT_NEAR(found.speed, rise(SubstrateFriction::off), 2e-5 * found.speed);
    // The friction on the sphere pressed down turns it meanwhile: (1 + A) μ_k C of its slip.
    EXPECT_NEAR(found.speed, rise(SubstrateFriction::on), 1e-2 * found.speed);
    EXPECT_NEAR(found.height, found.speed * found.speed / (2 * kGravity), 1e-18);
    EXPECT_NEAR(found.time, 2 * found.speed / kGravity, 1e-18);
  }
  RollingPair pair = rolling_pair(-0.05, -0.1);  // caught up with from behind by the faster one
  pair.confined = false;
  EXPECT_EQ(pair_insight(steel(), pair).jump.sphere, 1);
  pair.confined = true;
  EXPECT_EQ(pair_insight(steel(), pair).jump.speed, 0);
}

TEST(PairInsight, AppFNoJumpBelowVd) {
  // v^d = 2 g/γ_S at equal speeds but for v_d; damping lets F_N begin high enough.
  RollingPair pair = rolling_pair(0.1, 0);
  pair.confined = false;
  const double v_d = pair_insight(steel(), pair).jump.v_d;
  EXPECT_NEAR(v_d, 2 * kGravity / pair.rubbing_rate, 1e-15);
  for (double factor : {0.99, 1.01}) {
    pair.spheres[0].speed = 0.05 + 0.5 * factor * v_d;
    pair.spheres[1].speed = -0.05 + 0.5 * factor * v_d;
    const bool lifts =
        !std::isinf(integrated(steel(), pair, SubstrateFriction::off).collide().lifts_from);
    EXPECT_EQ(lifts, factor > 1);
    EXPECT_EQ(!std::isinf(pair_insight(steel(), pair).rubbing.lift_off_time), factor > 1);
  }
  pair.rubbing_friction = 1e-3;  // ν_s F_N stays below the weight
  pair.spheres[0].speed = 0.01;
  pair.spheres[1].speed = 0;
  EXPECT_TRUE(std::isinf(pair_insight(steel(), pair).jump.v_d));
  EXPECT_TRUE(std::isinf(integrated(steel(), pair, SubstrateFriction::off).collide().lifts_from));
}

TEST(PairInsight, D1D4SubstratesFrictionLengthensAndDeepensTheCollision) {
  // t_col longer by 1.01e-4 at v_rel = 10 cm/s (physics notes, measured).
  RollingPair pair = rolling_pair(0.05, -0.05);
  const LinearContact elastic =
      LinearContact::with_collision_time(kMass / 2, 1, 2.55e-5, ContactEnd::zero_overlap);
  const PairInsight found = pair_insight(elastic, pair);
  EXPECT_NEAR(found.collision_time_change, 1.01e-4, 5e-7);
  EXPECT_NEAR(found.largest_overlap_change, 2 * 0.1 * kGravity / (0.1 * found.contact_frequency),
              1e-18);
  // Integrated, sliding as soon as F_N can keep it sliding, after 2e-4 of t_col: so much of the
  // change is missing.
  for (RollingSphere& s : pair.spheres) s.static_friction = 0;
  const SoftPair::Result with = integrated(elastic, pair, SubstrateFriction::on).collide();
  EXPECT_NEAR(with.time / found.collision_time - 1, found.collision_time_change, 5e-8);
  EXPECT_NEAR(with.deepest / found.largest_overlap - 1, found.largest_overlap_change, 5e-8);
}

}  // namespace
}  // namespace slipcheck
