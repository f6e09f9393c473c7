#include "studies/stability/closed_contact.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "reference/steps/step_solver.h"

namespace slipcheck {
namespace {

constexpr double kRadius = 0.002;  // [m]
constexpr double kSqueeze = 1e-6;  // overlap on either side [m]
constexpr double kDensity = 7850;  // [kg/m³]
constexpr double kOutweighs = 1e12;
constexpr std::size_t kSteps = 4000;
constexpr double kBlownUp = 1e3;  // times the first amplitude
/// Of what opens the contact, which would end the growth: blown up comes long before.
constexpr double kFirst = 1e-4;
/// Of the first amplitude, below which a swing has died out: far above rounding.
constexpr double kDiedOut = 1e-3;

ContactScene squeezed(const LinearForce& law) {
  ContactScene scene;
  Scene& hard = scene.hard;
  hard.substrate.resize(1);
  hard.pairs.resize(1);
  const double mass = kDensity * 4 * std::numbers::pi / 3 * std::pow(kRadius, 3);
  for (const double side : {-1.0, 0.0, 1.0}) {
    hard.bodies.push_back({kRadius, side == 0 ? mass : kOutweighs * mass, 0.4});
    hard.material.push_back(0);
    BodyState state;
    state.position = {side * (2 * kRadius - kSqueeze), 0, 1};  // far above the plane
    hard.initial.push_back(state);
  }
  scene.soft = {SoftContact{law, ContactEnd::zero_overlap, NoTangentialForce{}}};
  return scene;
}

/// Largest way of the middle sphere from its middle in each quarter of the run; close to the limit,
/// where it goes to and fro from step to step, its speed at the steps says nothing.
struct Quarters final : FrameSink {
  void take(double, const Frame& frame) override {
    double& largest = way[std::min<std::size_t>(4 * frames++ / (kSteps + 1), 3)];
    const double now = std::abs(frame.bodies[1].position.x());
    largest = now > largest || std::isnan(now) ? now : largest;
  }
  std::array<double, 4> way{};
  std::size_t frames = 0;
};

}  // namespace

Trial closed_contact_trial(double omega0, double gamma, double step) {
  ContactScene scene = squeezed({1, 0});
  const double mass = scene.hard.bodies[1].mass;
  // Both sides push: ω0² = 2k/m, γ = 2c/m.
  scene.soft[0]->normal = LinearForce{0.5 * mass * omega0 * omega0, 0.5 * mass * gamma};
  const double first = kFirst * kSqueeze;
  scene.hard.initial[1].velocity = {first * omega0, 0, 0};
  StepSolver solver(scene, scene.hard.initial, {step});
  Quarters seen;
  const double end = static_cast<double>(kSteps) * step;
  solver.run(until_time(end), &seen);

  const double largest = *std::ranges::max_element(seen.way);
  const bool is_finite = std::ranges::all_of(seen.way, [](double v) { return std::isfinite(v); });
  if (!is_finite || largest > kBlownUp * first)
    return {false, Outcome::exploded,
            fmt::format("the amplitude grows more than {}-fold in {} steps", kBlownUp, kSteps)};
  if (seen.way[3] > 2 * seen.way[1] && seen.way[3] > kDiedOut * first)
    return {false, Outcome::energy_growing,
            fmt::format("the amplitude grows {:.3g}-fold in {} steps", seen.way[3] / seen.way[1],
                        kSteps / 2)};
  return {true, Outcome::accurate, {}};
}

}  // namespace slipcheck
