#include "reference/pair/pair_map.h"

#include <algorithm>
#include <cmath>

#include "reference/pair/pair_batch.h"

namespace slipcheck {
namespace {

constexpr int kMapSteps = 256;  // in a collision

}  // namespace

PairMap::PairMap(const SoftContact& contact, const Sphere& sphere, double slowest, double fastest,
                 double per_e_fold)
    : first_(std::log(slowest)), step_(1 / per_e_fold) {
  across_ = 1 + static_cast<std::size_t>(std::ceil((std::log(fastest) - first_) / step_));
  std::vector<double> normal, tangential;
  for (std::size_t i = 0; i < across_; ++i)
    for (std::size_t j = 0; j < across_; ++j) {
      normal.push_back(std::exp(first_ + step_ * static_cast<double>(i)));
      tangential.push_back(std::exp(first_ + step_ * static_cast<double>(j)));
    }
  std::vector<PairCollision> out(normal.size());
  collide_batch(contact, sphere, sphere, normal, tangential, kMapSteps, out);
  for (const PairCollision& each : out)
    table_.push_back({each.normal_restitution, each.tangential_restitution});
}

PairMap::Restitution PairMap::at(double normal_speed, double tangential_speed) const {
  constexpr double kSlowest = 1e-300;
  const auto place = [&](double speed) {
    const double x = (std::log(std::max(speed, kSlowest)) - first_) / step_;
    return std::clamp(x, 0.0, static_cast<double>(across_ - 1) * (1 - 1e-15));
  };
  const double x = place(normal_speed), y = place(tangential_speed);
  const auto i = static_cast<std::size_t>(x), j = static_cast<std::size_t>(y);
  const double r = x - static_cast<double>(i), s = y - static_cast<double>(j);
  const Restitution* here = &table_[i * across_ + j];
  const Restitution* next = here + across_;
  const auto between = [&](double Restitution::*of) {
    return (1 - r) * ((1 - s) * here[0].*of + s * here[1].*of) +
           r * ((1 - s) * next[0].*of + s * next[1].*of);
  };
  return {between(&Restitution::normal), between(&Restitution::tangential)};
}

}  // namespace slipcheck
