#include "scene/contact_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "physics/contact/quasistatic.h"
#include "scenario/contact_models.h"
#include "scene/asperity_passivity.h"
#include "scene/obstacles.h"

namespace slipcheck {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The velocities at which bodies of one row start, or those of a surface, as a box.
struct Velocities {
  Vector3 least = Vector3::Constant(kInfinity);
  Vector3 most = Vector3::Constant(-kInfinity);
};

std::vector<Velocities> velocities_of(const SceneOutline& outline) {
  std::vector<Velocities> velocities(outline.rows.size());
  for (std::size_t i = 0; i < outline.scene.bodies.size(); ++i) {
    Velocities& each = velocities[outline.scene.row_of(i)];
    each.least = each.least.cwiseMin(outline.scene.initial[i].velocity);
    each.most = each.most.cwiseMax(outline.scene.initial[i].velocity);
  }
  return velocities;
}

Velocities velocities_of(const Box& box, std::string_view surface) {
  const bool moves = surface == "floor" || box.moving_walls;
  const Vector3 most(0, 0, moves ? box.floor.largest_speed() : 0);
  return {-most, most};
}

/// At most how fast two of them move against each other at the start [m/s]; exact for two bodies.
double relative_speed(const Velocities& a, const Velocities& b) {
  return (a.most - b.least).cwiseMax(b.most - a.least).norm();
}

/// Transversal [m/s]; infinite without a density.
double sound(const Material& material) {
  return material.density ? transversal_sound_speed(*material.young_modulus,
                                                    *material.poisson_ratio, *material.density)
                          : kInfinity;
}

/// A of a law of B [s], 0 for Hertz'; none for the others.
std::optional<double> dissipation_time_of(const NormalForce& force) {
  if (std::holds_alternative<HertzForce>(force)) return 0;
  if (const auto* expanded = std::get_if<ViscoelasticForce>(&force))
    return expanded->dissipation_time;
  if (const auto* compact = std::get_if<CompactViscoelasticForce>(&force))
    return compact->dissipation_time;
  return std::nullopt;
}

/// The worst over all pairs of classes that have the contact.
struct Worst {
  QuasistaticCheck fast, viscous;
  double speed = 0;             ///< of the fast one [m/s]
  double dissipation_time = 0;  ///< of the viscous one [s]
  double duration = 0;          ///< its t_c [s]
  double passive_speed = kInfinity;
  double depth = 0;        ///< of an impact, over the smaller radius
  double depth_speed = 0;  ///< its speed [m/s]
};

/// What an impact compresses without damping.
void look_at_depth(const ClassPair& pair, const NormalForce& force, double speed, Worst& worst) {
  if (!(speed > 0)) return;
  const ImpactScales scales = impact_scales(force, pair.mass(), speed);
  const double power = 1 + scales.law.alpha;
  const double depth = scales.length * std::pow(power / 2, 1 / power) /
                       std::min(pair.first.radius, pair.second.radius);
  if (depth <= worst.depth) return;
  worst.depth = depth;
  worst.depth_speed = speed;
}

void look_at_quasistatic(const ClassPair& pair, double A, double speed, Worst& worst) {
  if (!(speed > 0)) return;
  const double duration = hertz_duration(pair.mass(), pair.hertz(), speed);
  const double slower = std::min(sound(pair.first_material), sound(pair.second_material));
  const QuasistaticCheck check = quasistatic_check(speed, slower, A, duration);
  if (check.speed_ratio > worst.fast.speed_ratio) {
    worst.fast = check;
    worst.speed = speed;
  }
  if (check.time_ratio > worst.viscous.time_ratio) {
    worst.viscous = check;
    worst.dissipation_time = A;
    worst.duration = duration;
  }
}

/// The pair of classes whose printed asperities can create energy at the lowest impact speed
/// counts.
void look_at_asperities(const ClassPair& pair, const SoftContact& soft,
                        std::optional<PassiveSpeeds>& speeds, Worst& worst) {
  const auto* asperity = std::get_if<AsperityForce>(&soft.tangential);
  if (!asperity || asperity->form != AsperityForce::Form::printed || asperity->friction == 0)
    return;
  if (!speeds) speeds.emplace(soft.end);
  const double kappa = tangential_mass_ratio(pair.first, pair.second);
  worst.passive_speed =
      std::min(worst.passive_speed, speeds->of(impact_scales(soft.normal, pair.mass(), 1),
                                               asperity->friction / (kappa * asperity->size)));
}

}  // namespace

