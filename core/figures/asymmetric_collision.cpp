#include "figures/asymmetric_collision.h"

#include "figures/columns.h"

namespace slipcheck {
namespace {

/// The corrected closed forms with a given share of the spins exchanged.
std::array<AfterCollision, 2> after(const SteelPair& pair, double spin_exchange) {
  const Sphere sphere = steel_sphere();
  const HeadOnCollision rule{sphere.inverse_shape_factor(), pair.restitution, spin_exchange};
  std::array<AfterCollision, 2> result;
  for (const std::size_t k : {0u, 1u}) {
    const double own = k == 0 ? pair.v_i : pair.v_j, other = k == 0 ? pair.v_j : pair.v_i;
    AfterCollision& a = result[k];
    a.velocity = rule.velocity_after(own, other);
    a.surface_velocity = rule.surface_velocity_after(own, other);
    const SlideToRoll slide(sphere, kSteel.kinetic_friction, kSteel.gravity, {a.velocity, 0, 0},
                            {0, a.surface_velocity / sphere.radius, 0});
    a.slip = slide.slip.x();
    a.sliding_time = slide.sliding_time;
    a.sliding_distance = slide.displacement.x();
    a.rolling_velocity = slide.rolling_velocity.x();
    a.energy_change = slide.energy_change;
    a.momentum_change = slide.momentum_change.x();
  }
  return result;
}

void append(AsymmetricCollisions::Course& course, const std::array<AfterCollision, 2>& both) {
  for (const std::size_t k : {0u, 1u}) course[k].push_back(both[k]);
}

AsymmetricCollisions computed() {
  AsymmetricCollisions all;
  all.ratio = equally_spaced(-1, 0.95, 40);
  const auto pair_at = [](double ratio) {
    return SteelPair{AsymmetricCollisions::kFirstSpeed, ratio * AsymmetricCollisions::kFirstSpeed};
  };
  // They depend on the contact alone.
  const PairInsight any = pair_at(0).insight();
  all.constant = any.rubbing_constant;
  all.share = any.exponential_share;
  for (double ratio : all.ratio) {
    SteelPair pair = pair_at(ratio);
    append(all.without_rubbing, after(pair, 0));
    append(all.first_order, after(pair, all.constant));
    append(all.exponential, after(pair, all.share));
    append(all.capped, pair.insight().after);
    all.held.push_back(pair.solve());
    pair.confined = false;
    append(all.capped_free, pair.insight().after);
    all.free.push_back(pair.solve());
  }
  return all;
}

}  // namespace

const AsymmetricCollisions& asymmetric_collisions() {
  static const AsymmetricCollisions all = computed();
  return all;
}

}  // namespace slipcheck
