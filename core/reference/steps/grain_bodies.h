#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/state_archive.h"
#include "base/thread_team.h"
#include "physics/contact/normal_force.h"
#include "physics/sphere.h"
#include "scene/scene.h"

namespace slipcheck {

/// What a scene of grains has; what it lacks does not exist in the loop chosen by these.
struct GrainFeatures {
  bool rubs = false;        ///< grains exert tangential forces, so that they spin
  bool on_plane = false;    ///< Coulomb friction of the substrate; grains roll
  bool driven = false;      ///< on_plane, and the substrate is tilted or moves
  bool any_normal = false;  ///< other normal forces than the linear one
  bool radii = false;       ///< on_plane and rubs, with centres at unlike heights
  bool lifts = false;       ///< on_plane and rubs, and grains leave the substrate
  bool rolls = false;       ///< on_plane and rubs, with rolling and drilling friction
  bool walls = false;       ///< on_plane and rubs, upright on the plane

  /// Whether centres lie at unlike heights, or the loops for such do the rest as well.
  bool is_uneven() const { return radii || lifts || rolls || walls; }
};

/// What the grains of one kind have in common; see StepBody.
struct GrainKind {
  double inverse_mass = 0;      ///< 1/m [1/kg]
  double inverse_inertia = 0;   ///< 1/I [1/(kg m²)]
  double weight = 0;            ///< m g, normal to the plane [N]
  double share = 0;             ///< 1/(1+A): the slip that reaches the centre on sticking [-]
  double turn = 0;              ///< A/R: |ΔΩ| for each |Δv| by friction [1/m]
  double static_friction = 0;   ///< μ_s [-]
  double kinetic_friction = 0;  ///< μ_k [-]
  std::uint32_t material = 0;
  double radius = 0;            ///< R [m]
  double rolling_friction = 0;  ///< μ_r [-]
  double drilling_length = 0;   ///< torque about the vertical for the load [m]
  const Sphere* sphere = nullptr;
  const SubstrateContact* contact = nullptr;
};

/// Grains, or what else is in an order, begin … end − 1.
struct GrainStretch {
  std::uint32_t begin = 0, end = 0;
  std::uint32_t size() const { return end - begin; }
  bool has(std::uint32_t k) const { return k - begin < size(); }
  /// Of `all`, those of thread k.
  static GrainStretch share(std::size_t all, std::size_t k, const ThreadTeam& team) {
    const auto [begin, end] = team.share_of(all, k);
    return {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)};
  }
};

/// The forces between two materials.
struct GrainLaw {
  NormalForce normal;
  double damping = 0;    ///< c of ViscousForce [N s/m]
  double friction = 0;   ///< ν_s of ViscousForce [-]
  bool clamped = false;  ///< ContactEnd::zero_force
};

/// Grains in the plane, each quantity in an array of its own; velocities lie half a step before the
/// positions, as in StepBody. What is not of for_each_changing() may lie in another order.
struct GrainArrays {
  std::vector<double> x, y;           ///< [m]
  std::vector<double> vx, vy;         ///< [m/s]
  std::vector<double> wx, wy, wz;     ///< Ω [rad/s]
  std::vector<double> dvx, dvy;       ///< what the last step changed [m/s]
  std::vector<double> dwx, dwy, dwz;  ///< [rad/s]
  std::vector<double> sticks;         ///< to the substrate: 1, else 0
  std::vector<double> radius;         ///< R, where grains are uneven [m]
  std::vector<double> z, vz, dvz;     ///< where they leave the substrate, as above
  std::vector<double> flies;          ///< above the substrate: 1, else 0
  std::vector<double> bounced;        ///< impulse by the substrate in the last step [N s]
  std::vector<std::uint32_t> kind;

