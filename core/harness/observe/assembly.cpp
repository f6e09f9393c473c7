#include "harness/observe/assembly.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <variant>

#include "reference/overlaps.h"

namespace slipcheck {
namespace {

/// Of a radius, how far from the substrate a body lies on it.
constexpr double kFlat = 0.02;

Vector3 mean_velocity(const Scene& scene, std::span<const BodyState> states) {
  Vector3 momentum = Vector3::Zero();
  double mass = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    momentum += scene.bodies[i].mass * states[i].velocity;
    mass += scene.bodies[i].mass;
  }
  return momentum / mass;
}

void add_motion(const Scene& scene, std::span<const BodyState> states, const AssemblyRegion& region,
                AssemblyState& all) {
  const Vector3 mean = mean_velocity(scene, states);
  const double d = region.dimensions();
  double mass = 0, square = 0, fourth = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Sphere& sphere = scene.bodies[i];
    const BodyState& s = states[i];
    mass += sphere.mass;
    all.height += sphere.mass * s.position.z();
    all.kinetic_energy += 0.5 * sphere.mass * s.velocity.squaredNorm();
    all.rotational_energy += 0.5 * sphere.moment_of_inertia() * s.angular_velocity.squaredNorm();
    all.weight_energy +=
        sphere.mass * (scene.gravity * s.position.z() - scene.downhill.dot(s.position.head<2>()));
    Vector3 own = s.velocity - mean;
    if (region.flat) own.z() = 0;
    all.stress += sphere.mass * own * own.transpose();
    all.temperature += sphere.mass * own.squaredNorm() / d;
    square += own.squaredNorm();
    fourth += own.squaredNorm() * own.squaredNorm();
  }
  const auto n = static_cast<double>(states.size());
  all.height /= mass;
  all.temperature /= n;
  if (square > 0) all.sonine = d / (d + 2) * (fourth / n) / (square / n * (square / n)) - 1;
}

}  // namespace

double contact_force(const SoftContact& contact, double overlap, double closing) {
  const double force = normal_force(contact.normal, overlap, closing);
  return contact.end == ContactEnd::zero_force ? std::max(0.0, force) : force;
}

AssemblyRegion assembly_region(const Scene& scene, std::span<const BodyState> states) {
  AssemblyRegion region;
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  Vector3 low = Vector3::Constant(kInfinite), high = -low;
  Vector3 outer_low = low, outer_high = high;
  region.flat = scene.has_substrate;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const double R = scene.bodies[i].radius;
    const Vector3& at = states[i].position;
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
    outer_low = outer_low.cwiseMin(at - Vector3::Constant(R));
    outer_high = outer_high.cwiseMax(at + Vector3::Constant(R));
    region.flat = region.flat && std::abs(at.z() - R) <= kFlat * R;
  }
  region.volume = 1;
  for (int k = 0; k < 3; ++k) {
    region.repeats[k] = k < 2 && scene.periodic[k] > 0;
    region.low[k] = region.repeats[k] ? 0 : low[k];
    region.lengths[k] = region.repeats[k] ? scene.periodic[k] : high[k] - low[k];
    region.volume *= region.repeats[k] ? scene.periodic[k] : outer_high[k] - outer_low[k];
  }
  return region;
}

/// For one pair the density of the distance r is 2π r or 4π r² times γ(r)/V², where γ(r) is the
/// mean over all directions u of Π_k (L_k − r |u_k|), without r |u_k| where k repeats (D. Stoyan,
/// W. S. Kendall, J. Mecke, Stochastic Geometry and its Applications, 2nd ed., Sec. 6.3 and App.
/// K): in space <|u_k|> = 1/2, <|u_1 u_2|> = 2/(3π), <|u_1 u_2 u_3|> = 1/(4π), in a plane <|u_k|> =
/// 2/π,
/// <|u_1 u_2|> = 1/π.
double AssemblyRegion::ideal_pairs(std::size_t bodies, double r) const {
  using std::numbers::pi;
  const int d = dimensions();
  double product = 1, one = 0, two = 0, three = 1;
  for (int k = 0; k < d; ++k) product *= lengths[k];
  for (int k = 0; k < d; ++k) {
    if (repeats[k]) {
      three = 0;
      continue;
    }
    one += product / lengths[k];
    for (int j = 0; j < k; ++j)
      if (!repeats[j]) two += product / (lengths[k] * lengths[j]);
  }
  const double covariance =
      flat ? product - 2 / pi * r * one + r * r / pi * two
           : product - r / 2 * one + 2 / (3 * pi) * r * r * two - r * r * r / (4 * pi) * three;
  const double shell = flat ? 2 * pi * r : 4 * pi * r * r;
  const auto n = static_cast<double>(bodies);
  return 0.5 * n * (n - 1) * shell * covariance / (product * product);
}

double AssemblyRegion::longest() const {
  double longest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < dimensions(); ++k)
    longest = std::min(longest, repeats[k] ? 0.5 * lengths[k] : lengths[k]);
  return longest;
}

AssemblyState assembly_state(const ContactScene& scene, std::span<const BodyState> states) {
  const Scene& hard = scene.hard;
  const AssemblyRegion region = assembly_region(hard, states);
  AssemblyState all;
  add_motion(hard, states, region, all);
  std::vector<unsigned> own(states.size(), 0);
  std::vector<NearPair> touching;
  for_each_overlap(scene, states, [&](const Overlap& at) {
    const auto i = at.first, j = at.second;
    touching.push_back({i, j});
    ++own[i];
    ++own[j];
    const Vector3 n = at.apart / at.distance;
    const double closing = -n.dot(states[i].velocity - states[j].velocity);
    all.stress += contact_force(at.contact, at.depth, closing) * n * at.apart.transpose();
    all.elastic_energy +=
        std::visit([&](const auto& law) { return law.energy(at.depth); }, at.contact.normal);
  });
  all.stress /= region.volume;
  all.contacts = touching.size();
  all.coordination = 2 * static_cast<double>(touching.size()) / static_cast<double>(states.size());
  std::size_t carried = 0, between_carried = 0;
  for (const unsigned each : own) carried += each >= 2;
  for (const auto& [i, j] : touching) between_carried += (own[i] >= 2) + (own[j] >= 2);
  if (carried > 0)
    all.coordination_of_carried =
        static_cast<double>(between_carried) / static_cast<double>(carried);
  return all;
}

}  // namespace slipcheck
