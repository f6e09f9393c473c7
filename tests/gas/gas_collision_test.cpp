#include <gtest/gtest.h>

#include <algorithm>

#include "../support/instruction_set.h"
#include "gases.h"
#include "physics/contact/collision.h"

namespace slipcheck {
namespace {

std::vector<BodyState> particles(const Gas& gas) {
  std::vector<BodyState> all;
  for (std::size_t k = 0; k < gas.setup().particles; ++k) all.push_back(gas.particle(k));
  return all;
}

bool same(const BodyState& a, const BodyState& b) {
  return a.velocity == b.velocity && a.angular_velocity == b.angular_velocity;
}

/// The line of centres, from the second to the first, of a collision that gave the first the
/// impulse P and the spin ΔΩ: R n×P = −I ΔΩ and P·n > 0.
Vector3 line_of_centres(const Vector3& P, const Vector3& spin, const Sphere& sphere) {
  const Vector3 n_by_P = -sphere.moment_of_inertia() / sphere.radius * spin;
  const Vector3 across = P.cross(n_by_P) / P.squaredNorm();
  return across + std::sqrt(std::max(0.0, 1 - across.squaredNorm())) * P.normalized();
}

/// Steps so short that no particle collides twice in one: what each pair did is what collide()
/// does, whose tests hold it against L.
void expect_the_hard_rule(int dimensions, const GasLaw& law) {
  GasSetup setup = test::small_gas(dimensions, 16);
  setup.step = 0.02;
  setup.rotation = 0.5;
  Gas gas(setup, law);
  std::vector<BodyState> before = particles(gas);
  std::size_t seen = 0;
  for (int step = 0; step < 2000; ++step) {
    const std::size_t collisions = gas.collisions();
    gas.advance();
    const std::vector<BodyState> after = particles(gas);
    std::vector<std::size_t> changed;
    for (std::size_t k = 0; k < after.size(); ++k)
      if (!same(before[k], after[k])) changed.push_back(k);
    // Of eight candidates several may collide, all of them other particles.
    if (changed.size() == 2 * (gas.collisions() - collisions))
      for (const std::size_t i : changed) {
        const Vector3 change = after[i].velocity - before[i].velocity;
        const auto with = std::ranges::find_if(changed, [&](std::size_t k) {
          return (after[k].velocity - before[k].velocity + change).norm() < 1e-13;
        });
        ASSERT_NE(with, changed.end());
        const std::size_t j = *with;
        ++seen;
        const Vector3 n =
            line_of_centres(setup.sphere.mass * change,
                            after[i].angular_velocity - before[i].angular_velocity, setup.sphere);
        BodyState first = before[i], second = before[j];
        first.position = 2 * setup.sphere.radius * n;
        const SubstrateContact none;
        collide(law.hard, {}, {setup.sphere, none, first, false},
                {setup.sphere, none, second, false});
        // The line is found from differences: roundings of 1e-16 over impulses of 1e-4 and more.
        EXPECT_LT((first.velocity - after[i].velocity).norm(), 1e-10);
        EXPECT_LT((second.velocity - after[j].velocity).norm(), 1e-10);
        EXPECT_LT((first.angular_velocity - after[i].angular_velocity).norm(),
                  1e-10 / setup.sphere.radius);
        EXPECT_LT((second.angular_velocity - after[j].angular_velocity).norm(),
                  1e-10 / setup.sphere.radius);
      }
    before = after;
  }
  EXPECT_GT(seen, 100u);
}

TEST(GasCollision, IsTheHardRule) {
  GasLaw bridges = test::smooth(1);
  bridges.hard.restitution = PowerLawRestitution{};
  GasLaw rough_bridges = test::rough(1, 0.3, 0.2);
  rough_bridges.hard.restitution = PowerLawRestitution{};
  for (const int D : {2, 3})
    for (const GasLaw& law : {test::smooth(0.7), test::rough(0.8, 0.3, 0.4),
                              test::rough(0.6, 100, -0.5), bridges, rough_bridges})
      expect_the_hard_rule(D, law);
}

TEST(GasCollision, KeepsMomentumAndWhatALawKeepsOfTheEnergy) {
  for (const int D : {2, 3})
    for (const GasLaw& law : {test::smooth(1), test::rough(1, 1e6, 1), test::rough(1, 0, 0)}) {
      GasSetup setup = test::small_gas(D, 4096);
      setup.rotation = 0.3;
      Gas gas(setup, law);
      const auto energy = [&] {
        const GasTemperatures both = test::temperatures(gas);
        return D * both.translation + 0.5 * D * (D - 1) * both.rotation;
      };
      const double at_first = energy();
      while (gas.collisions_per_particle() < 20) gas.advance();
      // Some roundings, 1e-16, at each of the 20 collisions of a particle.
      EXPECT_NEAR(energy() / at_first, 1, 1e-13);
      Vector3 momentum = Vector3::Zero();
      for (const BodyState& state : particles(gas)) momentum += state.velocity;
      EXPECT_LT(momentum.norm() / 4096, 1e-14);
    }
}

TEST(GasCollision, RoughGasThatNeverRubsIsTheSmoothOne) {
  // A cap that nothing reaches: spins stay, and velocities are those of the loop without them.
  GasLaw slippery = test::rough(0.8, 1e-300, 0.5);
  Gas with(test::small_gas(3, 4096), slippery),
      without(test::small_gas(3, 4096), test::smooth(0.8));
  EXPECT_TRUE(with.spins());
  EXPECT_FALSE(without.spins());
  for (int step = 0; step < 20; ++step) with.advance(), without.advance();
  for (std::size_t k = 0; k < 4096; ++k)
    EXPECT_EQ(with.particle(k).velocity, without.particle(k).velocity);
}

TEST(GasCollision, ThreadsChangeNoBitAndSeedsDo) {
  for (const GasLaw& law : {test::smooth(0.9), test::rough(0.9, 0.5, 0.3)}) {
    GasSetup setup = test::small_gas(3, 20'000);
    setup.rotation = 1;
    Gas one(setup, law);
    setup.threads = 3;
    Gas three(setup, law);
    setup.seed = 2;
    Gas other(setup, law);
    EXPECT_GT(one.cells(), 5u);
    for (int step = 0; step < 20; ++step) one.advance(), three.advance(), other.advance();
    const std::vector<BodyState> a = particles(one), b = particles(three), c = particles(other);
    EXPECT_EQ(one.collisions(), three.collisions());
    EXPECT_EQ(one.now(), three.now());
    for (std::size_t k = 0; k < a.size(); ++k) ASSERT_TRUE(same(a[k], b[k])) << k;
    EXPECT_FALSE(same(a[0], c[0]));
    // ⟨v²⟩ is of 20 000 particles; differences of two such means of 3 components.
    const double error = std::sqrt(2 * 2 / (3 * 20'000.0));
    EXPECT_NEAR(
        std::log(test::temperatures(one).translation / test::temperatures(other).translation), 0,
        4 * error);
  }
}

TEST(GasCollision, InstructionSetsChangeNoBit) {
  GasLaw bridges = test::rough(1, 0.3, 0.2);
  bridges.hard.restitution = PowerLawRestitution{};
  std::size_t sets = 0;
  for (const int D : {2, 3})
    for (const GasLaw& law : {test::smooth(0.9), test::rough(0.9, 0.5, 0.3), bridges}) {
      GasSetup setup = test::small_gas(D, 4096);
      setup.rotation = 1;
      std::vector<BodyState> first;
      for (const std::int64_t target : test::InstructionSet::all()) {
        const test::InstructionSet set(target);
        ++sets;
        Gas gas(setup, law);
        for (int step = 0; step < 10; ++step) gas.advance();
        const std::vector<BodyState> now = particles(gas);
        if (first.empty()) first = now;
        for (std::size_t k = 0; k < now.size(); ++k) ASSERT_TRUE(same(now[k], first[k])) << k;
      }
    }
  EXPECT_GE(sets, 2u * 6);
}

TEST(GasCollision, LargestAndSmallestNumbersOfParticlesAreTaken) {
  // One cell of two groups, and cells of unlike size.
  for (const std::size_t n : {16u, 24u, 4104u, 6152u}) {
    Gas gas(test::small_gas(3, n), test::smooth(1));
    for (int step = 0; step < 40; ++step) gas.advance();
    EXPECT_NEAR(gas.collisions_per_particle(), 10, 4 * std::sqrt(10 * 2 / static_cast<double>(n)));
  }
}

}  // namespace
}  // namespace slipcheck
