#include "scene/impact.h"

#include <fmt/format.h>

#include <stdexcept>

#include "physics/contact/linear_contact.h"

namespace slipcheck {

Impact impact(const NormalForce& force, double reduced_mass, double speed, ContactEnd end,
              double tolerance) {
  const ImpactScales scales = impact_scales(force, reduced_mass, speed);
  Impact found = scaled_impact(scales.law, scales.dissipation, end, tolerance);
  found.duration *= scales.time;
  found.largest_overlap *= scales.length;
  found.largest_overlap_at *= scales.time;
  return found;
}

NormalForce with_restitution(const NormalForce& force, double reduced_mass, double restitution,
                             double speed, ContactEnd end) {
  if (const auto* linear = std::get_if<LinearForce>(&force)) {
    const double stiffness = linear->stiffness;
    const auto contact = LinearContact::with_stiffness(reduced_mass, restitution, stiffness, end);
    return LinearForce{stiffness, contact.damping_rate() * reduced_mass};
  }
  if (std::holds_alternative<HertzForce>(force)) {
    if (restitution == 1) return force;
    throw UnreachableRestitution(fmt::format("must be 1 at {:.6g} m/s: hertz is elastic", speed));
  }
  try {
    const ScaledLaw law = impact_scales(force, reduced_mass, speed).law;
    return with_dissipation(force, reduced_mass, speed, dissipation_for(law, end, restitution));
  } catch (const UnreachableRestitution& unreachable) {
    throw UnreachableRestitution(fmt::format("{} at {:.6g} m/s", unreachable.rule, speed));
  }
}

}  // namespace slipcheck
