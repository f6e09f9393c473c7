#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "scene/contact_scene.h"

namespace slipcheck::bench {

/// Units of the peer: diameter and mass 1, temperature 1. A contact takes 50 steps.
constexpr double kStep = 1.4e-4;

/// In (0, 1), the same everywhere.
inline double uniform(std::mt19937_64& random) {
  return (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53;
}

/// The bodies at random on a periodic square of that area, none overlapping; for area fractions up
/// to about 0.5. The first is the largest.
inline void place_at_random(Scene& hard, double area, std::mt19937_64& random) {
  const double length = std::sqrt(area);
  const auto cells = static_cast<std::ptrdiff_t>(length / (2 * hard.bodies.front().radius));
  std::vector<std::vector<std::size_t>> grid(static_cast<std::size_t>(cells * cells));
  const auto cell = [&](double x) {
    return static_cast<std::ptrdiff_t>(x / length * static_cast<double>(cells));
  };
  const auto nearest = [&](double d) { return d - length * std::nearbyint(d / length); };
  hard.periodic = {length, length};
  while (hard.initial.size() < hard.bodies.size()) {
    const std::size_t body = hard.initial.size();
    const double radius = hard.bodies[body].radius;
    const Vector3 x(length * uniform(random), length * uniform(random), radius);
    bool is_free = true;
    for (std::ptrdiff_t k = 0; k < 9; ++k) {
      const std::ptrdiff_t i = (cell(x.x()) + k % 3 - 1 + cells) % cells;
      const std::ptrdiff_t j = (cell(x.y()) + k / 3 - 1 + cells) % cells;
      for (const std::size_t other : grid[static_cast<std::size_t>(j * cells + i)]) {
        const Vector3 apart = x - hard.initial[other].position;
        is_free &=
            std::hypot(nearest(apart.x()), nearest(apart.y())) > radius + hard.bodies[other].radius;
      }
    }
    if (!is_free) continue;
    grid[static_cast<std::size_t>(cell(x.y()) * cells + cell(x.x()))].push_back(body);
    BodyState state;
    state.position = x;
    hard.initial.push_back(state);
  }
}

/// n grains on a jittered hexagonal lattice that fills a periodic plane of that area.
inline void place_on_lattice(Scene& hard, std::size_t n, double area, std::mt19937_64& random) {
  const auto rows = 2 * static_cast<std::size_t>(std::round(
                            std::sqrt(static_cast<double>(n) / (std::sqrt(3.0) / 2)) / 2));
  const std::size_t columns = (n + rows - 1) / rows;
  const double a = std::sqrt(area / (static_cast<double>(columns * rows) * std::sqrt(3.0) / 2));
  const double h = a * std::sqrt(3.0) / 2;
  hard.periodic = {static_cast<double>(columns) * a, static_cast<double>(rows) * h};
  for (std::size_t k = 0; k < n; ++k) {
    const auto i = static_cast<double>(k % columns), j = static_cast<double>(k / columns);
    const double turn = 2 * std::numbers::pi * uniform(random);
    const double jitter = 0.3 * (a - 1) * uniform(random);
    BodyState state;
    state.position = {
        (i + 0.5 * static_cast<double>(k / columns % 2) + 0.25) * a + jitter * std::cos(turn),
        (j + 0.5) * h + jitter * std::sin(turn), 0.5};
    hard.initial.push_back(state);
  }
}

/// What the bodies cover of the plane, seen from above.
inline double covered_area(const Scene& hard) {
  double sum = 0;
  for (const Sphere& body : hard.bodies) sum += body.radius * body.radius;
  return std::numbers::pi * sum;
}

inline void place(Scene& hard, double area, std::mt19937_64& random) {
  if (covered_area(hard) < 0.45 * area)
    place_at_random(hard, area, random);
  else
    place_on_lattice(hard, hard.bodies.size(), area, random);
}

/// A periodic gas of n grains with K's forces, e_n = 0.90, and Gaussian velocities. on_plane: a
/// monolayer that slides and rolls (μ = 0.5, g = 10). Each seed is another gas. ratio: of the
/// largest to the smallest radius, evenly spread in four sizes about the peer's, of one density; 1
/// where the area fraction is beyond place_at_random().
inline ContactScene grain_gas(std::size_t n, double area_fraction, bool on_plane,
                              std::uint64_t seed = 1, double ratio = 1) {
  ContactScene scene;
  Scene& hard = scene.hard;
  for (std::size_t i = 0; i < n; ++i) {
    const double share = 1 - static_cast<double>(4 * i / n) / 3;  // of the way to the largest
    const double size = 2 * (1 + (ratio - 1) * share) / (1 + ratio);
    hard.bodies.push_back({0.5 * size, size * size * size, 0.4});
  }
  hard.material.assign(n, 0);
  hard.substrate.resize(1);
  hard.pairs = {{0.9, 0.5, 0}};
  hard.gravity = 10;
  hard.confined = true;
  if (on_plane) hard.substrate[0].static_friction = hard.substrate[0].kinetic_friction = 0.5;
  SoftContact contact;
  contact.normal = LinearForce{1e5, 0.5 * 30};
  contact.tangential = ViscousForce{0.5 * 15, 0.5};
  scene.soft = {contact};

  std::mt19937_64 random(seed);
  place(hard, covered_area(hard) / area_fraction, random);
  Vector3 mean = Vector3::Zero();
  for (BodyState& state : hard.initial) {
    const double size = std::sqrt(-2 * std::log(uniform(random)));
    const double angle = 2 * std::numbers::pi * uniform(random);
    state.velocity = {size * std::cos(angle), size * std::sin(angle), 0};
    mean += state.velocity / static_cast<double>(n);
  }
  for (BodyState& state : hard.initial) state.velocity -= mean;
  return scene;
}

}  // namespace slipcheck::bench
