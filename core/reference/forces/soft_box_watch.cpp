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
    const auto watch = [&](What what) {
      Item item{what, c};
      item.low = value(item, touch, now.forces[c], state.bends[c]);
      if (item.is_corner() && item.low < 0) {
        item.low = -item.low;
        item.turn = -1;
      }
      item.can_be_found = item.low > 0;
      items.push_back(item);
    };
    watch(What::end);
    if (touch.law->end == ContactEnd::zero_force) watch(What::force);
    if (!touch.pushes || std::holds_alternative<NoTangentialForce>(touch.law->tangential)) continue;
    if (touch.law->end == ContactEnd::zero_overlap) watch(What::sign);
    if (const auto* asperity = std::get_if<AsperityForce>(&touch.law->tangential)) {
      watch(What::asperity);
      if (asperity->form == AsperityForce::Form::passive)
        watch(What::growth);
      else if (touch.broken > 0)
        watch(What::back);
    } else {
      watch(What::cap);
    }
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
    case What::growth: {
      const double growth = SoftBoxDynamics::force_growth(touch, f);
      return touch.growing ? growth : -growth;
    }
    case What::asperity: {
      const auto& law = std::get<AsperityForce>(touch.law->tangential);
      if (law.form == AsperityForce::Form::printed)
        return touch.broken + 1 - std::abs(bend) / law.size;
      return touch.growing ? f.normal * law.size - std::abs(bend) : law.size - std::abs(bend);
    }
    case What::back: {
      const auto& law = std::get<AsperityForce>(touch.law->tangential);
      return std::abs(bend) / law.size - touch.broken;
    }
    case What::cap: {
      const auto& law = std::get<ViscousForce>(touch.law->tangential);
      return item.turn * (law.viscous(std::abs(f.at.slip)) - law.cap(f.normal));
    }
    case What::sign:
      return item.turn * f.normal;
    case What::begin:
      break;
  }
  return 1;
}

void SoftBoxWatch::look(const SoftBoxDynamics& dynamics, const SoftBoxDynamics::State& state,
                        const SoftBoxDynamics::Rates& then) {
  for (Item& item : items)
    if (item.what != What::begin)
      item.now = value(item, dynamics.touches[item.index], then.forces[item.index],
                       state.bends[item.index]);
}

}  // namespace slipcheck
