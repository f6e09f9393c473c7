#include "reference/forces/floor_flight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "physics/numbers.h"

namespace slipcheck {
namespace {

constexpr double kGravity = 9.81;

TEST(FloorContact, OnAStillFloorIsTheEndOfTheParabola) {
  const ShakenFloor still;
  EXPECT_DOUBLE_EQ(floor_contact(still, 3, 0.5, 0, kGravity, 10), std::sqrt(2 * 0.5 / kGravity));
  EXPECT_DOUBLE_EQ(floor_contact(still, 3, 0, 2, kGravity, 10), 2 * 2 / kGravity);
  EXPECT_EQ(floor_contact(still, 3, 0.5, 0, kGravity, 0.3), kNever);
  EXPECT_EQ(floor_contact(still, 3, 0.5, 1, 0, 1e9), kNever);
  EXPECT_DOUBLE_EQ(floor_contact(still, 3, 0.5, -1, 0, 1e9), 0.5);
}

/// The height of the lowest point over the floor.
double gap(const ShakenFloor& floor, double start, double y, double v, double t) {
  return y + (v - 0.5 * kGravity * t) * t - floor.height(start + t);
}

/// Of many flights over a floor that moves, slow or fast, none ends late, early or in the past: up
/// to the time found the gap is never negative, seen at a hundred times a period, and there it is
/// zero and falls.
TEST(FloorContact, IsTheFirstZeroOfTheGap) {
  std::mt19937_64 random(11);
  const auto uniform = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  for (int k = 0; k < 2000; ++k) {
    const double f = std::pow(10, uniform(0, 3)), V = std::pow(10, uniform(-2, 1));
    const ShakenFloor floor{V / (2 * std::numbers::pi * f), f};
    const double start = uniform(0, 10);
    const bool bounces = k % 2 == 0;  // starts on the floor, faster than it
    const double v =
        bounces ? floor.velocity(start) + std::pow(10, uniform(-6, 1)) * V : uniform(-2, 2) * V;
    const double y = bounces ? floor.height(start) : floor.amplitude + uniform(0, 1) * V * V;
    const double t = floor_contact(floor, start, y, v, kGravity, kNever);
    ASSERT_GE(t, 0);
    ASSERT_LT(t, kNever);
    // Rounding of the phase and the heights.
    const double scale = std::abs(y) +
                         floor.amplitude * (1 + 2 * std::numbers::pi * f * (start + t)) +
                         std::abs(v) * t + kGravity * t * t;
    const double rounding = 16 * std::numeric_limits<double>::epsilon() * scale;
    EXPECT_NEAR(gap(floor, start, y, v, t), 0, rounding) << k;
    EXPECT_LE(v - kGravity * t - floor.velocity(start + t), 0) << k;
    const double looks = std::min(200 * (1 + f * t), 20'000.0);
    for (double s = 0; s < t; s += t / looks)
      ASSERT_GE(gap(floor, start, y, v, s), -rounding) << k << " at " << s << " of " << t;
  }
}

/// A floor that is thrown down faster than gravity leaves the body: the contact comes when the
/// parabola meets it again. Closed form: a body that leaves at the floor's top with its velocity 0
/// at phase π/2 of a floor with A ω² = g cannot leave at all.
TEST(FloorContact, OfABodyThatRidesTheFloorComesAtOnce) {
  const double f = 10, omega = 2 * std::numbers::pi * f;
  const ShakenFloor floor{0.5 * kGravity / (omega * omega), f};  // Γ = ½: it never leaves
  const double start = 0.25 / f;
  const double t =
      floor_contact(floor, start, floor.height(start), floor.velocity(start) - 1e-9, kGravity, 1);
  EXPECT_LT(t, 1e-9);
}

TEST(LidContact, IsTheMirrorImageOfAFloor) {
  const ShakenFloor lid{1e-3, 20};
  // Without gravity a lid seen upside down is a floor that moves the other way, half a period
  // later.
  for (const double v : {0.05, 0.5, 3.0}) {
    const double t = lid_contact(lid, 0.3, 0.02, v, 0, kNever);
    const double mirrored = floor_contact(lid, 0.3 + 0.5 / 20, 0.02, -v, 0, kNever);
    EXPECT_NEAR(t, mirrored, 1e-13) << v;  // rounding of the phase, 2π·20·0.3·2e-16/ω
  }
  // A still lid under gravity: the rising branch of the parabola, gap = v t − ½ g t².
  const double t = lid_contact({}, 0, 0.1, 2, kGravity, kNever);
  EXPECT_NEAR(t, (2 - std::sqrt(4 - 2 * kGravity * 0.1)) / kGravity, 1e-15);
  EXPECT_EQ(lid_contact({}, 0, 0.3, 2, kGravity, 10), kNever);
}

}  // namespace
}  // namespace slipcheck
