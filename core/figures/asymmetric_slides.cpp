#include "figures/asymmetric_slides.h"

#include <algorithm>
#include <cmath>

#include "figures/columns.h"

namespace slipcheck {
namespace {

std::vector<AsymmetricPoint> computed_points() {
  std::vector<AsymmetricPoint> points;
  for (double v_p : {0.0, 25.0, 50.0})
    for (double v_m = -100; v_m <= -std::max(10.0, v_p); v_m += v_p > 0 ? 12.5 : 10) {
      const auto both = asymmetric_reference(asymmetric_pair(v_m * kCentimetre, v_p * kCentimetre));
      for (const std::size_t k : {0u, 1u})
        if (k == 0 || v_p > 0)
          points.push_back({v_m * kCentimetre, (k == 0 ? v_p : -v_p) * kCentimetre, both[k]});
    }
  std::stable_sort(points.begin(), points.end(),
                   [](const auto& a, const auto& b) { return a.v_p < b.v_p; });
  return points;
}

}  // namespace

SteelPair asymmetric_pair(double v_m, double v_p, double restitution, double rubbing_ratio) {
  // K's j is the sphere from behind.
  SteelPair pair{(v_p - v_m) / 2, (v_p + v_m) / 2, restitution};
  pair.rubbing_ratio = rubbing_ratio;
  return pair;
}

double first_order_share() {
  const LinearContact contact = asymmetric_pair(-0.1, 0).contact();  // the same at all speeds
  return rubbing_constant(steel_sphere().inverse_shape_factor(),
                          kSteel.rubbing_ratio * contact.damping_rate(),
                          contact.contact_frequency());
}

AsymmetricSlide asymmetric_closed_form(double v_m, double v_p) {
  const SteelPair pair = asymmetric_pair(v_m, v_p);
  const double A = steel_sphere().inverse_shape_factor();
  const HeadOnCollision rule{A, pair.restitution, first_order_share()};
  const double v_i = (v_m + v_p) / 2, v_j = (v_p - v_m) / 2;
  const double after = rule.velocity_after(v_i, v_j), rolling = rule.rolling_velocity(v_i, v_j);
  const double time = std::abs(rule.slip_after(v_i, v_j)) /
                      ((1 + rule.A) * kSteel.kinetic_friction * kSteel.gravity);
  return {time, (after + rolling) * time / 2, after * after - rolling * rolling, after - rolling};
}

std::array<AsymmetricSlide, 2> asymmetric_reference(const SteelPair& pair) {
  const ReferenceResult seen = pair.solve();
  const auto of = [&](const std::string& body, double outwards) {
    const auto value = [&](const char* name) { return value_of(seen, body + "." + name); };
    const double sum = value("velocity_after_collision.x") + value("rolling_velocity.x");
    return AsymmetricSlide{value("sliding_time"),
                           std::copysign(value("sliding_distance"), outwards * sum),
                           value("energy_change_sliding"), value("momentum_change_sliding")};
  };
  return {of("j", 1), of("i", -1)};
}

const std::vector<AsymmetricPoint>& asymmetric_points() {
  static const std::vector<AsymmetricPoint> points = computed_points();
  return points;
}

}  // namespace slipcheck
