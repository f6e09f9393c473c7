#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "../scenes.h"
#include "../support/refusal.h"
#include "lammps_bare.h"
#include "worker_run.h"

// Many bodies go into LAMMPS from a file in memory and are seen where that is asked for.

namespace slipcheck {
namespace {

constexpr double kRadius = 1e-3, kTime = 1e-3;  // [m], t_col [s]

/// side³ spheres that nothing pulls, on a lattice that lets none touch, with velocities by chance.
EngineScene cloud(int side, double speed) {
  const auto count = static_cast<std::size_t>(side * side * side);
  Scene scene = test::steel_scene(count);
  scene.has_substrate = false;
  scene.gravity = 0;
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> any(-speed, speed);
  for (std::size_t i = 0; i < count; ++i) {
    const auto k = static_cast<int>(i);
    scene.bodies[i].radius = kRadius;
    scene.bodies[i].mass = 3.3e-5;
    scene.initial[i].position = 2.2 * kRadius * Vector3(k % side, k / side % side, k / side / side);
    for (int axis = 0; axis < 3; ++axis) {
      scene.initial[i].velocity[axis] = any(generator);
      scene.initial[i].angular_velocity[axis] = any(generator) / kRadius;
    }
  }
  EngineScene soft(scene);
  const double mass = scene.bodies[0].mass / 2, k = mass * std::pow(M_PI / kTime, 2);
  soft.soft.emplace().pairs.assign(scene.pairs.size(),
                                   SoftContact{LinearForce{k, 200 * mass}, ContactEnd::zero_overlap,
                                               ViscousForce{300 * mass, 0.4}});
  return soft;
}

bool same_bits(const std::vector<BodyState>& a, const std::vector<BodyState>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

/// What a file says of masses is a density, and LAMMPS's mass of it may differ in the last bit.
TEST(LammpsOfMany, AFileSaysTheSameAsACommandForEachBody) {
  const EngineScene scene = cloud(10, 0.5);
  constexpr double kStep = 1e-3;
  RemoteEngine engine(test::peer_executable("lammps"));
  const Applied applied = engine.configure(scene, {}, kStep);
  const auto number = [&](const char* name) { return std::get<double>(applied.settings.at(name)); };
  const double mass = scene.bodies[0].mass / 2;
  const int inner = static_cast<int>(number("substeps"));
  // Its bins lie in a box with two radii around the centres at the start.
  const double low = -2 * kRadius, high = (9 * 2.2 + 2) * kRadius;
  std::string atoms = test::bare_atoms(scene, {{low, low, low}, {high, high, high}});
  atoms.replace(atoms.find("boundary s s s"), 14, "boundary m m m");
  const std::string bare =
      atoms +
      fmt::format("pair_style gran/hooke {:.17g} NULL {:.17g} {:.17g} 0.4 1\npair_coeff * *\n",
                  number("pair_stiffness"), number("pair_damping") / mass,
                  number("pair_tangential_damping") / mass) +
      fmt::format("atom_modify sort 0 0\nneighbor {:.17g} bin\n", 0.3 * kRadius) +
      "neigh_modify delay 0 every 1 check yes\nfix 1 all nve/sphere\n";
  const auto expected =
      test::bare_lammps(bare, kStep / inner, 20 * inner, 10 * inner, scene.bodies.size());
  engine.start(scene.initial);
  std::vector<BodyState> seen;
  for (std::size_t k = 1; k < expected.size(); ++k) {
    engine.skip(10, seen);
    EXPECT_TRUE(same_bits(seen, expected[k])) << "after " << 10 * k << " steps";
  }
  ASSERT_FALSE(same_bits(expected[1], expected[2])) << "nothing moves";
}

TEST(LammpsOfMany, WhatIsSkippedEndsWhereStepsDo) {
  const EngineScene scene = cloud(3, 0.5);
  RemoteEngine engine(test::peer_executable("lammps"));
  const auto frames = test::peer_run(engine, scene, {}, 1e-3, 12);
  engine.start(scene.initial);
  std::vector<BodyState> seen;
  engine.skip(5, seen);
  EXPECT_TRUE(same_bits(seen, frames[4].bodies));
  engine.skip(1, seen);
  EXPECT_TRUE(same_bits(seen, frames[5].bodies));
  std::size_t more = 6;  // who is skipped can be looked at again
  engine.advance(3, [&](const Frame& frame) {
    EXPECT_TRUE(same_bits(frame.bodies, frames[more].bodies)) << more;
    ++more;
  });
  engine.skip(3, seen);
  EXPECT_TRUE(same_bits(seen, frames[11].bodies));
}

/// Two ranks add forces in another order: after a few collisions each, rounding has grown a little.
TEST(LammpsOfMany, TwoRanksSeeTheSame) {
  const EngineScene scene = cloud(10, 0.5);
  std::vector<BodyState> one, two;
  for (auto [ranks, seen] : {std::pair{1.0, &one}, {2.0, &two}}) {
    RemoteEngine engine(test::peer_executable("lammps"));
    engine.configure(scene, {{"ranks", ranks}}, 1e-3);
    engine.start(scene.initial);
    engine.skip(4, *seen);
  }
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t i = 0; i < one.size(); ++i)
    EXPECT_LT((one[i].position - two[i].position).norm(), 1e-9 * kRadius) << i;
}

TEST(LammpsOfMany, TooManyKindsOfSphereAreRefused) {
  EngineScene scene = cloud(7, 0.5);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    scene.bodies[i].radius *= 1 - 1e-3 * static_cast<double>(i) / 343;
  RemoteEngine engine(test::peer_executable("lammps"));
  EXPECT_EQ(test::refusal_of<Refused>([&] { engine.configure(scene, {}, 1e-3); }),
            "lammps: each material, radius and mass is an atom type of its own, the scene has 343 "
            "of them, and there must be at most 300");
}

}  // namespace
}  // namespace slipcheck