  std::size_t size() const { return x.size(); }
  void resize(std::size_t n) {
    for_each_real([n](auto& values) { values.resize(n); });
    kind.resize(n);
  }
  void exchange(StateArchive& archive) {
    for_each_real(archive);
    for_each_lifted(archive);
    archive(radius, kind);
  }
  /// Those that all have.
  template <class F>
  void for_each_real(F&& f) {
    for (auto* values : {&x, &y, &vx, &vy, &wx, &wy, &wz, &dvx, &dvy, &dwx, &dwy, &dwz, &sticks})
      f(*values);
  }
  /// Those of grains that leave the substrate.
  template <class F>
  void for_each_lifted(F&& f) {
    for (auto* values : {&z, &vz, &dvz, &flies, &bounced}) f(*values);
  }
  /// Those that steps change, as members.
  template <class F>
  static void for_each_changed_part(const GrainFeatures& has, F&& f) {
    using G = GrainArrays;
    for (const auto part : {&G::x, &G::y, &G::vx, &G::vy, &G::dvx, &G::dvy}) f(part);
    if (has.rubs)
      for (const auto part : {&G::wz, &G::dwz}) f(part);
    if (has.on_plane)
      for (const auto part : {&G::wx, &G::wy, &G::dwx, &G::dwy, &G::sticks}) f(part);
    if (has.lifts)
      for (const auto part : {&G::z, &G::vz, &G::dvz, &G::flies, &G::bounced}) f(part);
  }
  template <class F>
  void for_each_changing(const GrainFeatures& has, F&& f) {
    for_each_changed_part(has, [&](auto part) { f(this->*part); });
  }
  /// Has places for so many, of what steps change; what was in them may be lost.
  void hold(std::size_t places, const GrainFeatures& has) {
    if (x.size() >= places) return;
    for_each_changing(has, [=](std::vector<double>& values) {
      values.clear();  // nothing is copied, and no more than that is held
      values.resize(places);
    });
  }
  /// What steps change of grains which[0], which[1], … of another becomes that of grains first,
  /// first + 1, ….
  void gather(std::size_t first, const GrainArrays& from, std::span<const std::uint32_t> which,
              const GrainFeatures& has) {
    for_each_changed_part(has, [&](auto part) {
      double* const to = (this->*part).data() + first;
      const double* const values = (from.*part).data();
      for (std::size_t k = 0; k < which.size(); ++k) to[k] = values[which[k]];
    });
  }
  /// What steps change of grains first, first + 1, … of another becomes that of grains which[0],
  /// which[1], ….
  void scatter(std::span<const std::uint32_t> which, const GrainArrays& from, std::size_t first,
               const GrainFeatures& has) {
    for_each_changed_part(has, [&](auto part) {
      double* const to = (this->*part).data();
      const double* const values = (from.*part).data() + first;
      for (std::size_t k = 0; k < which.size(); ++k) to[which[k]] = values[k];
    });
  }
  /// What steps change of grain `i` of another becomes that of grain `k`.
  void take(std::size_t k, const GrainArrays& from, std::size_t i, const GrainFeatures& has) {
    x[k] = from.x[i], y[k] = from.y[i], vx[k] = from.vx[i], vy[k] = from.vy[i];
    dvx[k] = from.dvx[i], dvy[k] = from.dvy[i];
    if (has.rubs) wz[k] = from.wz[i], dwz[k] = from.dwz[i];
    if (!has.on_plane) return;
    wx[k] = from.wx[i], wy[k] = from.wy[i];
    dwx[k] = from.dwx[i], dwy[k] = from.dwy[i];
    sticks[k] = from.sticks[i];
    if (!has.lifts) return;
    z[k] = from.z[i], vz[k] = from.vz[i], dvz[k] = from.dvz[i];
    flies[k] = from.flies[i], bounced[k] = from.bounced[i];
  }
};

/// Where what steps change of grains `first`, first + 1, … lies; null where a scene lacks it.
struct GrainView {
  GrainView() = default;
  GrainView(GrainArrays& of, std::size_t first) {
    const auto at = [=](std::vector<double>& values) {
      return values.empty() ? nullptr : values.data() + first;
    };
    x = at(of.x), y = at(of.y), vx = at(of.vx), vy = at(of.vy);
    wx = at(of.wx), wy = at(of.wy), wz = at(of.wz);
    dvx = at(of.dvx), dvy = at(of.dvy), dwx = at(of.dwx), dwy = at(of.dwy), dwz = at(of.dwz);
    sticks = at(of.sticks);
    z = at(of.z), vz = at(of.vz), dvz = at(of.dvz), flies = at(of.flies), bounced = at(of.bounced);
  }
  double *x = nullptr, *y = nullptr, *vx = nullptr, *vy = nullptr;
  double *wx = nullptr, *wy = nullptr, *wz = nullptr;
  double *dvx = nullptr, *dvy = nullptr, *dwx = nullptr, *dwy = nullptr, *dwz = nullptr;
  double* sticks = nullptr;
  double *z = nullptr, *vz = nullptr, *dvz = nullptr, *flies = nullptr, *bounced = nullptr;
};

/// Two grains that are close enough to meet soon, or touch; or a grain and a wall.
struct GrainPair {
  static constexpr std::uint16_t kNoWall = 0xffff;

  /// On the first grain, and of that the part across the line of centres [N].
  struct Force {
    double x = 0, y = 0, z = 0;
    double across_x = 0, across_y = 0, across_z = 0;
  };

  std::uint32_t a = 0, b = 0;
  double shift_x = 0, shift_y = 0;  ///< from b's place to its image next to a [m]
  std::uint32_t law = 0;
  bool touching = false;
  std::uint16_t parted_in = 0;   ///< 1 for the first step of the block; 0: in none
  std::uint16_t wall = kNoWall;  ///< that b stands for
  double normal_force = 0;       ///< F_N [N]
  Force force;
};

}  // namespace slipcheck
