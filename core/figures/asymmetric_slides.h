#pragma once

#include <array>
#include <vector>

#include "figures/steel_pair.h"

namespace slipcheck {

// K Sec. IV B, Figs. 8-11: sphere i rests or comes along −i, j meets it from that side;
// v_m = (v_i − v_j)·i, v_p = (v_i + v_j)·i, K (58), v_m < 0.

/// Sphere i from the collision to rolling, signed along i.
struct AsymmetricSlide {
  double time;             ///< t^s_i [s]
  double distance;         ///< s_i [m]
  double energy_change;    ///< ΔE_i = |v^f|² − |v^s|² [m²/s²]
  double momentum_change;  ///< Δp_i = v^f − v^s [m/s]
};

/// The two spheres with these v_m and v_p [m/s].
SteelPair asymmetric_pair(double v_m, double v_p, double restitution = SteelPair{}.restitution,
                          double rubbing_ratio = kSteel.rubbing_ratio);

/// C of K (55) [-].
double first_order_share();
/// K (57)-(60) with C to first order.
AsymmetricSlide asymmetric_closed_form(double v_m, double v_p);
/// Both spheres of one integrated collision. By mirror symmetry j is the i of −v_p: the first is i
/// at v_p, the second at −v_p.
std::array<AsymmetricSlide, 2> asymmetric_reference(const SteelPair& pair);

/// Curves over v_m at a few v_p [m/s], and the integrated points on them: K's case, Sec. IV (vi),
/// |v_p| <= |v_m|.
struct AsymmetricPoint {
  double v_m, v_p;
  AsymmetricSlide slide;
};
/// Computed when first asked for; grouped by v_p.
const std::vector<AsymmetricPoint>& asymmetric_points();

}  // namespace slipcheck
