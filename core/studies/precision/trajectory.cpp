#include "studies/precision/trajectory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "harness/compare/comparison.h"

namespace slipcheck {
namespace {

constexpr std::size_t kMostSamples = 32;

}  // namespace

std::vector<double> sample_times(double end, std::size_t count) {
  std::vector<double> times;
  for (std::size_t k = 1; k <= count; ++k)
    times.push_back(end * static_cast<double>(k) / static_cast<double>(count));
  return times;
}

Centres centres_of(std::span<const BodyState> states) {
  Centres centres;
  for (const BodyState& state : states) centres.push_back(state.position);
  return centres;
}

TrajectorySamples trajectory_samples(const ReferenceSolver& solver, double end, double step,
                                     std::span<const double> starts) {
  TrajectorySamples samples;
  // A run that starts late in its step has one step less before the end.
  const auto fitting = std::max(1.0, std::floor(end / step) - 1);
  const auto count = static_cast<std::size_t>(std::min<double>(kMostSamples, fitting));
  for (std::size_t k = 1; k <= count; ++k)
    samples.steps.push_back(static_cast<std::size_t>(
        std::round(fitting * static_cast<double>(k) / static_cast<double>(count))));

  // One walk in the order of time for all phases.
  struct Place {
    double time;
    std::size_t phase, sample;
  };
  std::vector<Place> places;
  for (std::size_t p = 0; p < starts.size(); ++p)
    for (std::size_t k = 0; k < count; ++k)
      places.push_back({starts[p] + static_cast<double>(samples.steps[k]) * step, p, k});
  std::ranges::sort(places, {}, &Place::time);
  std::vector<double> times;
  for (const Place& place : places) times.push_back(place.time);
  const auto states = solver.states_along(times);
  if (states.size() < times.size()) {
    samples.steps.clear();
    samples.reason = fmt::format("the reference has no states after {:.6g} s",
                                 states.empty() ? 0 : times[states.size() - 1]);
    return samples;
  }
  samples.centres.assign(starts.size(), std::vector<Centres>(count));
  for (std::size_t n = 0; n < places.size(); ++n)
    samples.centres[places[n].phase][places[n].sample] = centres_of(states[n]);
  return samples;
}

double longest_path(std::span<const Centres> centres) {
  double longest = 0;
  for (std::size_t i = 0; !centres.empty() && i < centres.front().size(); ++i) {
    double length = 0;
    for (std::size_t k = 1; k < centres.size(); ++k)
      length += (centres[k][i] - centres[k - 1][i]).norm();
    longest = std::max(longest, length);
  }
  return longest;
}

double largest_distance(std::span<const BodyState> states, const Centres& expected) {
  double largest = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const double distance = (states[i].position - expected[i]).norm();
    if (!std::isfinite(distance)) return kNotObserved;
    largest = std::max(largest, distance);
  }
  return largest;
}

PhaseErrors trajectory_errors(std::span<const double> distances, double path_length) {
  PhaseErrors errors;
  errors.absolute = path_length == 0;
  std::vector<double> finite;
  for (const double distance : distances)
    if (std::isfinite(distance))
      finite.push_back(path_length > 0 ? distance / path_length : distance);
  if (finite.size() < distances.size())
    errors.reason = fmt::format("{} of {} phases are not finite", distances.size() - finite.size(),
                                distances.size());
  if (finite.empty()) return errors;
  errors.worst = std::ranges::max(finite);
  errors.rms = root_mean_square(finite);
  errors.median = median(std::move(finite));
  return errors;
}

void TrajectoryWatch::begin(double, std::span<const BodyState>) {
  step_ = next_ = 0;
  distances_.push_back(0);
}

void TrajectoryWatch::take(double, const Frame& frame) {
  if (frame.part != 1) return;
  ++step_;
  if (!wants_more() || step_ != samples_->steps[next_]) return;
  const std::size_t phase = distances_.size() - 1;
  const double distance = largest_distance(frame.bodies, samples_->centres[phase][next_]);
  ++next_;
  // A NaN stays.
  double& largest = distances_.back();
  if (!std::isnan(largest)) largest = std::isnan(distance) ? distance : std::max(largest, distance);
}

}  // namespace slipcheck
