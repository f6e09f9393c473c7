#include "physics/polynomial_roots.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "physics/numbers.h"
#include "physics/vector.h"

namespace slipcheck {
namespace {

TEST(FirstFallingRoot, StraightApproach) {
  // Gap² of two points that close at speed 2 from distance 5, contact at distance 1: t = 2.
  const Quartic f = {25 - 1, -20, 4, 0, 0};
  EXPECT_DOUBLE_EQ(first_falling_root(f, kNever), 2);
  EXPECT_EQ(first_falling_root(f, 1.9), kNever);
}

TEST(FirstFallingRoot, TouchingPairThatSeparatesDoesNotCollide) {
  EXPECT_EQ(first_falling_root({0, 1, 1, 0, 0}, kNever), kNever);
  EXPECT_EQ(first_falling_root({-1e-18, 1, 1, 0, 0}, kNever), kNever);
}

TEST(FirstFallingRoot, TouchingPairThatApproachesCollidesAtOnce) {
  EXPECT_EQ(first_falling_root({0, -1, 1, 0, 0}, kNever), 0);
  EXPECT_EQ(first_falling_root({-1e-18, -1, 1, 0, 0}, kNever), 0);
}

TEST(FirstFallingRoot, PairThatSeparatesAndComesBack) {
  // f = t (t − 1)(t − 2)(t − 3) = t⁴ − 6t³ + 11t² − 6t, shifted: falls through its roots 0 and 2.
  const Quartic f = {0, -6, 11, -6, 1};
  EXPECT_EQ(first_falling_root(f, kNever), 0);
  // −f falls through 1 and 3; it starts at 0 upwards.
  EXPECT_NEAR(first_falling_root({0, 6, -11, 6, -1}, kNever), 1, 1e-15);
}

TEST(FirstFallingRoot, NothingMoves) {
  EXPECT_EQ(first_falling_root({1, 0, 0, 0, 0}, kNever), kNever);
  EXPECT_EQ(first_falling_root({0, 0, 0, 0, 0}, kNever), kNever);
}

TEST(FirstFallingRoot, DoubleRootIsAGrazeAndMayGoEitherWayButEndsThere) {
  // (t − 1)²: touches zero at 1 only. A graze carries no impulse; what counts is that it is found
  // at 1 or not at all.
  const double t = first_falling_root({1, -2, 1, 0, 0}, kNever);
  EXPECT_TRUE(t == kNever || std::abs(t - 1) < 1e-7) << t;
}

/// Two spheres on parabolas.
struct Pair {
  Vector3 x, v, a;
  double contact;
  double gap2(double t) const {
    const Vector3 d = x + t * (v + 0.5 * t * a);
    return d.squaredNorm() - contact * contact;
  }
  double gap2_rate(double t) const {
    const Vector3 d = x + t * (v + 0.5 * t * a);
    return 2 * d.dot(v + t * a);
  }
  Quartic quartic() const {
    return {x.squaredNorm() - contact * contact, 2 * x.dot(v), v.squaredNorm() + x.dot(a), v.dot(a),
            0.25 * a.squaredNorm()};
  }
};

/// The first root by brute force: dense sampling, then bisection. Finds a contact deeper than what
/// the curve can hide between two samples, |f''| h²/8.
double by_bisection(const Pair& pair, double limit, int samples, double& hidden) {
  const double h = limit / samples;
  const double v = pair.v.norm() + limit * pair.a.norm();
  const double reach = pair.x.norm() + limit * v;
  hidden = (2 * v * v + 2 * reach * pair.a.norm()) * h * h / 8;
  double before = pair.gap2(0);
  for (int k = 1; k <= samples; ++k) {
    const double now = pair.gap2(k * h);
    if (before > 0 && now <= 0) {
      double low = (k - 1) * h, high = k * h;
      for (int i = 0; i < 80; ++i) {
        const double mid = 0.5 * (low + high);
        (pair.gap2(mid) > 0 ? low : high) = mid;
      }
      return high;
    }
    before = now;
  }
  return kNever;
}

TEST(FirstFallingRoot, AMillionRandomPairsAgainstBisection) {
  std::mt19937_64 random(7);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  int hits = 0, misses = 0, hidden_contacts = 0;
  for (int n = 0; n < 1'000'000; ++n) {
    Pair pair;
    pair.contact = uniform(0.5, 1.5);
    const double angle = uniform(0, 2 * M_PI), distance = pair.contact * uniform(1.0001, 4);
    pair.x = distance * Vector3(std::cos(angle), std::sin(angle), 0);
    pair.v = Vector3(uniform(-1, 1), uniform(-1, 1), 0);
    const double strength = std::pow(10.0, uniform(-6, 0.5));
    pair.a = strength * Vector3(uniform(-1, 1), uniform(-1, 1), 0);
    if (n % 7 == 0) pair.a.setZero();
    const double limit = uniform(0.1, 8);
    const double found = first_falling_root(pair.quartic(), limit);

    double hidden;
    const double expected = by_bisection(pair, limit, 64, hidden);
    if (found < kNever) {
      ++hits;
      ASSERT_LE(found, limit);
      // It is a root, up to the rounding of the quartic's terms, and f falls there.
      const double terms = pair.x.squaredNorm() + std::pow(limit * pair.v.norm(), 2) +
                           std::pow(limit * limit * pair.a.norm(), 2);
      ASSERT_NEAR(pair.gap2(found), 0, 1e-13 * terms) << n;
      ASSERT_LE(pair.gap2_rate(found), 1e-6 * terms) << n;
      // Nothing came before it. Times of one root agree as f's rounding over its slope.
      const double slope = std::abs(pair.gap2_rate(found));
      const double same = 1e-9 + 1e-13 * terms / (slope + 1e-9);
      if (expected < found) {
        ASSERT_NEAR(found, expected, same) << n;
      } else if (expected > found + same) {
        ++hidden_contacts;  // a dip between two samples, which only the exact roots see
        const double next_sample = std::ceil(found / (limit / 64)) * (limit / 64);
        for (int k = 0; k <= 64; ++k)
          ASSERT_GE(pair.gap2(found + (next_sample - found) * k / 64), -hidden) << n;
      }
    } else {
      ++misses;
      ASSERT_EQ(expected, kNever) << n << ": missed a collision at " << expected;
    }
  }
  // The sample holds plenty of each kind.
  EXPECT_GT(hits, 100'000);
  EXPECT_GT(misses, 100'000);
  EXPECT_GT(hidden_contacts, 10);
}

TEST(FirstFallingRoot, NeverDoubled) {
  // After the root the gap is closed; from a hair behind it, turned around, the pair separates.
  std::mt19937_64 random(11);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  for (int n = 0; n < 100'000; ++n) {
    Pair pair;
    pair.contact = 1;
    pair.x = Vector3(uniform(1.001, 3), uniform(-1, 1), 0);
    pair.v = Vector3(uniform(-2, 0), uniform(-1, 1), 0);
    pair.a = Vector3(uniform(-0.1, 0.1), uniform(-0.1, 0.1), 0);
    if (pair.x.norm() < 1) continue;
    const double t = first_falling_root(pair.quartic(), 10);
    if (t == kNever) continue;
    Pair after = pair;
    after.x = pair.x + t * (pair.v + 0.5 * t * pair.a);
    after.v = pair.v + t * pair.a;
    const Vector3 normal = after.x.normalized();
    const double approach = after.v.dot(normal);
    if (approach > -1e-3) continue;
    after.v -= 1.9 * approach * normal;
    // It must leave for at least the time in which the acceleration could turn it back.
    const double back = 2 * 0.9 * -approach / (pair.a.norm() + 1e-12);
    ASSERT_GE(first_falling_root(after.quartic(), 0.5 * std::min(back, 1.0)),
              0.49 * std::min(back, 1.0))
        << n;
  }
}

}  // namespace
}  // namespace slipcheck
