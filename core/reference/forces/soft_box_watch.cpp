#include "reference/forces/soft_box_watch.h"

#include <algorithm>
#include <cmath>
#include <variant>

namespace slipcheck {

void SoftBoxWatch::begin(const SoftBoxDynamics& dynamics, const SoftBoxDynamics::State& state,
                         const SoftBoxDynamics::Rates& now) {
  items.clear();
  for (std::size_t c = 0; c < dynamics.touches.size(); ++c) {
    const SoftTouch& touch = dynamics.touches[c];
    const auto watch = [&](Item item) {
      item.low = item.turn * value(item, touch, now.forces[c], state.bends[c]);
      if (item.is_corner && item.low < 0) {
        item.low = -item.low;
        item.turn = -1;
      }
      item.can_be_found = item.low > 0;
      items.push_back(item);
    };
    watch({.what = What::end, .index = c});
    if (touch.law->end == ContactEnd::zero_force) watch({.what = What::force, .index = c});
    if (!touch.pushes) continue;
    const bool viscous = std::holds_alternative<ViscousForce>(touch.law->tangential);
    for_each_edge(
        touch.law->tangential, touch.branch, touch.law->end,
        [&](TangentialEdge edge, int direction) {
          const double turn = direction > 0 ? -1 : direction < 0 ? 1 : touch.branch.force_sign;
          watch({.what = What::edge, .index = c, .turn = turn, .edge = edge, .is_corner = viscous});
        });
  }
}

double SoftBoxWatch::value(const Item& item, const SoftTouch& touch,
                           const SoftBoxDynamics::Forces& f, double bend) {
  switch (item.what) {
    case What::end:
      // A touch may begin a rounding error before the overlap does.
      return f.at.closing < 0 ? f.at.overlap : std::max(f.at.overlap, 1e-300);
    case What::force:
      return touch.pushes ? f.normal : -f.normal;
    case What::edge: {
      const double growth =
          item.edge == TangentialEdge::growth
              ? force_growth(touch.law->normal, f.at.overlap, f.at.closing, f.closing_rate)
              : 0;
      return edge_value(item.edge, touch.law->tangential, touch.branch, f.normal, growth,
                        std::abs(f.at.slip), std::abs(bend));
    }
    case What::begin:
      break;
  }
  return 1;
}

void SoftBoxWatch::look(const SoftBoxDynamics& dynamics, const SoftBoxDynamics::State& state,
                        const SoftBoxDynamics::Rates& then) {
  for (Item& item : items)
    if (item.what != What::begin)
      item.now = item.turn * value(item, dynamics.touches[item.index], then.forces[item.index],
                                   state.bends[item.index]);
}

}  // namespace slipcheck
