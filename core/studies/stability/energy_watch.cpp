#include "studies/stability/energy_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "reference/overlaps.h"
#include "studies/stability/scene_energy.h"

namespace slipcheck {
namespace {

/// A contact that has lasted longer is one in which bodies rest on each other [frames].
constexpr std::size_t kYoung = 16;
constexpr double kMostYoung = 1e6;

/// An engine with the reference's own soft contacts may have each as long as there, and a half
/// more.
std::size_t young_frames(const ReferencePath& path, double step) {
  const double soft = 1.5 * path.longest_contact() / step;
  return std::max(kYoung, static_cast<std::size_t>(std::min(soft, kMostYoung)));
}

}  // namespace

EnergyWatch::EnergyWatch(const ReferencePath& path, const OutcomeCriteria& criteria, double step,
                         bool soft)
    : path_(&path),
      criteria_(criteria),
      step_(step),
      soft_(soft),
      conserved_(path.energy_range() <= criteria.conserved * path.energy_scale()),
      young_(young_frames(path, step)) {
  for (const Sphere& sphere : path.scene().hard.bodies)
    slack_.push_back(criteria.creep * sphere.radius);
}

void EnergyWatch::begin(double, std::span<const BodyState> states) {
  EnergyRange range = shown_energy(path_->scene().hard, states, step_, slack_);
  const double elastic = elastic_energy(path_->scene(), states);
  allowed_ = path_->energy_rise() + (soft_ ? 0 : elastic);
  lowest_ = range.high + (soft_ ? elastic : 0);
  highest_ = range.low + (soft_ ? elastic : 0);
  gain_ = loss_ = grows_at_ = falls_at_ = 0;
  // What lies on the plane at the start has done so for long.
  ages_.clear();
  const auto& bodies = path_->scene().hard.bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (states[i].position.z() <= bodies[i].radius + slack_[i])
      ages_[{static_cast<int>(i), kSubstrate}] = young_;
}

bool EnergyWatch::holds_energy(const Frame& frame) {
  std::map<std::pair<int, int>, std::size_t> ages;
  bool young = false;
  for (const Touch& touch : frame.touches) {
    const std::pair<int, int> pair(touch.first, touch.second);
    const auto before = ages_.find(pair);
    const std::size_t age = before == ages_.end() ? 0 : before->second + 1;
    young |= age < young_;
    ages[pair] = age;
  }
  ages_ = std::move(ages);
  return young;
}

void EnergyWatch::take(double time, const Frame& frame) {
  const Scene& hard = path_->scene().hard;
  const std::vector<BodyState>& states = frame.bodies;
  const bool holds = !soft_ && holds_energy(frame);
  // A moving substrate goes on doing work after the end of what the reference knows.
  if (!hard.motion.is_still() && time > path_->end()) return;
  EnergyRange range = shown_energy(hard, states, step_, slack_);
  if (soft_) {
    const double elastic = elastic_energy(path_->scene(), states);
    range.low += elastic;
    range.high += elastic;
  }
  if (!holds) lowest_ = std::min(lowest_, range.high);
  highest_ = std::max(highest_, range.low);
  const double scale = path_->energy_scale();
  const bool grew = gain_ > criteria_.energy, fell = loss_ > criteria_.energy;
  gain_ = std::max(gain_, (range.low - lowest_ - allowed_) / scale);
  if (conserved_ && !holds) loss_ = std::max(loss_, (highest_ - range.high) / scale);
  if (!grew && gain_ > criteria_.energy) grows_at_ = time;
  if (!fell && loss_ > criteria_.energy) falls_at_ = time;
}

PhaseOutcome EnergyWatch::outcome() const {
  if (gain_ > criteria_.energy)
    return {Outcome::energy_growing,
            fmt::format("gains {:.3g} % of the scene's energy out of nothing", 100 * gain_),
            grows_at_};
  if (loss_ > criteria_.energy)
    return {Outcome::drifting,
            fmt::format("loses {:.3g} % of an energy that the reference keeps", 100 * loss_),
            falls_at_};
  return {};
}

}  // namespace slipcheck
