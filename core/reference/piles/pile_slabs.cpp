#include "reference/piles/pile_slabs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <tuple>

#include "physics/numbers.h"
#include "reference/space_curve.h"

namespace slipcheck {
namespace {

/// Of the smallest radius, the gap up to which few bodies are looked at for a contact.
constexpr double kSkin = 0.1;
/// Searches from one sorting of the bodies to the next.
constexpr std::uint64_t kSearches = 16;
/// Bodies of a slab, at least, and slabs at most.
constexpr std::size_t kLeastInSlab = 256, kMostSlabs = 64;
/// Bodies that one thread looks at in a row.
constexpr std::size_t kShare = 2048;

/// Bodies along one direction, in cells of one width.
struct CellsAlong {
  int axis = 0;
  double low = 0, width = 1;
  std::size_t count = 1;
  bool repeats = false;

  std::size_t cell_of(const Vector3& folded) const {
    const double cell = (folded[axis] - low) / width;
    return cell > 0 ? std::min(static_cast<std::size_t>(cell), count - 1) : 0;
  }
};

/// In the direction that has most of them; at least `reach` [m] wide.
CellsAlong longest_row(std::span<const PileBody> bodies, const Vector2& periodic, double reach) {
  constexpr double kMost = 1 << 16;
  Vector3 low = bodies[0].position, high = low;
  for (const PileBody& b : bodies) {
    low = low.cwiseMin(b.position);
    high = high.cwiseMax(b.position);
  }
  CellsAlong longest;
  for (int k = 2; k >= 0; --k) {
    const bool repeats = k < 2 && periodic[k] > 0;
    const double length = repeats ? periodic[k] : high[k] - low[k];
    const double count = std::clamp(std::floor(length / ((1 + 1e-9) * reach)), 1.0, kMost);
    if (!(count > static_cast<double>(longest.count))) continue;
    longest = {k, repeats ? 0 : low[k], length / count, static_cast<std::size_t>(count), repeats};
  }
  return longest;
}

struct NearSurface {
  std::uint32_t body;
  int surface;
};

}  // namespace

void PileSlabs::sort_bodies(PileWorld& world) {
  PileBodies& bodies = world.bodies;
  const std::vector<std::uint64_t> curve =
      on_space_curve(bodies, world.scene->hard.periodic, 2 * largest_radius_);
  std::vector<std::uint32_t> slab_of;
  share_out(world, slab_of);
  std::vector<std::tuple<std::uint32_t, std::uint64_t, std::uint32_t>> keys(bodies.size());
  for (std::uint32_t p = 0; p < bodies.size(); ++p) keys[p] = {slab_of[p], curve[p], p};
  std::ranges::sort(keys);
  PileBodies sorted;
  sorted.reserve(bodies.size());
  std::vector<std::uint32_t> numbers(bodies.size());
  for (std::uint32_t p = 0; p < bodies.size(); ++p) {
    sorted.push_back(bodies[std::get<2>(keys[p])]);
    numbers[p] = bodies_[std::get<2>(keys[p])];
    world.place[numbers[p]] = p;
  }
  bodies = std::move(sorted);
  bodies_ = std::move(numbers);
}

void PileSlabs::share_out(const PileWorld& world, std::vector<std::uint32_t>& slab_of) {
  const PileBodies& bodies = world.bodies;
  slab_of.assign(bodies.size(), 0);
  lists_.assign(1, {});
  is_around_ = false;
  if (!is_ordered(world)) return;
  const Vector2& periodic = world.scene->hard.periodic;
  const CellsAlong row = longest_row(bodies, periodic, 2 * (largest_radius_ + skin_));
  std::vector<std::uint32_t> cell(bodies.size());
  std::vector<std::size_t> in_cell(row.count);
  for (std::size_t p = 0; p < bodies.size(); ++p) {
    cell[p] = static_cast<std::uint32_t>(
        row.cell_of(row.repeats ? in_period(bodies[p].position, periodic) : bodies[p].position));
    ++in_cell[cell[p]];
  }
  const std::size_t enough = std::max(kLeastInSlab, bodies.size() / kMostSlabs);
  std::vector<std::uint32_t> slab(row.count);
  std::uint32_t last = 0;
  for (std::size_t k = 0, held = 0; k < row.count; ++k) {
    if (held >= enough) {
      ++last;
      held = 0;
    }
    slab[k] = last;
    held += in_cell[k];
  }
  // Around a period the last slab is the first one's neighbour: it must be an odd one.
  if (row.repeats && last % 2 == 0 && last > 0) {
    --last;
    for (std::uint32_t& each : slab) each = std::min(each, last);
  }
  for (std::size_t p = 0; p < bodies.size(); ++p) slab_of[p] = slab[cell[p]];
  lists_.assign(last + 1, {});
  is_around_ = row.repeats && lists_.size() > 2;
}

void PileSlabs::find_members(const PileWorld& world, std::span<const std::uint32_t> slab_of) {
  begins_.assign(lists_.size() + 1, 0);
  for (const std::uint32_t slab : slab_of) ++begins_[slab + 1];
  std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
  members_.resize(slab_of.size());
  drifts_.assign(lists_.size(), Vector3::Zero());
  std::vector<std::uint32_t> next = begins_;
  for (std::uint32_t p = 0; p < slab_of.size(); ++p) {
    members_[next[slab_of[p]]++] = p;
    drifts_[slab_of[p]] += world.bodies[p].velocity;
  }
  for (std::size_t s = 0; s < drifts_.size(); ++s)
    drifts_[s] /= std::max<double>(1, static_cast<double>(members(s).size()));
}

void PileSlabs::find(PileWorld& world, PileLawTable& laws, double approach) {
  const std::size_t n = world.bodies.size();
  const Scene& scene = world.scene->hard;
  if (bodies_.empty()) {
    bodies_.resize(n);
    for (std::uint32_t i = 0; i < n; ++i) bodies_[world.place[i]] = i;
  }
  double smallest = kNever, mean = 0, fastest2 = 0;
  largest_radius_ = 0;
  for (const PileBody& b : world.bodies) {
    smallest = std::min(smallest, b.radius);
    largest_radius_ = std::max(largest_radius_, b.radius);
    mean += b.radius / static_cast<double>(n);
    fastest2 = std::max(fastest2, b.velocity.squaredNorm());
  }
  const double speed = approach > 0 ? 0.5 * approach : std::sqrt(fastest2);
  skin_ = is_ordered(world) ? near_skin(speed, world.step, mean) : kSkin * smallest;
  if (is_ordered(world) && searches_++ % kSearches == 0) sort_bodies(world);
  surfaces_speed_ = turning_speed_ = 0;
  for (const Surface& surface : scene.surfaces) {
    if (!surface.motion.is_belt())
      surfaces_speed_ = std::max(surfaces_speed_, surface.motion.course().largest_speed());
    if (!turns(surface)) continue;
    for (const PileBody& b : world.bodies)
      turning_speed_ =
          std::max(turning_speed_, surface.motion.velocity(world.time(), b.position).norm());
  }

  spheres_.resize(n);
  for (std::size_t p = 0; p < n; ++p)
    spheres_[p] = {world.bodies[p].position, world.bodies[p].radius};
  const std::vector<NearPair> pairs = near_pairs(spheres_, skin_, scene.periodic, world.team);

  std::vector<std::vector<NearSurface>> by_share((n + kShare - 1) / kShare);
  const auto look_at_surfaces = [&](std::size_t share) {
    const auto last = static_cast<std::uint32_t>(std::min(n, (share + 1) * kShare));
    for (auto p = static_cast<std::uint32_t>(share * kShare); p < last; ++p) {
      const NearSphere& b = spheres_[p];
      // In the order of Touch::second: the last surface is the lowest number.
      for (std::size_t k = scene.surfaces.size(); k-- > 0;) {
        const Surface& surface = scene.surfaces[k];
        if (turns(surface) ||
            surface.nearest(world.time(), b.position).distance - b.radius <= skin_)
          by_share[share].push_back({p, surface_touch(k)});
      }
      if (scene.has_substrate && b.position.z() - b.radius <= skin_)
        by_share[share].push_back({p, kSubstrate});
    }
  };
  run_each(world.team, by_share.size(), look_at_surfaces);

  std::vector<std::uint32_t> slab_of;
  share_out(world, slab_of);
  find_members(world, slab_of);
  laws.renew(pairs.size() + n);
  const auto slabs = static_cast<std::uint32_t>(lists_.size());
  auto pair = pairs.begin();
  const auto take_pairs_before = [&](std::uint32_t p) {
    for (; pair != pairs.end() && pair->first < p; ++pair) {
      auto [a, b] = *pair;
      const std::uint32_t s = slab_of[a], t = slab_of[b];
      const bool is_around = is_around_ && s + t == slabs - 1 && (s == 0 || t == 0);
      // The first is the one that comes first in the scene, however the bodies are sorted.
      if (bodies_[a] > bodies_[b]) std::swap(a, b);
      PileNear near{a, static_cast<int>(b)};
      near.law = laws.number(bodies_[a], static_cast<int>(bodies_[b]));
      const auto across = [&](int k) {
        if (!(scene.periodic[k] > 0)) return std::int32_t{0};
        const double apart = spheres_[a].position[k] - spheres_[b].position[k];
        return static_cast<std::int32_t>(std::round(apart / scene.periodic[k]));
      };
      near.across_x = across(0);
      near.across_y = across(1);
      lists_[is_around ? slabs - 1 : std::min(s, t)].push_back(near);
    }
  };
  for (const std::vector<NearSurface>& share : by_share)
    for (const auto& [p, surface] : share) {
      take_pairs_before(p);
      PileNear near{p, surface};
      near.law = laws.number(bodies_[p], surface);
      lists_[slab_of[p]].push_back(near);
    }
  take_pairs_before(static_cast<std::uint32_t>(n));
}

}  // namespace slipcheck
