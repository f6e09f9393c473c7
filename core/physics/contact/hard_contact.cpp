#include "physics/contact/hard_contact.h"

namespace slipcheck {

FrictionLaw with_speeds_times(const FrictionLaw& law, double factor) {
  if (const auto* table = std::get_if<TabulatedFriction>(&law)) {
    std::vector<TabulatedFriction::Point> points = table->points();
    for (auto& point : points) point.speed *= factor;
    return TabulatedFriction(std::move(points));
  }
  FrictionLaw made = law;
  if (auto* falling = std::get_if<ExponentialFriction>(&made)) falling->c /= factor;
  return made;
}

}  // namespace slipcheck
