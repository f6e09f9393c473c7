#pragma once

#include <algorithm>
#include <cmath>
#include <variant>

#include "physics/contact/normal_force.h"
#include "physics/contact/tangential_branch.h"
#include "physics/vector.h"

namespace slipcheck {

// Tangential laws as the fixed-step solver sees them. Each has
//   History      what the contact remembers,
//   begin()      the bodies touched `since` [s] ago,
//   advance()    one step later,
//   force()      F_T [N] on the first body.
// `half` is half a step [s]; the slip u_t [m/s] is the one predicted for now.

/// No tangential force: costs nothing.
struct SmoothPair {
  static constexpr bool kRubs = false;
  struct History {};
};

struct ViscousPair {
  static constexpr bool kRubs = true;
  struct History {};
  ViscousForce law;

  void begin(History&, double, double, const Vector3&, const Vector3&) const {}
  void advance(History&, double, double, const Vector3&, const Vector3&) const {}
  Vector3 force(const History&, double normal, const Vector3& slip) const {
    const double cap = law.cap(normal);
    const double slip2 = slip.squaredNorm();
    double for_slip = -law.damping;  // F_T for u_t [N s/m]
    if (law.damping * law.damping * slip2 > cap * cap) for_slip = -cap * (1 / std::sqrt(slip2));
    return for_slip * slip;
  }
};

/// The bend of an asperity, carried by half a step of the slip beyond now, and where the line of
/// centres was.
struct Bend {
  Vector3 bend = Vector3::Zero();   ///< ζ [m]
  Vector3 ahead = Vector3::Zero();  ///< ζ + u_t h/2 [m]
  Vector3 normal_direction = Vector3::Zero();
  double normal = 0;  ///< F_N [N]

  void begin(double half, double since, const Vector3& slip, const Vector3& n) {
    bend.setZero();
    ahead = (since - half) * slip;
    normal_direction = n;
    normal = 0;
  }
  /// ζ̇ = u_t − n (ζ·ṅ) by the trapezoidal rule: the second term turns ζ with n, and the smallest
  /// turn from n to n' is ζ' = ζ − (n + n') (ζ·n')/(1 + n·n'). `kept`: what is left of ζ.
  void advance(double half, double kept, const Vector3& slip, const Vector3& n) {
    const double turn = ahead.dot(n) / (1 + n.dot(normal_direction));
    bend = kept * (ahead - turn * (n + normal_direction)) + half * slip;
    ahead = bend + half * slip;
    normal_direction = n;
  }
};

/// B (35), (37): a saw-tooth over |ζ|.
struct PrintedAsperityPair {
  static constexpr bool kRubs = true;
  using History = Bend;
  AsperityForce law;

  void begin(Bend& bend, double half, double since, const Vector3& slip, const Vector3& n) const {
    bend.begin(half, since, slip, n);
  }
  void advance(Bend& bend, double half, double, const Vector3& slip, const Vector3& n) const {
    bend.advance(half, 1, slip, n);
  }
  Vector3 force(const Bend& bend, double normal, const Vector3&) const {
    const TangentialBranch branch{.broken = std::floor(bend.bend.norm() / law.size)};
    return tangential_force(law, branch, normal, no_vector<Vector3>(), bend.bend);
  }
};

/// dF_T = −(μ/ζ0) F_N dζ while F_N grows, F_T in proportion to F_N while it falls; with the bend b,
/// F_T = −(μ/ζ0) F_N b: F_N b grows by F_N dζ, or b by dζ. Where F_N attracts there is no friction,
/// which could only drive.
struct PassiveAsperityPair {
  static constexpr bool kRubs = true;
  using History = Bend;
  AsperityForce law;

  void begin(Bend& bend, double half, double since, const Vector3& slip, const Vector3& n) const {
    bend.begin(half, since, slip, n);
  }
  void advance(Bend& bend, double half, double normal, const Vector3& slip,
               const Vector3& n) const {
    const double kept = normal > bend.normal ? bend.normal / normal : 1;
    bend.advance(half, kept, slip, n);
    if (bend.bend.squaredNorm() >= law.size * law.size) {
      bend.bend.setZero();
      bend.ahead = half * slip;
    }
    bend.normal = std::max(normal, 0.0);
  }
  Vector3 force(const Bend& bend, double normal, const Vector3&) const {
    return tangential_force(law, {.growing = false}, std::max(normal, 0.0), no_vector<Vector3>(),
                            bend.bend);
  }
};

/// Whichever, for scenes that mix laws.
struct AnyPair {
  static constexpr bool kRubs = true;
  using History = Bend;
  std::variant<SmoothPair, ViscousPair, PrintedAsperityPair, PassiveAsperityPair> law;

  void begin(Bend& bend, double half, double since, const Vector3& slip, const Vector3& n) const {
    bend.begin(half, since, slip, n);
  }
  void advance(Bend& bend, double half, double normal, const Vector3& slip,
               const Vector3& n) const {
    if (const auto* printed = std::get_if<PrintedAsperityPair>(&law))
      printed->advance(bend, half, normal, slip, n);
    else if (const auto* passive = std::get_if<PassiveAsperityPair>(&law))
      passive->advance(bend, half, normal, slip, n);
  }
  Vector3 force(const Bend& bend, double normal, const Vector3& slip) const {
    if (const auto* viscous = std::get_if<ViscousPair>(&law))
      return viscous->force({}, normal, slip);
    if (const auto* printed = std::get_if<PrintedAsperityPair>(&law))
      return printed->force(bend, normal, slip);
    if (const auto* passive = std::get_if<PassiveAsperityPair>(&law))
      return passive->force(bend, normal, slip);
    return Vector3::Zero();
  }
};

/// Any normal law, for scenes that mix them.
struct AnyNormalForce {
  NormalForce law;
  double operator()(double overlap, double rate) const { return normal_force(law, overlap, rate); }
};

}  // namespace slipcheck
