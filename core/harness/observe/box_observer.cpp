#include "harness/observe/box_observer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>

#include "harness/observe/steady_state.h"

namespace slipcheck {
namespace {

/// A width this little, of d0, below what a row needs is rounding.
constexpr double kWidthRounding = 1e-9;

double mean_diameter(const Scene& scene) {
  double sum = 0;
  for (const Sphere& sphere : scene.bodies) sum += 2 * sphere.radius;
  return sum / static_cast<double>(scene.bodies.size());
}

}  // namespace

double sampling_interval(const Scene& scene, const BoxSampling& sampling) {
  const double frequency = scene.box->floor.frequency;
  if (frequency == 0) return sampling.interval;
  return 1 / (frequency * static_cast<double>(sampling.per_period));
}

double resting_height(const Scene& scene) {
  assert(scene.box && !scene.bodies.empty());
  const double d0 = mean_diameter(scene);
  const double width = scene.box->width / d0 + kWidthRounding;
  const auto n = static_cast<double>(scene.bodies.size());
  const double n_b = std::max(1.0, std::floor(width - 0.5));
  const double n_h = std::floor(n / n_b);
  const double n_r = n - n_b * n_h;
  const double shift = std::clamp(width - 1, 0.0, 0.5);
  const double rise = shift < 0.5 ? std::sqrt(1 - shift * shift) : std::numbers::sqrt3 / 2;
  return d0 / (2 * n) * (n_b * ((1 - rise) * n_h + rise * n_h * n_h) + n_r * (1 + 2 * rise * n_h));
}

BoxObserver::BoxObserver(const Scene& scene, const BoxSampling& sampling)
    : scene_(&scene),
      sampling_(sampling),
      rest_(resting_height(scene)),
      mass_(0),
      next_(sampling.discard * sampling.per_period) {
  sampling_.interval = sampling_interval(scene, sampling);
  if (!(sampling_.interval > 0) || !std::isfinite(sampling_.interval))
    throw std::invalid_argument(
        fmt::format("a box whose floor has no frequency is sampled at an interval > 0, got {:g} s",
                    sampling_.interval));
  for (const Sphere& sphere : scene.bodies) mass_ += sphere.mass;
}

BoxObserver::Look BoxObserver::look_at(const Frame& frame) const {
  double moment = 0, kinetic = 0, rotational = 0;
  for (std::size_t i = 0; i < scene_->bodies.size(); ++i) {
    const Sphere& sphere = scene_->bodies[i];
    const BodyState& state = frame.bodies[i];
    moment += sphere.mass * state.position.z();
    kinetic += 0.5 * sphere.mass * state.velocity.squaredNorm();
    rotational += 0.5 * sphere.moment_of_inertia() * state.angular_velocity.squaredNorm();
  }
  const auto bodies = static_cast<double>(scene_->bodies.size());
  return {moment / mass_ - rest_, kinetic / bodies, rotational / bodies,
          static_cast<double>(collisions_)};
}

void BoxObserver::count_collisions(const Frame& frame) {
  if (frame.collisions) {
    collisions_ = *frame.collisions;
    return;
  }
  now_.clear();
  for (const Touch& touch : frame.touches)
    if (touch.second >= 0) now_.emplace_back(touch.first, touch.second);
  std::sort(now_.begin(), now_.end());
  now_.erase(std::unique(now_.begin(), now_.end()), now_.end());
  for (const auto& pair : now_)
    if (!std::binary_search(touching_.begin(), touching_.end(), pair)) ++collisions_;
  std::swap(touching_, now_);
}

void BoxObserver::sample(double time, const Look& look) {
  // The first look, as a rule at the end of the discarded periods, only starts the count.
  if (std::isfinite(collisions_before_)) {
    series_.time.push_back(time);
    series_.height.push_back(look[0]);
    series_.kinetic_energy.push_back(look[1]);
    series_.rotational_energy.push_back(look[2]);
    series_.collision_rate.push_back((look[3] - collisions_before_) / sampling_.interval);
  }
  collisions_before_ = look[3];
  ++next_;
}

void BoxObserver::take(double time, const Frame& frame) {
  assert(frame.bodies.size() == scene_->bodies.size());
  count_collisions(frame);
  const Look look = look_at(frame);
  const double slack = kOnTime * sampling_.interval;
  while (true) {
    const double at = static_cast<double>(next_) * sampling_.interval;
    if (time < at - slack) break;
    if (time <= at + slack) {
      sample(at, look);
      continue;
    }
    // A run that starts after a phase zero begins with the next.
    if (!began_) {
      ++next_;
      continue;
    }
    const double part = (at - time_) / (time - time_);
    Look between;
    for (std::size_t k = 0; k < look.size(); ++k)
      between[k] = look_[k] + part * (look[k] - look_[k]);
    sample(at, between);
  }
  began_ = true;
  time_ = time;
  look_ = look;
}

BoxObservables BoxObserver::finish() const {
  const std::array<std::vector<double>, 3> judged = {series_.height, series_.kinetic_energy,
                                                     series_.rotational_energy};
  std::size_t dropped = 0;
  BoxObservables result;
  if (sampling_.until_steady) {
    const SteadyState state = steady_state(judged);
    dropped = state.dropped;
    result.steady = state.reached;
  } else {
    result.steady =
        std::all_of(judged.begin(), judged.end(), [](const auto& s) { return is_steady(s); });
  }
  const auto mean = [&](const std::vector<double>& values) {
    return blocked_mean(std::span(values).subspan(dropped));
  };
  result.height = mean(series_.height);
  result.kinetic_energy = mean(series_.kinetic_energy);
  result.rotational_energy = mean(series_.rotational_energy);
  result.collision_rate = mean(series_.collision_rate);
  result.samples = series_.time.size() - dropped;
  const std::size_t seen = next_ - series_.time.size();
  const std::size_t first = std::max(seen, sampling_.discard * sampling_.per_period + 1) - 1;
  result.discarded = (first + dropped) / sampling_.per_period;
  return result;
}

}  // namespace slipcheck
