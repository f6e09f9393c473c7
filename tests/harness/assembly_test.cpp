#include "harness/observe/assembly.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "harness/observe/assembly_observer.h"

namespace slipcheck {
namespace {

constexpr double kRadius = 0.5, kStiffness = 1000, kDamping = 3, kMass = 2;

/// Spheres at rest, linear springs between them.
ContactScene spheres_at(const std::vector<Vector3>& places, const Vector2& periodic,
                        bool on_substrate) {
  ContactScene scene;
  Scene& hard = scene.hard;
  for (const Vector3& place : places) {
    hard.bodies.push_back({kRadius, kMass, 0.4});
    hard.material.push_back(0);
    hard.initial.push_back({place, Vector3::Zero(), Vector3::Zero()});
  }
  hard.gravity = 9.81;
  hard.substrate.resize(1);
  hard.pairs = {{0.5, 0.4, -1.0}};
  hard.has_substrate = on_substrate;
  hard.periodic = periodic;
  scene.soft = {SoftContact{LinearForce{kStiffness, kDamping}, ContactEnd::zero_force, {}}};
  return scene;
}

AssemblyState state_of(const ContactScene& scene) {
  return assembly_state(scene, scene.hard.initial);
}

/// F = k ξ along the line of centres, l = 2R − ξ, in the box around both.
TEST(Assembly, HasTheVirialOfTwoCompressedSpheres) {
  constexpr double kOverlap = 0.01, kApart = 2 * kRadius - kOverlap;
  const ContactScene scene = spheres_at({{0, 0, 3}, {kApart, 0, 3}}, Vector2::Zero(), false);
  const AssemblyState state = state_of(scene);
  EXPECT_EQ(state.contacts, 1u);
  EXPECT_DOUBLE_EQ(state.coordination, 1);
  EXPECT_DOUBLE_EQ(state.coordination_of_carried, 0);  // one contact holds nothing
  const double volume = (2 * kRadius + kApart) * 4 * kRadius * kRadius;
  EXPECT_NEAR(state.stress(0, 0), kStiffness * kOverlap * kApart / volume, 1e-12);
  EXPECT_NEAR(state.pressure(), state.stress(0, 0) / 3, 1e-12);
  EXPECT_EQ(state.stress(1, 1), 0);
  EXPECT_NEAR(state.elastic_energy, 0.5 * kStiffness * kOverlap * kOverlap, 1e-14);
  EXPECT_DOUBLE_EQ(state.height, 3);
  EXPECT_DOUBLE_EQ(state.weight_energy, 2 * kMass * 9.81 * 3);
}

/// The dashpot adds c times the closing speed, and motion m δv² along x; a dashpot never pulls.
TEST(Assembly, CountsDashpotsAndMotion) {
  constexpr double kOverlap = 0.01, kApart = 2 * kRadius - kOverlap, kSpeed = 0.7;
  ContactScene scene = spheres_at({{0, 0, 3}, {kApart, 0, 3}}, Vector2::Zero(), false);
  scene.hard.initial[0].velocity = {5 + kSpeed, 0, 0};
  scene.hard.initial[1].velocity = {5 - kSpeed, 0, 0};
  scene.hard.initial[0].angular_velocity = {0, 2, 0};
  const double volume = (2 * kRadius + kApart) * 4 * kRadius * kRadius;
  const double closing = kStiffness * kOverlap + kDamping * 2 * kSpeed;
  const double motion = 2 * kMass * kSpeed * kSpeed;
  AssemblyState state = state_of(scene);
  EXPECT_NEAR(state.stress(0, 0), (closing * kApart + motion) / volume, 1e-12);
  EXPECT_NEAR(state.temperature, motion / 2 / 3, 1e-12);
  EXPECT_NEAR(state.kinetic_energy, motion / 2 + kMass * 25, 1e-12);
  EXPECT_NEAR(state.rotational_energy, 0.5 * 0.4 * kMass * kRadius * kRadius * 4, 1e-12);
  scene.hard.initial[0].velocity.x() = 5 - 10;  // they part fast
  scene.hard.initial[1].velocity.x() = 5 + 10;
  EXPECT_NEAR(state_of(scene).stress(0, 0), 2 * kMass * 100 / volume, 1e-9);
}

/// Six neighbours each; 3N bonds of which Σ cos² over the three directions is 3/2:
/// σ_xx = σ_yy = 3 N F l/(2V).
TEST(Assembly, HasCoordinationAndPressureOfATriangularLattice) {
  constexpr int kColumns = 8, kRows = 6;
  constexpr double kApart = 0.98, kForce = kStiffness * 0.02;
  const double row = kApart * std::sqrt(3.0) / 2;
  std::vector<Vector3> places;
  for (int j = 0; j < kRows; ++j)
    for (int i = 0; i < kColumns; ++i)
      places.emplace_back(kApart * (i + 0.5 * (j % 2)), row * j, kRadius);
  const ContactScene scene = spheres_at(places, {kApart * kColumns, row * kRows}, true);
  const AssemblyState state = state_of(scene);
  EXPECT_DOUBLE_EQ(state.coordination, 6);
  EXPECT_DOUBLE_EQ(state.coordination_of_carried, 6);
  const double n = kColumns * kRows;
  const double volume = kApart * kColumns * row * kRows * 2 * kRadius;
  for (int k = 0; k < 2; ++k)
    EXPECT_NEAR(state.stress(k, k), 1.5 * n * kForce * kApart / volume, 1e-10);
  EXPECT_NEAR(state.stress(0, 1), 0, 1e-10);
  EXPECT_NEAR(state.stress(2, 2), 0, 1e-10);

  // All pairs at a lattice's first distance, and none nearer.
  AssemblyObserver observer(scene, 1, 2);
  Frame frame;
  frame.bodies = scene.hard.initial;
  observer.take(0, frame);
  observer.take(1, frame);
  const Histogram& pairs = observer.assembly().pairs;
  double first = 0;
  for (std::size_t k = 0; pairs.middle(k) < 1.2; ++k) first += pairs.counts[k];
  EXPECT_EQ(first, 3 * n);
  EXPECT_EQ(pairs.counts[static_cast<std::size_t>(kApart / pairs.width)], 3 * n);
}

/// A cubic one that ends: 3 n² (n − 1) bonds of n³ spheres.
TEST(Assembly, HasCoordinationOfACube) {
  constexpr int kSide = 5;
  std::vector<Vector3> places;
  for (int k = 0; k < kSide * kSide * kSide; ++k)
    places.emplace_back(0.99 * (k % kSide), 0.99 * (k / kSide % kSide),
                        0.99 * (k / (kSide * kSide)) + 1);
  const AssemblyState state = state_of(spheres_at(places, Vector2::Zero(), false));
  EXPECT_DOUBLE_EQ(state.coordination, 2.0 * 3 * (kSide - 1) / kSide);
  EXPECT_EQ(state.contacts, static_cast<std::size_t>(3 * kSide * kSide * (kSide - 1)));
}

/// g = 1 for points that are independent, in every kind of region, also where it ends: within five
/// standard deviations of a count in each interval, and nearer over all of them.
TEST(Assembly, FindsNoCorrelationInAnIdealGas) {
  struct Case {
    Vector2 periodic;
    bool flat;
  };
  for (const Case& each : {Case{{20, 30}, true}, Case{{0, 0}, true}, Case{{20, 0}, true},
                           Case{{20, 30}, false}, Case{{0, 0}, false}, Case{{0, 30}, false}}) {
    constexpr int kBodies = 1500, kSamples = 12, kCounted = 6;  // the later ones
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Vector3> places(kBodies, {0, 0, kRadius});
    const ContactScene scene = spheres_at(places, each.periodic, each.flat);
    AssemblyObserver observer(scene, 1, kSamples);
    Frame frame;
    frame.bodies = scene.hard.initial;
    for (int k = 0; k < kSamples; ++k) {
      for (BodyState& body : frame.bodies)
        body.position = {20 * unit(random), 30 * unit(random),
                         each.flat ? kRadius : 8 * unit(random)};
      observer.take(k / (kSamples - 1.0), frame);
    }
    const Assembly& seen = observer.assembly();
    EXPECT_EQ(seen.flat, each.flat);
    double counted = 0, expected = 0;
    std::size_t intervals = 0;
    for (std::size_t k = 0; k < seen.pairs.counts.size(); ++k) {
      if (seen.pairs.expected[k] < 20) continue;
      ++intervals;
      counted += seen.pairs.counts[k];
      expected += seen.pairs.expected[k];
      EXPECT_NEAR(seen.pair_correlation(k), 1, 5 / std::sqrt(seen.pairs.expected[k]))
          << seen.pairs.middle(k) << ' ' << each.periodic.transpose() << ' ' << each.flat;
    }
    EXPECT_GT(intervals, 80u);
    // The box around N points is smaller by 2/(N + 1) in each direction than theirs. At edges that
    // many of a point's neighbours are missing makes the sum scatter by 2 √(v/N) of a sample, with
    // v < 0.1 the relative variance of how much of the sphere around a point lies inside.
    const bool ends = !each.flat || each.periodic.prod() == 0;
    const double edges = ends ? 6.0 / kBodies + 4 * 2 * std::sqrt(0.1 / (kBodies * kCounted)) : 0;
    EXPECT_NEAR(counted / expected, 1, 4 / std::sqrt(expected) + edges);
  }
}

/// Speeds of Maxwell have a_2 = 0; velocities spread evenly in a ball −2/(d + 4).
TEST(Assembly, TellsVelocitiesFromMaxwells) {
  constexpr int kBodies = 20000;
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> even(-1, 1);
  std::vector<Vector3> places;
  for (int i = 0; i < kBodies; ++i) places.emplace_back(2.0 * i, 0, 1.0);
  const ContactScene scene = spheres_at(places, Vector2::Zero(), false);
  const auto seen = [&](const auto& velocity) {
    AssemblyObserver observer(scene, 1, 2);
    Frame frame;
    frame.bodies = scene.hard.initial;
    for (BodyState& body : frame.bodies) body.velocity = Vector3(3, 0, 0) + velocity();
    observer.take(1, frame);
    return observer.assembly();
  };
  const Assembly maxwell =
      seen([&] { return Vector3(normal(random), normal(random), normal(random)); });
  // The error of a_2 is near √(8/(15 N)) for d = 3.
  EXPECT_NEAR(maxwell.states[0].sonine, 0, 4 * std::sqrt(8.0 / 15 / kBodies));
  const double counts = 3.0 * kBodies;
  double square = 0;
  for (std::size_t k = 0; k < maxwell.velocity.counts.size(); ++k) {
    // Of the interval, by Simpson's rule.
    const double c = maxwell.velocity.middle(k), h = maxwell.velocity.width;
    const double part =
        h / 6 *
        (Assembly::maxwell(c - h / 2) + 4 * Assembly::maxwell(c) + Assembly::maxwell(c + h / 2));
    if (part * counts < 5) continue;
    const double off = maxwell.velocity.counts[k] - part * counts;
    square += off * off / (part * counts);
  }
  EXPECT_LT(square, 50 + 4 * std::sqrt(2 * 50.0));  // χ² of at most 50 intervals

  const Assembly ball = seen([&] {
    Vector3 v;
    do v = {even(random), even(random), even(random)};
    while (v.squaredNorm() > 1);
    return v;
  });
  EXPECT_NEAR(ball.states[0].sonine, -2.0 / 7, 0.01);
  // ∫ P = 1, and <c²> = 1: the correction changes neither.
  double all = 0, second = 0;
  for (double c = -10; c <= 10; c += 1e-3) {
    all += 1e-3 * Assembly::with_sonine(c, 0.1);
    second += 1e-3 * c * c * Assembly::with_sonine(c, 0.1);
  }
  EXPECT_NEAR(all, 1, 1e-9);
  EXPECT_NEAR(second, 1, 1e-9);
}

TEST(Assembly, IsSampledEvenlyAndGoesOnAfterAnExchange) {
  const ContactScene scene = spheres_at({{0, 0, 1}, {2, 0, 1}}, Vector2::Zero(), false);
  Frame frame;
  frame.bodies = scene.hard.initial;
  std::vector<double> shown;
  const auto note = [&](double time, const std::vector<BodyState>& bodies) {
    EXPECT_EQ(bodies.size(), 2u);
    shown.push_back(time);
  };
  AssemblyObserver observer(scene, 2, 5, note);
  for (int k = 0; k <= 10; ++k) observer.take(0.1 * k, frame);
  StateArchive kept;
  kept(observer);
  const std::string bytes = kept.take();
  StateArchive archive{std::string_view(bytes)};
  AssemblyObserver other(scene, 2, 5, note);
  archive(other);
  archive.finish();
  for (int k = 11; k <= 20; ++k) other.take(0.1 * k, frame);
  ASSERT_EQ(other.assembly().time.size(), 5u);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_NEAR(other.assembly().time[k], 0.5 * static_cast<double>(k), 1e-12);
    EXPECT_EQ(shown[k], other.assembly().time[k]);
  }
}

}  // namespace
}  // namespace slipcheck
