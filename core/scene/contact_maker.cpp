#include "scene/contact_maker.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "scenario/contact_models.h"
#include "scene/impact.h"
#include "scene/obstacles.h"
#include "scene/scene.h"

namespace slipcheck {
namespace {

/// γ/ω0 up to which γ² + ω0² is not γ² to the last digit: 1/√ε of a double.
constexpr double kMostDamping = 6.7e7;
/// Overlap at 1 m/s in sums of the radii beyond which a contact stops nothing that a scene holds.
constexpr double kMostOverlap = 1e6;

double dissipation_of(const Material& material, const std::pair<double, double>& eta) {
  return dissipation_time(eta.first, eta.second, *material.young_modulus, *material.poisson_ratio);
}

TangentialForce tangential(const NoTangential&, const NormalForce&, const ClassPair&) {
  return NoTangentialForce{};
}
TangentialForce tangential(const ViscousTangential& model, const NormalForce& normal,
                           const ClassPair& pair) {
  // The ratio is to γ_N: only LinearForce has one, c = γ_N m̄.
  const double damping = model.damping_rate
                             ? *model.damping_rate * pair.mass()
                             : *model.damping_ratio * std::get<LinearForce>(normal).damping;
  const bool apart = model.caps == ViscousTangential::Caps::apart;
  return ViscousForce{damping, model.friction,
                      apart ? ViscousForce::Caps::apart : ViscousForce::Caps::together};
}
TangentialForce tangential(const AsperityTangential& model, const NormalForce&,
                           const ClassPair& pair) {
  return asperity_force(model, pair.radius());
}
TangentialForce tangential(const HardTangential&, const NormalForce&, const ClassPair&) {
  return NoTangentialForce{};  // made by soft(), which knows the restitution
}
// Those remember: sliding_memory().
TangentialForce tangential(const SpringTangential&, const NormalForce&, const ClassPair&) {
  return NoTangentialForce{};
}
TangentialForce tangential(const MindlinTangential&, const NormalForce&, const ClassPair&) {
  return NoTangentialForce{};
}

SpringFriction spring_friction(const SpringTangential& model, const NormalForce& normal,
                               const ClassPair& pair) {
  SpringFriction made;
  made.stiffness = model.stiffness
                       ? *model.stiffness
                       : *model.stiffness_ratio * std::get<LinearForce>(normal).stiffness;
  made.damping = model.damping_rate.value_or(0) * pair.mass();
  made.damping_ratio = model.damping_ratio.value_or(0);
  made.static_friction = model.friction.static_;
  made.kinetic_friction = model.friction.kinetic;
  return made;
}

/// A torque k_r R_eff² θ up to μ_r R_eff F_N; critical for two free spheres that roll on each
/// other.
SpringTorque spring_torque(const RollingResistance& model, const NormalForce& normal,
                           const ClassPair& pair) {
  const double k = model.stiffness
                       ? *model.stiffness
                       : *model.stiffness_ratio * std::get<LinearForce>(normal).stiffness;
  const double radius = pair.radius();
  const double inertia =
      1 / (1 / pair.first.moment_of_inertia() + 1 / pair.second.moment_of_inertia());
  SpringTorque made;
  made.stiffness = k * radius * radius;
  made.damping = model.damping * 2 * std::sqrt(made.stiffness * inertia);
  made.length = model.friction * radius;
  return made;
}

/// The dashpot of a linear contact [N s/m]; of others, which begin without one, nothing.
double linear_dashpot(const NormalForce& normal) {
  const auto* linear = std::get_if<LinearForce>(&normal);
  return linear ? linear->damping : 0;
}

/// What of the slip is left of it, −β, after a contact of `duration` in which it sticks: of the
/// oscillator u̇ = −ω² s − 2 ζ ω u with ω² = k_t/(κ m_eff).
double left_by_spring(double stiffness, double damping, double mass, double duration) {
  const double omega = std::sqrt(stiffness / mass), rate = 0.5 * damping / mass;
  const double square = (omega - rate) * (omega + rate), phase = std::sqrt(std::abs(square));
  if (phase * duration < 1e-9) return std::exp(-rate * duration) * (1 - rate * duration);
  if (square > 0)
    return std::exp(-rate * duration) *
           (std::cos(phase * duration) - rate / phase * std::sin(phase * duration));
  // Over critical damping cosh and sinh, as exponentials that only fall.
  const double slow = std::exp((phase - rate) * duration);
  const double fast = std::exp(-(phase + rate) * duration);
  return 0.5 * (slow + fast) - 0.5 * rate / phase * (slow - fast);
}

/// [s]; of a law whose duration depends on the speed, that at 1 m/s.
double duration(const SoftContact& soft, double mass) {
  const auto* linear = std::get_if<LinearForce>(&soft.normal);
  if (!linear) return impact(soft.normal, mass, 1, soft.end, 1e-9).duration;
  return LinearContact(mass, linear->stiffness, linear->damping / mass, soft.end).collision_time();
}

}  // namespace

double ClassPair::hertz() const {
  return hertz_modulus(elastic_material(first_material), elastic_material(second_material),
                       radius());
}

double ClassPair::dissipation(double first_time, double second_time) const {
  ElasticMaterial one = elastic_material(first_material);
  ElasticMaterial other = elastic_material(second_material);
  one.dissipation_time = first_time;
  other.dissipation_time = second_time;
  return effective_dissipation_time(one, other);
}

ClassPair class_pair(const Scenario& scenario, const BodyClass& first, const BodyClass& second) {
  const auto order = [](const BodyClass& of) {
    return std::tie(of.material, of.sphere.radius, of.sphere.mass, of.sphere.shape_factor);
  };
  if (order(second) < order(first)) return class_pair(scenario, second, first);
  return {first.sphere, second.sphere, scenario.materials.at(first.material),
          scenario.materials.at(second.material)};
}

ClassPair surface_pair(const Scenario& scenario, const BodyClass& body) {
  // Beyond round-off, so that the effective mass and radius are the body's own to the last bit.
  constexpr double kBeyondRoundOff = 1e30;
  Sphere flat = body.sphere;
  flat.mass *= kBeyondRoundOff;
  flat.radius *= kBeyondRoundOff;
  const Material& material = scenario.materials.at(body.material);
  return {body.sphere, flat, material, material};
}

bool ContactMaker::is_viscoelastic_restitution() const {
  const auto* hard = std::get_if<HardNormal>(&contact_.normal);
  return hard && std::holds_alternative<ViscoelasticRestitution>(hard->restitution);
}

SoftContact ContactMaker::soft(const ClassPair& pair) const {
  SoftContact made = unchecked(pair);
  check_stiffness(made, pair);
  check_damping(made, pair);
  return made;
}

SoftContact ContactMaker::unchecked(const ClassPair& pair) const {
  SoftContact made;
  made.normal = std::visit([&](const auto& model) { return normal(model, pair); }, contact_.normal);
  made.end = end();
  made.tangential = std::visit(
      [&](const auto& model) { return tangential(model, made.normal, pair); }, contact_.tangential);
  if (const auto* hard = std::get_if<HardTangential>(&contact_.tangential))
    made.tangential = ImpactAngleForce{
        std::get<double>(hard->friction), hard->tangential_restitution,
        tangential_mass_ratio(pair.first, pair.second), restitution_of(made, pair)};
  made.memory = memory(made.normal, pair);
  if (made.memory) made.tangential = NoTangentialForce{};
  return made;
}

std::optional<ContactMemory> ContactMaker::memory(const NormalForce& normal,
                                                  const ClassPair& pair) const {
  ContactMemory made;
  const auto* spring = std::get_if<SpringTangential>(&contact_.tangential);
  const auto* mindlin = std::get_if<MindlinTangential>(&contact_.tangential);
  if (!spring && !mindlin && !contact_.rolling) return std::nullopt;
  if (spring) made.sliding = spring_friction(*spring, normal, pair);
  if (mindlin)
    made.sliding = mindlin_friction(*mindlin, elastic_material(pair.first_material),
                                    elastic_material(pair.second_material), pair.radius());
  if (const auto* viscous = std::get_if<ViscousTangential>(&contact_.tangential)) {
    const auto force = std::get<ViscousForce>(tangential(*viscous, normal, pair));
    made.sliding.damping = force.damping;
    made.sliding.static_friction = made.sliding.kinetic_friction = force.friction;
  }
  if (contact_.rolling) made.rolling = spring_torque(*contact_.rolling, normal, pair);
  return made;
}

std::string ContactMaker::written_place(std::initializer_list<const char*> keys) const {
  const auto written = std::ranges::find_if(
      keys, [&](const char* key) { return scenario_.locations.contains(contact_.path + key); });
  return contact_.path + (written == keys.end() ? ".normal.model" : *written);
}

void ContactMaker::check_stiffness(const SoftContact& made, const ClassPair& pair) const {
  const double overlap = impact_scales(made.normal, pair.mass(), 1).time;  // at 1 m/s [m]
  const double most = kMostOverlap * (pair.first.radius + pair.second.radius);
  if (overlap <= most) return;
  throw BadScenario({fault_of(
      scenario_, written_place({".normal.stiffness", ".normal.modulus", ".normal.collision_time"}),
      fmt::format("must be stiff enough to stop bodies that meet at 1 m/s within {:.3g} m, "
                  "{:g} times the sum of their radii",
                  most, kMostOverlap),
      fmt::format("an overlap of {:.3g} m", overlap))});
}

void ContactMaker::check_damping(const SoftContact& made, const ClassPair& pair) const {
  const ImpactScales at_one = impact_scales(made.normal, pair.mass(), 1);
  const auto check = [&](std::initializer_list<const char*> keys, double rate) {
    if (rate * at_one.time <= kMostDamping) return;
    throw BadScenario({fault_of(
        scenario_, written_place(keys),
        fmt::format("must damp at a rate of at most {:.3g} /s, {:.2g} over the time of an impact; "
                    "beyond that the elastic force is lost in rounding",
                    kMostDamping / at_one.time, kMostDamping),
        fmt::format("a rate of {:.3g} /s", rate))});
  };
  check({".normal.damping_rate", ".normal.viscosity", ".normal.dissipation_time"},
        at_one.dissipation / at_one.time);
  if (const auto* viscous = std::get_if<ViscousForce>(&made.tangential))
    check({".tangential.damping_rate", ".tangential.damping_ratio"},
          viscous->damping / pair.mass());
}

RestitutionLaw ContactMaker::restitution_of(const SoftContact& soft, const ClassPair& pair) const {
  if (const auto* linear = std::get_if<LinearForce>(&soft.normal)) {
    const double rate = linear->damping / pair.mass();
    return LinearContact(pair.mass(), linear->stiffness, rate, soft.end).restitution();
  }
  const ImpactScales at_one = impact_scales(soft.normal, pair.mass(), 1);
  return curve(at_one.law).over_speed(at_one.dissipation);
}

PairContact ContactMaker::hard_equivalent(const SoftContact& soft, const ClassPair& pair) const {
  PairContact hard;
  hard.restitution = restitution_of(soft, pair);
  if (const auto* viscous = std::get_if<ViscousForce>(&soft.tangential)) {
    // Between free spheres κ m_eff u̇_t = −c u_t below Coulomb's cap, so that over a collision u_t
    // falls to exp(−c t_col/(κ m_eff)) = −β0 of itself.
    const double kappa = tangential_mass_ratio(pair.first, pair.second);
    const double decay = viscous->damping / (kappa * pair.mass());
    hard.friction = viscous->friction;
    hard.tangential_restitution = decay > 0 ? -std::exp(-decay * duration(soft, pair.mass())) : -1;
  } else if (const auto* asperity = std::get_if<AsperityForce>(&soft.tangential)) {
    // Asperities that break one after the other press back with half of what each holds, in the
    // mean. How far one that does not break springs back depends on the collision: no part of the
    // slip is given back here.
    hard.friction = 0.5 * asperity->friction;
    hard.tangential_restitution = 0;
  } else if (soft.memory) {
    const SpringFriction& spring = soft.memory->sliding;
    const double mass = tangential_mass_ratio(pair.first, pair.second) * pair.mass();
    const double time = duration(soft, pair.mass());
    double stiffness = spring.stiffness;
    if (spring.form != SpringFriction::Form::constant) {
      // k_t goes with √ξ as the normal dF/dξ = α ρ ξ^(α−1) does: that of a linear contact which
      // lasts as long and has the same proportion of both comes close.
      const double scale = impact_scales(soft.normal, pair.mass(), 1).time;  // ξ at 1 m/s [m]
      const auto elastic = [&](double overlap) {
        return std::visit([&](const auto& law) { return law.elastic(overlap); }, soft.normal);
      };
      const double normal = (elastic(1.01 * scale) - elastic(0.99 * scale)) / (0.02 * scale);
      stiffness = spring.stiffness_at(scale) / normal * pair.mass() * std::pow(M_PI / time, 2);
    }
    const double damping = spring.damping + spring.damping_ratio * linear_dashpot(soft.normal);
    hard.friction = spring.kinetic_friction;
    hard.tangential_restitution =
        std::clamp(-left_by_spring(stiffness, damping, mass, time), -1.0, 1.0);
  } else if (const auto* angle = std::get_if<ImpactAngleForce>(&soft.tangential)) {
    hard.friction = angle->friction;
    hard.tangential_restitution = angle->tangential_restitution;
  }
  return hard;
}

PairContact ContactMaker::hard(const ClassPair& pair) const {
  PairContact made = hard_pair(contact_);
  if (is_viscoelastic_restitution()) {
    const ImpactScales at_one = impact_scales(hard_viscoelastic(pair), pair.mass(), 1);
    made.restitution = curve(at_one.law).over_speed(at_one.dissipation);
  }
  return made;
}

ViscoelasticForce ContactMaker::hard_viscoelastic(const ClassPair& pair) {
  return {pair.hertz(), pair.dissipation(*pair.first_material.dissipation_time,
                                         *pair.second_material.dissipation_time)};
}

ContactEnd ContactMaker::end() const {
  return std::visit(
      [](const auto& model) {
        if constexpr (requires { model.ends_at; }) {
          return contact_end(model.ends_at);
        } else {
          return ContactEnd::zero_overlap;
        }
      },
      contact_.normal);
}

NormalForce ContactMaker::normal(const HardNormal&, const ClassPair& pair) const {
  return HertzForce{pair.hertz()};  // never asked for
}

NormalForce ContactMaker::normal(const LinearNormal& model, const ClassPair& pair) const {
  const LinearContact contact = linear_contact(model, pair.mass());
  // As where it is given, the restitution is above 0.
  if (model.damping_rate && model.collision_time && !(contact.restitution() > 0))
    throw BadScenario({fault_of(
        scenario_, contact_.path + ".normal.damping_rate",
        fmt::format(
            "must leave a restitution > 0: exp(-damping_rate collision_time/2), with {:.6g} s",
            *model.collision_time),
        fmt::format("{:.6g} /s", *model.damping_rate))});
  return LinearForce{contact.stiffness(), contact.damping_rate() * pair.mass()};
}

NormalForce ContactMaker::normal(const HertzNormal&, const ClassPair& pair) const {
  return HertzForce{pair.hertz()};
}

NormalForce ContactMaker::normal(const PowerNormal& model, const ClassPair& pair) const {
  const PowerForce force{model.modulus, model.viscosity.value_or(0), model.alpha, model.gamma};
  if (!model.restitution) return force;
  return with_given_restitution(force, pair, *model.restitution, *model.at_speed);
}

NormalForce ContactMaker::normal(const ViscoelasticNormal& model, const ClassPair& pair) const {
  double time = model.dissipation_time.value_or(0);
  if (model.viscosity) {
    time = pair.dissipation(dissipation_of(pair.first_material, *model.viscosity),
                            dissipation_of(pair.second_material, *model.viscosity));
  }
  const NormalForce force = model.form == ViscoelasticNormal::Form::expanded
                                ? NormalForce(ViscoelasticForce{pair.hertz(), time})
                                : NormalForce(CompactViscoelasticForce{pair.hertz(), time});
  if (!model.restitution) return force;
  return with_given_restitution(force, pair, *model.restitution, *model.at_speed);
}

/// with_restitution() with its root found once, as D is the same for all pairs.
NormalForce ContactMaker::with_given_restitution(const NormalForce& force, const ClassPair& pair,
                                                 double restitution, double speed) const {
  if (!dissipation_) {
    try {
      dissipation_ =
          dissipation_for(impact_scales(force, pair.mass(), speed).law, end(), restitution);
    } catch (const UnreachableRestitution& unreachable) {
      throw BadScenario({fault_of(scenario_, contact_.path + ".normal.restitution",
                                  fmt::format("{} at {:.6g} m/s", unreachable.rule, speed),
                                  fmt::format("{:.6g}", restitution))});
    }
  }
  return with_dissipation(force, pair.mass(), speed, *dissipation_);
}

RestitutionCurve& ContactMaker::curve(const ScaledLaw& law) const {
  if (!curve_) curve_.emplace(law, end());
  return *curve_;
}

}  // namespace slipcheck
