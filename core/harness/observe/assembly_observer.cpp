#include "harness/observe/assembly_observer.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "harness/observe/blocking.h"
#include "reference/near_pairs.h"

namespace slipcheck {
namespace {

constexpr double kFastest = 5;           // root mean squares
constexpr std::size_t kVelocities = 50;  // intervals
constexpr double kFurthest = 4;          // mean diameters
constexpr std::size_t kDistances = 100;  // intervals
/// Below this part of the fastest speed in the run nothing moves.
constexpr double kStill = 1e-9;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

Histogram histogram(double low, double high, std::size_t count) {
  return {low, (high - low) / static_cast<double>(count), std::vector<double>(count, 0.0), {}};
}

}  // namespace

void Assembly::exchange(StateArchive& archive) {
  archive(time, states, mean_diameter, flat, bodies);
  for (Histogram* each : {&velocity, &pairs})
    archive(each->low, each->width, each->counts, each->expected);
}

double Assembly::maxwell(double c) {
  return std::exp(-0.5 * c * c) / std::sqrt(2 * std::numbers::pi);
}

double Assembly::with_sonine(double c, double a2) {
  const double c2 = c * c;
  return maxwell(c) * (1 + a2 * (c2 * c2 / 8 - 0.75 * c2 + 0.375));
}

double Assembly::velocity_density(std::size_t k) const {
  double all = 0;
  for (const double count : velocity.counts) all += count;
  return all > 0 ? velocity.counts[k] / (all * velocity.width) : kNone;
}

std::pair<double, double> Assembly::sonine() const {
  std::vector<double> later;
  for (std::size_t k = states.size() / 2; k < states.size(); ++k)
    if (states[k].temperature > 0) later.push_back(states[k].sonine);
  const BlockedMean mean = blocked_mean(later);
  return {mean.mean, mean.standard_error};
}

double Assembly::pair_correlation(std::size_t k) const {
  return pairs.expected[k] > 0 ? pairs.counts[k] / pairs.expected[k] : kNone;
}

AssemblyObserver::AssemblyObserver(const ContactScene& scene, double end, std::size_t samples,
                                   States states)
    : scene_(&scene), end_(end), samples_(samples), states_(std::move(states)) {
  const std::vector<Sphere>& bodies = scene.hard.bodies;
  assembly_.bodies = bodies.size();
  for (const Sphere& sphere : bodies)
    assembly_.mean_diameter += 2 * sphere.radius / static_cast<double>(bodies.size());
  assembly_.velocity = histogram(-kFastest, kFastest, kVelocities);
  assembly_.pairs = histogram(0, kFurthest, kDistances);
  assembly_.pairs.expected.assign(kDistances, 0.0);
}

namespace {

/// Of the interval: rounding of a step's time must not put a sample off by a frame.
constexpr double kEarly = 1e-9;

}  // namespace

std::optional<double> AssemblyObserver::next_look() const {
  if (next_ >= samples_) return std::numeric_limits<double>::infinity();
  const double interval = end_ / static_cast<double>(samples_ - 1);
  return (static_cast<double>(next_) - kEarly) * interval;
}

void AssemblyObserver::take(double time, const Frame& frame) {
  const double interval = end_ / static_cast<double>(samples_ - 1);
  if (time < *next_look()) return;
  // Where frames are further apart than samples, one counts once.
  next_ = std::max(next_ + 1, static_cast<std::size_t>(time / interval + kEarly) + 1);
  if (assembly_.time.empty()) assembly_.flat = assembly_region(scene_->hard, frame.bodies).flat;
  assembly_.time.push_back(time);
  assembly_.states.push_back(assembly_state(*scene_, frame.bodies));
  if (states_) states_(time, frame.bodies);
  if (time < 0.5 * end_) return;
  add_velocities(frame.bodies);
  add_pairs(frame.bodies);
}

void AssemblyObserver::add_velocities(const std::vector<BodyState>& bodies) {
  const int d = assembly_.flat ? 2 : 3;
  Vector3 mean = Vector3::Zero();
  double most = 0;
  for (const AssemblyState& state : assembly_.states) most = std::max(most, state.kinetic_energy);
  for (const BodyState& body : bodies) mean += body.velocity / static_cast<double>(bodies.size());
  double square = 0;
  for (const BodyState& body : bodies) square += (body.velocity - mean).head(d).squaredNorm();
  if (!(assembly_.states.back().kinetic_energy > kStill * kStill * most) || !(square > 0)) return;
  const double unit = std::sqrt(square / (static_cast<double>(bodies.size()) * d));
  Histogram& seen = assembly_.velocity;
  for (const BodyState& body : bodies)
    for (int k = 0; k < d; ++k) {
      const double place = ((body.velocity[k] - mean[k]) / unit - seen.low) / seen.width;
      if (place >= 0 && place < static_cast<double>(seen.counts.size()))
        ++seen.counts[static_cast<std::size_t>(place)];
    }
}

void AssemblyObserver::add_pairs(const std::vector<BodyState>& bodies) {
  const Scene& hard = scene_->hard;
  AssemblyRegion region = assembly_region(hard, bodies);
  region.flat = assembly_.flat;
  Histogram& seen = assembly_.pairs;
  const double d = assembly_.mean_diameter;
  // Points, found within a distance: of spheres half as large the surfaces are in touch.
  const double furthest = std::min(kFurthest * d, region.longest());
  const auto point = [&](std::size_t i) {
    NearSphere at{bodies[i].position, 0.5 * d};
    if (region.flat) at.position.z() = 0;
    return at;
  };
  const auto count = [&](std::span<const NearPair> pairs) {
    for (const auto& [i, j] : pairs) {
      const Vector3 apart = hard.to_nearest_image(point(i).position - point(j).position);
      const double place = std::floor(apart.norm() / d / seen.width);
      if (place < static_cast<double>(seen.counts.size()) &&
          (place + 1) * seen.width * d <= furthest)
        ++seen.counts[static_cast<std::size_t>(place)];
    }
  };
  // In space a body has some 250 others in that distance.
  near_pairs_in_shares({bodies.size(), point}, std::max(0.0, furthest - d), hard.periodic, count);
  for (std::size_t k = 0; k < seen.counts.size(); ++k) {
    if ((static_cast<double>(k) + 1) * seen.width * d > furthest) break;
    // By Simpson's rule, of polynomials of third degree in a plane and of fifth in space.
    const double from = static_cast<double>(k) * seen.width * d, h = seen.width * d;
    const auto pairs = [&](double r) { return region.ideal_pairs(bodies.size(), r); };
    seen.expected[k] += h / 6 * (pairs(from) + 4 * pairs(from + 0.5 * h) + pairs(from + h));
  }
}

}  // namespace slipcheck
