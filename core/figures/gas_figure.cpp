#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "figures/paper_figure.h"
#include "harness/observe/gas_restitution.h"
#include "physics/closed_forms.h"
#include "reference/events/event_solver.h"

namespace slipcheck {
namespace {

// Steel spheres as in K's examples, on a level periodic plane.
constexpr double kRadius = 2e-3;          // [m]
constexpr double kFriction = 0.1;         // μ_k with the substrate
constexpr double kRestitution = 0.9;      // e_n
constexpr double kSpeed = 0.5;            // of each at first [m/s]
constexpr std::size_t kSide = 14;         // of the lattice they start from
constexpr std::size_t kCollisions = 300;  // in each point
constexpr double kDilute = 20;     // l/s from which on nine slides in ten are not interrupted
constexpr double kDiffers = 0.01;  // one in the second digit of e_eff

struct Density {
  double area_fraction;
  double time;  ///< to follow the gas [s]: until it slides a hundredth of its free path
  Look look;
};
constexpr std::array<Density, 4> kDensities = {{
    {0.02, 9.0, {Ink::blue, Line::none, Marker::circle}},
    {0.05, 5.5, {Ink::vermilion, Line::none, Marker::triangle}},
    {0.1, 4.0, {Ink::green, Line::none, Marker::square}},
    {0.2, 1.8, {Ink::purple, Line::none, Marker::circle}},
}};

/// Spheres that roll in random directions, on a square lattice at first.
Scene rolling_gas(double area_fraction) {
  constexpr std::size_t count = kSide * kSide;
  Scene scene;
  scene.gravity = 9.81;
  scene.confined = true;
  scene.substrate.resize(1);
  scene.substrate[0].static_friction = scene.substrate[0].kinetic_friction = kFriction;
  PairContact pair;
  pair.restitution = kRestitution;
  scene.pairs = {pair};
  const double length =
      std::sqrt(static_cast<double>(count) * std::numbers::pi * kRadius * kRadius / area_fraction);
  scene.periodic = {length, length};
  std::mt19937_64 random(1999);
  for (std::size_t i = 0; i < count; ++i) {
    const double cell = length / static_cast<double>(kSide);
    // 53 random bits are the same on every platform.
    const double angle = 2 * std::numbers::pi * static_cast<double>(random() >> 11) * 0x1p-53;
    BodyState state;
    const auto rows_below = i / kSide;
    state.position = {(static_cast<double>(i % kSide) + 0.5) * cell,
                      (static_cast<double>(rows_below) + 0.5) * cell, kRadius};
    state.velocity = {kSpeed * std::cos(angle), kSpeed * std::sin(angle), 0};
    state.angular_velocity = rolling_angular_velocity(state.velocity, kRadius);
    scene.bodies.push_back({kRadius, 1, 0.4});
    scene.material.push_back(0);
    scene.initial.push_back(state);
  }
  return scene;
}

}  // namespace

PaperFigure figure_rolling_gas() {
  PaperFigure figure;
  figure.name = "rolling-gas";
  figure.title = "Effective restitution in a gas that rolls and slides";
  Panel a{"(a) effective restitution",
          {"l/s [-], mean free path over sliding distance", true},
          {"e_{eff}", false, 0.3, 1.0}};
  Panel b{"(b) slides that nothing interrupted",
          {"l/s [-], mean free path over sliding distance", true},
          {"share", false, 0, 1.05}};
  std::vector<double> fraction, ratio, effective, error, isolated, after, path, way, share;
  for (const Density& density : kDensities) {
    const Scene scene = rolling_gas(density.area_fraction);
    GasRestitution seen(scene, kCollisions, 1e-9 * kSpeed);
    EventSolver(scene, scene.initial).run(until_time(density.time), &seen);
    Curve gas{fmt::format("area fraction {:g}", density.area_fraction), density.look};
    Curve alone = gas;
    alone.label.clear();
    Curve finished = alone;
    for (const GasWindow& window : seen.windows()) {
      fraction.push_back(density.area_fraction);
      ratio.push_back(window.free_path / window.sliding_distance);
      effective.push_back(window.effective);
      error.push_back(window.effective_error);
      isolated.push_back(window.isolated);
      after.push_back(window.restitution);
      path.push_back(window.free_path / 1e-3);
      way.push_back(window.sliding_distance / 1e-3);
      share.push_back(window.uninterrupted);
      gas.x.push_back(ratio.back());
      gas.y.push_back(window.effective);
      finished.x.push_back(ratio.back());
      finished.y.push_back(window.uninterrupted);
    }
    a.curves.push_back(gas);
    b.curves.push_back(finished);
  }
  const HeadOnCollision head_on{1 / 0.4, kRestitution, 0};
  const std::vector<double> ends = {0.03, 60};
  a.curves.push_back({"e_n", {Ink::black, Line::dashed}, ends, {kRestitution, kRestitution}});
  a.curves.push_back({"(A e_n − 1)/(1+A)",
                      {Ink::black, Line::solid},
                      ends,
                      {head_on.effective_restitution(), head_on.effective_restitution()}});
  // Each of the two travels s, and meets the next body after l in the mean.
  Curve poisson{"e^{−2s/l}", {Ink::black, Line::solid}};
  for (double x = ends[0]; x <= ends[1]; x *= 1.1) {
    poisson.x.push_back(x);
    poisson.y.push_back(std::exp(-2 / x));
  }
  b.curves.push_back(poisson);
  figure.panels = {a, b};
  Table& table = figure.table;
  table.add("area fraction [-]", fraction);
  table.add("l/s [-]", ratio);
  table.add("e_eff [-]", effective);
  table.add("e_eff standard error [-]", error);
  table.add("e_eff if never interrupted [-]", isolated);
  table.add("e right after the collision [-]", after);
  table.add("l [mm]", path);
  table.add("s if never interrupted [mm]", way);
  table.add("share not interrupted [-]", share);
  // Means over the windows, each with the standard error of its own scatter.
  const auto mean_of = [&](const std::vector<double>& values, double low, double high) {
    double count = 0, sum = 0, squares = 0;
    for (std::size_t k = 0; k < values.size(); ++k)
      if (ratio[k] > low && ratio[k] < high)
        count += 1, sum += values[k], squares += values[k] * values[k];
    const double mean = sum / count;
    return std::pair(mean, std::sqrt((squares / count - mean * mean) / (count - 1)));
  };
  const auto [alone, alone_error] = mean_of(isolated, kDilute, kUnbounded);
  const auto [between, between_error] = mean_of(effective, 0.5, 2);
  figure.statements = {
      stated_number("e_eff for l ≫ s of pairs that nothing interrupts, (68)", "0.36", 0.36, 0.005,
                    alone, alone_error,
                    fmt::format("read as l > {:g} s, where e^−2s/l is above 0.9", kDilute)),
      {"e_eff for l ≈ s less that of an isolated pair", "differs", kDiffers, kUnbounded,
       between - head_on.effective_restitution(), between_error,
       fmt::format("mean over 0.5 < l/s < 2; read as by at least {:g}", kDiffers)}};
  figure.notes =
      "The outlook of K made quantitative. As the gas cools s falls and l/s rises. Where l ≫ s a "
      "pair parts with (A e_n − 1)/(1+A), where l ≪ s with e_n. At an area fraction of 0.4, not "
      "drawn, the gas forms clusters when it is cold, in which collisions follow each other sooner "
      "than the mean free path says, and e_eff rises above the curve.";
  figure.caption = fmt::format(
      "K's conjecture on many particles: a pair's relative velocity along the line of centres, "
      "once "
      "neither slides or one of them has collided again, over that before the collision. {} "
      "spheres "
      "of 2 mm roll at {:g} m/s at first, e_n = {:g}, smooth, μ_k = {:g} with a level periodic "
      "plane; "
      "as they lose speed the sliding distance s falls and l/s rises, from right after the "
      "collisions (e_n) to the restitution of an isolated pair. Each point averages {} collisions "
      "in turn. Densities fall on one curve until the gas forms clusters. s is what each body "
      "would "
      "slide if nothing came in its way; e^{{−2s/l}} is the share if collisions were independent "
      "of it.",
      kSide * kSide, kSpeed, kRestitution, kFriction, kCollisions);
  return figure;
}

}  // namespace slipcheck
