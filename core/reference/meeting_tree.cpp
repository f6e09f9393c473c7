#include "reference/meeting_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "physics/numbers.h"

namespace slipcheck {
namespace {

constexpr std::uint32_t kFew = 8;
/// A horizon is so many times the one before, until there have been so many.
constexpr double kFurther = 8;
constexpr int kHorizons = 24;
/// Of the sum of two radii, more than rounding takes.
constexpr double kSlack = 1 + 1e-9;

/// Leaves of the times [from, to] those at which place + velocity t <= bound.
void keep_below(double place, double velocity, double bound, double& from, double& to) {
  const double left = bound - place;
  if (velocity > 0)
    to = std::min(to, left / velocity);
  else if (velocity < 0)
    from = std::max(from, left / velocity);
  else if (left < 0)
    to = -1;
}

}  // namespace

MeetingTree::MeetingTree(std::span<const StraightSphere> spheres, bool may_stop)
    : order_(spheres.size()) {
  if (spheres.empty()) return;
  std::iota(order_.begin(), order_.end(), 0);
  boxes_.reserve(2 * spheres.size() / kFew + 1);
  add(spheres, may_stop, 0, static_cast<std::uint32_t>(spheres.size()));
  double fastest = 0;
  for (const StraightSphere& each : spheres) fastest = std::max(fastest, each.velocity.norm());
  const Vector3 lengths = boxes_[0].high - boxes_[0].low;
  const double spacing = std::max(
      std::sqrt(lengths.x() * lengths.y() / static_cast<double>(spheres.size())), boxes_[0].radius);
  first_look_ = spacing / fastest;
}

std::uint32_t MeetingTree::add(std::span<const StraightSphere> spheres, bool may_stop,
                               std::uint32_t begin, std::uint32_t end) {
  Box box;
  box.begin = begin;
  box.end = end;
  box.low = box.slowest = Vector3::Constant(kNever);
  box.high = box.fastest = -box.low;
  for (std::uint32_t k = begin; k < end; ++k) {
    const StraightSphere& each = spheres[order_[k]];
    box.low = box.low.cwiseMin(each.position);
    box.high = box.high.cwiseMax(each.position);
    box.slowest = box.slowest.cwiseMin(each.velocity);
    box.fastest = box.fastest.cwiseMax(each.velocity);
    box.radius = std::max(box.radius, each.radius);
  }
  if (may_stop) {
    box.slowest = box.slowest.cwiseMin(Vector3::Zero());
    box.fastest = box.fastest.cwiseMax(Vector3::Zero());
  }
  const auto place = static_cast<std::uint32_t>(boxes_.size());
  boxes_.push_back(box);
  if (end - begin <= kFew) return place;
  int widest = 0;
  (box.high - box.low).maxCoeff(&widest);
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::uint32_t i, std::uint32_t j) {
                     return spheres[i].position[widest] < spheres[j].position[widest];
                   });
  const std::uint32_t left = add(spheres, may_stop, begin, middle);
  const std::uint32_t right = add(spheres, may_stop, middle, end);
  boxes_[place].left = left;
  boxes_[place].right = right;
  return place;
}

bool MeetingTree::may_meet(const Box& a, const Box& b, double horizon) {
  const double reach = kSlack * (a.radius + b.radius);
  double from = 0, to = horizon;
  for (int k = 0; k < 3; ++k) {
    keep_below(a.low[k] - b.high[k], a.slowest[k] - b.fastest[k], reach, from, to);
    keep_below(b.low[k] - a.high[k], b.slowest[k] - a.fastest[k], reach, from, to);
    if (from > to) return false;
  }
  return true;
}

/// The horizon comes nearer with each pair that is found.
void MeetingTree::look(std::uint32_t a, std::uint32_t b, const PairTime& time_of,
                       double& horizon) const {
  const Box &one = boxes_[a], &other = boxes_[b];
  if (a != b && !may_meet(one, other, horizon)) return;
  if (one.left == 0 && other.left == 0) {
    for (std::uint32_t k = one.begin; k < one.end; ++k)
      for (std::uint32_t n = a == b ? k + 1 : other.begin; n < other.end; ++n) {
        const auto [i, j] = std::minmax(order_[k], order_[n]);
        horizon = std::min(horizon, time_of(i, j, horizon));
      }
  } else if (a == b) {
    look(one.left, one.left, time_of, horizon);
    look(one.right, one.right, time_of, horizon);
    look(one.left, one.right, time_of, horizon);
  } else if (other.left == 0 || (one.left != 0 && one.end - one.begin > other.end - other.begin)) {
    look(one.left, b, time_of, horizon);
    look(one.right, b, time_of, horizon);
  } else {
    look(a, other.left, time_of, horizon);
    look(a, other.right, time_of, horizon);
  }
}

double MeetingTree::first(double limit, const PairTime& time_of) const {
  if (boxes_.empty()) return kNever;
  double horizon = std::min(first_look_, limit);
  for (int looks = 1;; ++looks) {
    double found = kNever;
    const PairTime noted = [&](std::size_t i, std::size_t j, double within) {
      const double time = time_of(i, j, within);
      found = std::min(found, time);
      return time;
    };
    double nearer = horizon;
    look(0, 0, noted, nearer);
    if (found < kNever || horizon >= limit) return found;
    horizon = looks < kHorizons ? std::min(kFurther * horizon, limit) : limit;
  }
}

}  // namespace slipcheck
