#pragma once

#include <cstddef>
#include <random>

#include "../scenes.h"

namespace slipcheck::test {

/// The same numbers everywhere.
class Random {
 public:
  explicit Random(unsigned seed) : generator_(seed) {}
  double operator()(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_() >> 11) * 0x1p-53;
  }
  bool chance(double p) { return (*this)(0, 1) < p; }

 private:
  std::mt19937_64 generator_;
};

/// Anything the solver takes: unlike spheres, rubbing, rolling friction over the speed, drilling,
/// drops and bounces; of 1 to 8 bodies, or as many as asked for.
inline Scene random_scene(unsigned seed, std::size_t bodies = 0) {
  Random random(seed);
  Scene scene;
  scene.gravity = random.chance(0.1) ? 0 : random(1, 30);
  scene.confined = random.chance(0.2);
  const std::size_t materials = random.chance(0.5) ? 1 : 2;
  for (std::size_t m = 0; m < materials; ++m) {
    SubstrateContact c;
    c.kinetic_friction = random.chance(0.1) ? 0 : random(0.01, 1);
    c.static_friction = c.kinetic_friction + random(0, 0.5);
    if (random.chance(0.5)) c.rolling = RollingFriction(random(0, c.static_friction));
    if (random.chance(0.3))
      c.rolling = RollingFriction({{0.05, random(0, c.static_friction)},
                                   {0.2, random(0, c.static_friction)},
                                   {0.5, random(0, c.static_friction)}});
    if (random.chance(0.5)) c.drilling_length = random(0, 1e-3);
    if (random.chance(0.5)) c.restitution = random(0, 0.95);
    scene.substrate.push_back(c);
  }
  scene.pairs.resize(materials * materials);
  for (std::size_t a = 0; a < materials; ++a)
    for (std::size_t b = 0; b <= a; ++b) {
      PairContact pair{random(0, 1), random.chance(0.4) ? 0 : random(0, 1), random(-1, 1)};
      scene.pairs[a * materials + b] = scene.pairs[b * materials + a] = pair;
    }
  const double size = random(0.002, 0.05);
  const auto any = static_cast<std::size_t>(random(1, 9));
  const std::size_t count = bodies > 0 ? bodies : any;
  for (std::size_t i = 0; i < count; ++i) {
    const double radius = size * random(0.6, 1);
    scene.bodies.push_back({radius, random(0.5, 2), random(0.3, 1)});
    scene.material.push_back(static_cast<std::size_t>(random(0, static_cast<double>(materials))));
    BodyState s;
    s.position = {2.5 * size * static_cast<double>(i % 3), 2.5 * size * static_cast<double>(i / 3),
                  radius};
    if (!scene.confined && random.chance(0.3)) s.position.z() += random(0, 0.1);
    if (random.chance(0.8)) s.velocity = {random(-1, 1), random(-1, 1), 0};
    if (random.chance(0.5)) s.angular_velocity = rolling_angular_velocity(s.velocity, radius);
    if (random.chance(0.3))
      s.angular_velocity += Vector3(random(-9, 9), random(-9, 9), random(-9, 9));
    scene.initial.push_back(s);
  }
  return scene;
}

}  // namespace slipcheck::test
