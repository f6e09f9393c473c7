#include "figures/box_runs.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <utility>

#include "base/in_parallel.h"
#include "harness/observe/box_observer.h"
#include "reference/events/planar_solver.h"

namespace slipcheck {
namespace {

constexpr double kGravity = 9.81;
constexpr double kSteelDensity = 7850;

/// The error of mean(a)/mean(b) relative to it: that of the mean of a/mean(a) − b/mean(b), to first
/// order, so that what both have in common does not count.
double relative_ratio_error(const std::vector<double>& a, double mean_a,
                            const std::vector<double>& b, double mean_b) {
  std::vector<double> apart(a.size());
  for (std::size_t k = 0; k < a.size(); ++k) apart[k] = a[k] / mean_a - b[k] / mean_b;
  return blocked_mean(apart).standard_error;
}

BoxMeans run_box(const VibratedBox& box, double longer) {
  const Scene scene = box.scene();
  const double flight = 2 * box.speed / kGravity;
  // Spheres that mostly slide on each other turn in about 1/(2μ) collisions, and have some tens of
  // them in a second.
  const double mu = std::get<double>(box.pair.friction);
  const double turning = mu > 0 ? 0.05 / mu : 0;
  const double discard = std::ceil(box.frequency * std::max({2.5, 10 * flight, turning}));
  const double periods = discard + std::ceil(box.frequency * longer * std::max(15.0, 60 * flight));

  PlanarSolver solver(scene, scene.initial);
  BoxSampling sampling;
  sampling.discard = static_cast<std::size_t>(discard);
  BoxObserver observer(scene, sampling);
  const double end = periods / box.frequency;
  const SolvedRun run = solver.run(until_time(end, 1 / box.frequency), &observer);
  if (!run.reached) throw std::runtime_error("vibrated box: " + run.reason);

  const BoxObservables seen = observer.finish();
  const BoxSeries& series = observer.series();
  const double kinetic = seen.kinetic_energy.mean, rotational = seen.rotational_energy.mean;
  double weight = 0;  // mean m g
  for (const Sphere& sphere : scene.bodies)
    weight += sphere.mass * kGravity / static_cast<double>(scene.bodies.size());
  BoxMeans means;
  means.height = seen.height.mean;
  means.height_error = seen.height.standard_error;
  means.kinetic_share = kinetic / (weight * means.height);
  means.kinetic_share_error =
      means.kinetic_share *
      relative_ratio_error(series.kinetic_energy, kinetic, series.height, means.height);
  const bool spins = rotational > 0;
  means.ratio = spins ? kinetic / rotational : NAN;
  means.ratio_error = spins
                          ? means.ratio * relative_ratio_error(series.kinetic_energy, kinetic,
                                                               series.rotational_energy, rotational)
                          : NAN;
  means.steady = seen.steady;
  return means;
}

/// The middles of `box.count` equal parts of d0 ± w0, shuffled.
std::vector<double> diameters_of(const VibratedBox& box) {
  const auto count = static_cast<double>(box.count);
  std::vector<double> diameters;
  for (std::size_t i = 0; i < box.count; ++i) {
    const double middle = (2 * static_cast<double>(i) + 1) / count - 1;
    diameters.push_back(box.diameter * (1 + box.spread * middle));
  }
  std::mt19937_64 random(4442);
  for (std::size_t i = box.count; i > 1; --i) std::swap(diameters[i - 1], diameters[random() % i]);
  return diameters;
}

}  // namespace

void VibratedBox::set_contacts(double e, double friction, double tangential_restitution) {
  pair = floor = wall = PairContact{e, friction, tangential_restitution};
}

Scene VibratedBox::scene() const {
  Scene scene;
  scene.gravity = kGravity;
  for (double d : diameters_of(*this))
    scene.bodies.push_back(
        {d / 2, kSteelDensity * 4 * std::numbers::pi / 3 * std::pow(d / 2, 3), shape_factor});
  scene.material.assign(count, 0);
  scene.substrate.resize(1);
  scene.pairs = {pair};
  scene.box.emplace();
  scene.box->width = width * diameter;
  scene.box->floor = {speed / (2 * std::numbers::pi * frequency), frequency};
  scene.box->moving_walls = moving_walls;
  scene.box->lid = lid;
  scene.box->on_floor = scene.box->on_lid = {floor};
  scene.box->on_wall = {wall};

  const auto in_row = static_cast<std::size_t>(width / (1.01 + spread));
  const double apart = scene.box->width / static_cast<double>(in_row);
  const double row = (1 + spread) * diameter;
  std::mt19937_64 random(1995);
  for (std::size_t i = 0; i < count; ++i) {
    // The standard's distributions differ between libraries; its generators do not.
    const double angle = 2 * std::numbers::pi * static_cast<double>(random() >> 11) * 0x1p-53;
    BodyState state;
    const auto rows_below = i / in_row;
    state.position.x() = (static_cast<double>(i % in_row) + 0.5) * apart;
    state.position.z() = (0.55 + 1.1 * static_cast<double>(rows_below)) * row;
    state.velocity = 0.2 * speed * Vector3(std::cos(angle), 0, std::sin(angle));
    scene.initial.push_back(state);
  }
  return scene;
}

double times_longer(Effort effort) { return effort == Effort::full ? 12 : 1; }

std::vector<BoxMeans> run_boxes(std::span<const VibratedBox> boxes, double longer) {
  std::vector<BoxMeans> means(boxes.size());
  in_parallel(boxes.size(), 0, [&](std::size_t k) { means[k] = run_box(boxes[k], longer); });
  return means;
}

Curve error_bars(Ink ink, const std::vector<double>& x, const std::vector<double>& y,
                 const std::vector<double>& error) {
  Curve bars{"", {ink, Line::solid, Marker::none}, {}, {}};
  for (std::size_t k = 0; k < x.size(); ++k)
    for (double end : {y[k] - error[k], y[k] + error[k], static_cast<double>(NAN)}) {
      bars.x.push_back(x[k]);
      bars.y.push_back(end);
    }
  return bars;
}

std::vector<double> column(std::span<const BoxMeans> runs, double BoxMeans::*member) {
  std::vector<double> values;
  for (const BoxMeans& run : runs) values.push_back(run.*member);
  return values;
}

}  // namespace slipcheck