std::vector<std::string> contact_warnings(const Scenario& scenario, const SceneOutline& outline,
                                          const ContactMaker& maker) {
  const BodyContact& contact = maker.contact();
  const std::vector<Velocities> velocities = velocities_of(outline);
  Worst worst;
  std::optional<PassiveSpeeds> passive;
  const auto look = [&](const ClassPair& pair, double speed) {
    if (maker.is_viscoelastic_restitution()) {
      look_at_quasistatic(pair, ContactMaker::hard_viscoelastic(pair).dissipation_time, speed,
                          worst);
    } else if (maker.is_soft()) {
      const SoftContact soft = maker.soft(pair);
      if (const auto A = dissipation_time_of(soft.normal))
        look_at_quasistatic(pair, *A, speed, worst);
      look_at_asperities(pair, soft, passive, worst);
      look_at_depth(pair, soft.normal, speed, worst);
    }
  };
  const auto has = [&](const std::string& first, const std::string& second) {
    return find_contact(scenario, first, second) == &contact;
  };
  for (std::size_t a = 0; a < outline.rows.size(); ++a) {
    const std::string& material = outline.rows[a].front().material;
    for (std::size_t b = a; b < outline.rows.size(); ++b) {
      if (!has(material, outline.rows[b].front().material)) continue;
      for (const BodyClass& first : outline.rows[a])
        for (const BodyClass& second : outline.rows[b])
          look(class_pair(scenario, first, second), relative_speed(velocities[a], velocities[b]));
    }
    if (!outline.scene.box) continue;
    for (const char* surface : {"floor", "wall", "lid"}) {
      if (!has(material, surface)) continue;
      for (const BodyClass& each : outline.rows[a])
        look(surface_pair(scenario, each),
             relative_speed(velocities[a], velocities_of(*outline.scene.box, surface)));
    }
  }

  std::vector<std::string> warnings;
  const auto warn = [&](const char* key, const std::string& text) {
    warnings.push_back(fault_of(scenario, contact.path + key, text).message());
  };
  const char* normal = maker.is_soft() ? ".normal.model" : ".normal.restitution";
  if (worst.fast.too_fast()) {
    warn(normal, fmt::format("impacts at up to {:.3g} m/s are {:.2g} of the transversal speed "
                             "of sound; the law holds where the square of that is far below 1 "
                             "(B B11)",
                             worst.speed, std::sqrt(worst.fast.speed_ratio)));
  }
  if (worst.viscous.too_viscous()) {
    warn(
        normal,
        fmt::format("the dissipation time {:.3g} s is {:.2g} of an impact's duration {:.3g} s; the "
                    "law holds where that is far below 1 (B B12)",
                    worst.dissipation_time, worst.viscous.time_ratio, worst.duration));
  }
  if (worst.depth > 1) {
    warn(normal,
         fmt::format("impacts at up to {:.3g} m/s go {:.2g} of the smaller radius deep; the "
                     "law is one of small overlaps, and pushes on bodies whose centres have "
                     "passed each other",
                     worst.depth_speed, worst.depth));
  }
  if (worst.passive_speed < kInfinity) {
    warn(".tangential.form",
         fmt::format("the printed law can create energy in impacts faster than {:.3g} m/s that do "
                     "not break asperities; passive never does",
                     worst.passive_speed));
  }
  const auto* mindlin = std::get_if<MindlinTangential>(&contact.tangential);
  if (mindlin && mindlin->form == MindlinTangential::Form::displacement)
    warn(".tangential.form",
         "a bent contact that is pressed harder gains energy; passive never does");
  return warnings;
}

}  // namespace slipcheck
