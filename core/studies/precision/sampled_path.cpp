#include "studies/precision/sampled_path.h"

#include <algorithm>

namespace slipcheck {
namespace {

constexpr std::size_t kPathPoints = 512;

}  // namespace

TravelledPath travelled_path(const ReferenceSolver& solver, const ReferenceResult& reference) {
  TravelledPath path;
  path.times = sample_times(reference.run.end_time, kPathPoints);
  for (const auto& states : solver.states_along(path.times))
    path.centres.push_back(centres_of(states));
  std::vector<Centres> whole = {centres_of(solver.scene().hard.initial)};
  whole.insert(whole.end(), path.centres.begin(), path.centres.end());
  path.length = longest_path(whole);
  return path;
}

double largest_distance(std::span<const Centres> found, std::span<const Centres> expected) {
  if (found.size() < expected.size()) return kNotObserved;
  double largest = 0;
  for (std::size_t k = 0; k < expected.size(); ++k)
    for (std::size_t i = 0; i < expected[k].size(); ++i)
      largest = std::max(largest, (found[k][i] - expected[k][i]).norm());
  return largest;
}

void SampledPath::take(double time, const Frame& frame) {
  if (next_) next_->take(time, frame);
  while (centres.size() < times_.size() && times_[centres.size()] <= time)
    centres.push_back(between(times_[centres.size()], time, frame.bodies));
  before_ = time;
  last_ = frame.bodies;
}

Centres SampledPath::between(double wanted, double time, const std::vector<BodyState>& now) const {
  if (last_.empty() || !(time > before_)) return centres_of(now);
  const double h = time - before_, s = (wanted - before_) / h, r = 1 - s;
  Centres found;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const BodyState &a = last_[i], &b = now[i];
    found.push_back((1 + 2 * s) * r * r * a.position + s * s * (3 - 2 * s) * b.position +
                    h * (s * r * r * a.velocity - s * s * r * b.velocity));
  }
  return found;
}

}  // namespace slipcheck
