#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "explain/explain_parts.h"
#include "harness/observe/box_observer.h"
#include "harness/run/box_reference.h"
#include "harness/run/reference_run.h"

namespace slipcheck {
namespace {

double mean_diameter(const Scene& scene) {
  double sum = 0;
  for (const Sphere& sphere : scene.bodies) sum += 2 * sphere.radius;
  return sum / static_cast<double>(scene.bodies.size());
}

void add_floor(ExplainSection& section, const ShakenFloor& floor, double gravity) {
  if (floor.is_still()) {
    section.add("V", quantity(0, kVelocity), "the floor is at rest");
    return;
  }
  const double V = floor.largest_speed(), omega = floor.angular_frequency();
  section.add("A0", quantity(floor.amplitude, kLength), "amplitude of the floor");
  section.add("f", quantity(floor.frequency, kFrequency), "its frequency");
  section.add("V", quantity(V, kVelocity), "its largest speed, 2π f A0");
  if (!(gravity > 0)) return;
  section.add("Γ", pure(floor.amplitude * omega * omega / gravity),
              "its largest acceleration over g; below 1 bodies at rest stay on it");
  section.add("V²/2g", quantity(V * V / (2 * gravity), kLength),
              "how high a body rises that leaves at V");
}

void add_bed(ExplainSection& section, const Scene& scene) {
  const double d = mean_diameter(scene);
  const double width = scene.box->width / d;
  const auto bodies = static_cast<double>(scene.bodies.size());
  section.add("width", quantity(scene.box->width, kLength),
              fmt::format("{:.4g} mean diameters", width));
  section.add("N d/width", pure(bodies / width), "layers of bodies, at rest");
  section.add("h_cm0", quantity(resting_height(scene), kLength),
              "height of the centre of mass at rest, L (14); H counts from it");
}

/// The one friction that all pairs have, if they do and all bodies are of one shape.
std::optional<PairContact> common_rubbing(const ContactScene& scene) {
  if (scene.hard.bodies.size() < 2 || !scene.is_hard()) return std::nullopt;
  const PairContact& first = scene.hard.pairs.front();
  const double* friction = std::get_if<double>(&first.friction);
  const auto rubs_alike = [&](const PairContact& pair) {
    const double* mu = std::get_if<double>(&pair.friction);
    return mu && *mu == *friction && pair.tangential_restitution == first.tangential_restitution;
  };
  const double A = scene.hard.bodies.front().inverse_shape_factor();
  const auto shaped_alike = [&](const Sphere& sphere) {
    return sphere.inverse_shape_factor() == A;
  };
  if (!friction || !(*friction > 0) || !(first.tangential_restitution > -1) ||
      !std::ranges::all_of(scene.hard.pairs, rubs_alike) ||
      !std::ranges::all_of(scene.hard.bodies, shaped_alike))
    return std::nullopt;
  return first;
}

/// L (15): K/R ≈ (2/q + 1/μ)/(1 + β0).
void add_energy_ratio(ExplainSection& section, const ContactScene& scene) {
  const auto rubbing = common_rubbing(scene);
  if (!rubbing) return;
  const double two_over_q = 2 * scene.hard.bodies.front().inverse_shape_factor();
  section.add("K/R",
              pure((two_over_q + 1 / std::get<double>(rubbing->friction)) /
                   (1 + rubbing->tangential_restitution)),
              "estimate of L (15), which the paper itself finds low by 1.3 ± 0.2");
}

std::string plural(std::size_t count, const char* noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

ExplainSection looks(const Scenario& scenario, const Scene& scene) {
  ExplainSection section{.title = "Measured"};
  const BoxSampling sampling = box_sampling(scenario);
  const double end = run_end(scenario).time, frequency = scene.box->floor.frequency;
  section.add("end", quantity(end, kTime),
              frequency > 0 ? fmt::format("{:g} periods of the floor", end * frequency)
                            : std::string("simulated time"));
  if (frequency > 0)
    section.add("discarded", plural(sampling.discard, "period"),
                sampling.until_steady ? "and more, until H, K and R are steady"
                                      : "before the first sample");
  const double interval = sampling_interval(scene, sampling);
  const double looks = std::floor(end / interval * (1 + 1e-12)) -
                       static_cast<double>(sampling.discard * sampling.per_period);
  section.add("samples", plural(static_cast<std::size_t>(std::max(looks, 0.0)), "look"),
              frequency > 0 && sampling.per_period == 1
                  ? std::string("at phase zero, when the floor passes its mean height upwards")
                  : fmt::format("one each {}", quantity(interval, kTime)));
  section.add(
      "of H (height), K and R (energies of translation and rotation) and the collision rate:");
  section.add("means with 95 % errors by blocking; engines start at different parts of a step");
  return section;
}

}  // namespace

ExplainSections explain_box(const Scenario& scenario, const ContactScene& scene) {
  ExplainSection box{.title = "Box"};
  add_floor(box, scene.hard.box->floor, scene.hard.gravity);
  add_bed(box, scene.hard);
  add_energy_ratio(box, scene);
  return {box, looks(scenario, scene.hard)};
}

}  // namespace slipcheck
