#include "figures/ice.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "figures/columns.h"
#include "physics/contact/hard_contact.h"
#include "scene/impact.h"

namespace slipcheck {
namespace {

IceImpact ice_impact(double effective_radius, double effective_mass) {
  const ElasticMaterial ice{kIce.young_modulus, kIce.poisson_ratio, 0};
  return {effective_mass, hertz_modulus(ice, ice, effective_radius)};
}

/// Where a function with one minimum between them is smallest, to 1e-7 of the place.
template <class Function>
double golden_section(const Function& f, double low, double high) {
  const double share = (std::sqrt(5.0) - 1) / 2;
  double a = high - share * (high - low), b = low + share * (high - low);
  double f_a = f(a), f_b = f(b);
  while (high - low > 1e-7 * high) {
    if (f_a < f_b) {
      high = b, b = a, f_b = f_a;
      f_a = f(a = high - share * (high - low));
    } else {
      low = a, a = b, f_a = f_b;
      f_b = f(b = low + share * (high - low));
    }
  }
  return 0.5 * (low + high);
}

}  // namespace

Sphere ice_sphere() {
  return {kIce.radius, kIce.density * 4 * M_PI / 3 * std::pow(kIce.radius, 3), 2.0 / 5};
}

std::string ice_caption() {
  return fmt::format("Ice: R = {:g} cm, Y = {:g} Pa, ν = {:g}, ρ = {:g} kg/m³.",
                     kIce.radius / kCentimetre, kIce.young_modulus, kIce.poisson_ratio,
                     kIce.density);
}

IceImpact ice_on_wall() { return ice_impact(kIce.radius, ice_sphere().mass); }
IceImpact ice_pair() { return ice_impact(kIce.radius / 2, ice_sphere().mass / 2); }

NormalForce IceLaw::force(const IceImpact& ice, double dissipation_time) const {
  if (compact) return CompactViscoelasticForce{ice.modulus, dissipation_time};
  return ViscoelasticForce{ice.modulus, dissipation_time};
}

double IceLaw::restitution(const IceImpact& ice, double dissipation_time, double speed) const {
  return impact(force(ice, dissipation_time), ice.mass, speed, end, 1e-9).restitution;
}

double measured_restitution(double speed) {
  static const RestitutionLaw law = PowerLawRestitution{};
  return restitution_at(law, speed);
}

IceFit fitted(const IceLaw& law, const IceImpact& ice, const std::vector<double>& speeds) {
  const auto square = [&](double A) {
    double sum = 0;
    for (double speed : speeds)
      sum += std::pow(law.restitution(ice, A, speed) - measured_restitution(speed), 2);
    return sum / static_cast<double>(speeds.size());
  };
  const double A = golden_section(square, 1e-6, 1e-3);
  return {A, std::sqrt(square(A))};
}

IceFit ice_pair_fit(const IceLaw& law) {
  static std::map<IceLaw, IceFit> known;
  const auto [place, is_new] = known.try_emplace(law);
  if (is_new)
    place->second = fitted(law, ice_pair(), equally_spaced(kSlowestIce, kFastestIce, kIceSpeeds));
  return place->second;
}

}  // namespace slipcheck
