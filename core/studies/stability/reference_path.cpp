#include "studies/stability/reference_path.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "physics/numbers.h"
#include "reference/initial_contacts.h"
#include "reference/overlaps.h"
#include "scenario/observable_key.h"
#include "studies/stability/scene_energy.h"

namespace slipcheck {
namespace {

/// Of the scene's speed; what an integration leaves in a body that rests.
constexpr double kAtRest = 1e-8;
/// So often an oscillation is looked at in a period: cos(π/32) = 0.995 of its top is seen at least.
constexpr double kPerPeriod = 32;
constexpr double kMostSamples = 8192;
/// For the energy scale where there is neither motion nor gravity [m/s²].
constexpr double kSomeGravity = 9.80665;

std::size_t samples_of(const SubstrateMotion& motion, double end, std::size_t least) {
  if (motion.kind() != SubstrateMotion::Kind::oscillation) return least;
  const double wanted = std::ceil(kPerPeriod * motion.frequency() * end);
  return std::max(least, static_cast<std::size_t>(std::min(wanted, kMostSamples)));
}

/// The energies of a run's states, taken in any order.
struct EnergySeries final : FrameSink {
  EnergySeries(const ContactScene& looked_at, double slowest) : scene(&looked_at), slow(slowest) {}

  void take(double time, const Frame& frame) override { add(time, frame.bodies); }
  void add(double time, std::span<const BodyState> states) {
    const double moving = kinetic_energy(scene->hard, states);
    const double potential = potential_energy(scene->hard, states);
    energies.emplace_back(time, moving + potential + elastic_energy(*scene, states));
    kinetic = std::max(kinetic, moving);
    lowest_potential = std::min(lowest_potential, potential);
    highest_potential = std::max(highest_potential, potential);
    for (std::size_t i = 0; i < states.size(); ++i)
      moves |= std::max(states[i].velocity.norm(),
                        scene->hard.bodies[i].radius * states[i].angular_velocity.norm()) > slow;
  }
  /// By time; frames of one time stay in their order.
  void sort() { std::ranges::stable_sort(energies, {}, &std::pair<double, double>::first); }

  const ContactScene* scene;
  double slow;  ///< what is not faster does not move [m/s]
  bool moves = false;
  double kinetic = 0, lowest_potential = kNever, highest_potential = -kNever;  ///< [J]
  std::vector<std::pair<double, double>> energies;                             ///< ([s], [J])
};

}  // namespace

ReferencePath::ReferencePath(const PreparedScene& scene, std::size_t samples)
    : prepared_(&scene), scene_(&scene.solver.scene()) {
  const Scene& hard = scene_->hard;
  speed_scale_ = speed_scale(*scene_);
  times_ = {0};
  states_ = {hard.initial};
  const ReferenceSolver& solver = scene.solver;
  const double end = scene.reference.run.end_time;
  if (end > 0 && std::isfinite(end)) {
    const std::size_t count = samples_of(hard.motion, end, samples);
    std::vector<double> times;
    for (std::size_t k = 1; k <= count; ++k)
      times.push_back(end * (static_cast<double>(k) / static_cast<double>(count)));
    for (auto& states : solver.states_along(times)) states_.push_back(std::move(states));
    times.resize(states_.size() - 1);
    times_.insert(times_.end(), times.begin(), times.end());
  }
  look_at_energies(solver);
  look_at_rests();
  look_at_contacts();
}

double ReferencePath::fastest(double time) const {
  return speed_scale_ + scene_->hard.gravity * time;
}

double ReferencePath::overlap(int first, int second) const {
  const auto found = overlaps_.find({first, second});
  return found == overlaps_.end() ? 0 : found->second;
}

void ReferencePath::look_at_energies(const ReferenceSolver& solver) {
  const Scene& hard = scene_->hard;
  EnergySeries series(*scene_, kAtRest * speed_scale_);
  for (std::size_t k = 0; k < times_.size(); ++k) series.add(times_[k], states_[k]);
  if (!hard.motion.is_still() && end() > 0) solver.run(until_time(end()), &series);
  series.sort();

  double lowest = kNever, highest = -kNever;
  for (const auto& [time, energy] : series.energies) {
    lowest = std::min(lowest, energy);
    highest = std::max(highest, energy);
    energy_rise_ = std::max(energy_rise_, energy - lowest);
  }
  energy_range_ = highest - lowest;
  energy_scale_ = std::max(series.kinetic, series.highest_potential - series.lowest_potential);
  if (series.moves && energy_scale_ > 0) return;
  energy_scale_ = 0;
  const double gravity = std::hypot(hard.gravity, hard.downhill.norm());
  for (const Sphere& sphere : hard.bodies)
    energy_scale_ += sphere.mass * sphere.radius * (gravity > 0 ? gravity : kSomeGravity);
}

void ReferencePath::look_at_rests() {
  rests_from_.assign(scene_->hard.bodies.size(), kNever);
  for (std::size_t i = 0; i < rests_from_.size(); ++i)
    for (std::size_t k = times_.size(); k-- > 0;) {
      const Vector3 over = states_[k][i].velocity - scene_->hard.motion.velocity(times_[k]);
      if (over.norm() > kAtRest * speed_scale_) break;
      rests_from_[i] = times_[k];
    }
}

void ReferencePath::look_at_contacts() {
  // Of hard contacts only rounding would be seen.
  if (scene_->is_hard()) return;
  const auto& bodies = scene_->hard.bodies;
  const std::vector<std::string> names = body_names(prepared_->scenario);
  const auto& seen = prepared_->reference.observables;
  for (int j = 1; j < static_cast<int>(bodies.size()); ++j)
    for (int i = 0; i < j; ++i) {
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      double deepest = 0;
      // A contact may be over between two samples.
      const std::string pair = pair_owner(names[a], names[b]);
      if (const auto found = seen.find(ObservableKey{pair, "max_overlap"}.text());
          found != seen.end())
        deepest = found->second.value;
      if (const auto found = seen.find(ObservableKey{pair, "contact_time"}.text());
          found != seen.end())
        longest_contact_ = std::max(longest_contact_, found->second.value);
      const double reach = bodies[a].radius + bodies[b].radius;
      for (const auto& states : states_)
        deepest = std::max(deepest, reach - (states[a].position - states[b].position).norm());
      if (deepest > 0) overlaps_[{i, j}] = deepest;
    }
}

}  // namespace slipcheck
