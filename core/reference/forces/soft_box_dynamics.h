#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "physics/contact/tangential_branch.h"
#include "physics/sphere.h"
#include "scene/contact_scene.h"

namespace slipcheck {

/// A sphere in the plane y = 0: its centre (x, z) [m], velocity [m/s] and spin w about y [rad/s];
/// or the rates of these.
struct PlanarMotion {
  double x = 0, z = 0, vx = 0, vz = 0, w = 0;

  PlanarMotion plus(double h, const PlanarMotion& rate) const {
    return {x + h * rate.x, z + h * rate.z, vx + h * rate.vx, vz + h * rate.vz, w + h * rate.w};
  }
};

PlanarMotion planar(const BodyState& state);
BodyState spatial(const PlanarMotion& motion);

/// A contact that lasts, and the branch of its laws on which it is.
struct SoftTouch {
  std::size_t first = 0;    ///< body
  std::size_t partner = 0;  ///< body > first, or a surface: SoftBoxDynamics::surface()
  const SoftContact* law = nullptr;
  double reduced_mass = 0;         ///< m̄ [kg]
  double tangential_mobility = 0;  ///< Σ 1/m + R²/I: slip per tangential impulse [1/kg]
  bool pushes = true;              ///< zero_force: false where they overlap without a force
  TangentialBranch branch;         ///< of an asperity; a viscous force follows its cap
  double energy_speed2 = 0;        ///< for which time_scale holds, ξ̇² + 2 E(ξ)/m̄ [m²/s²]
  double time_scale = 0;           ///< about how long the contact lasts, or its force changes [s]
};

/// The equations of motion of spheres in L's box while some of them touch each other or its floor,
/// walls and lid, by the forces of ContactScene.
///
/// In a contact n points from the partner to the first body, t = (n_z, −n_x); the slip is
/// u = (v_i − v_j)·t − (R_i w_i + R_j w_j), and the force F_N n + F_T t on the first body turns
/// both by −R F_T. A surface is a partner of infinite mass without spin that moves as the floor
/// does, z_f(t); walls only where the box says so.
class SoftBoxDynamics {
 public:
  enum class Face : std::size_t { floor, left, right, lid };
  static constexpr std::size_t kSurfaces = 4;

  /// The scene must outlive this. Throws Unsupported where the scene has no box, or where a contact
  /// that can come about is hard.
  explicit SoftBoxDynamics(const ContactScene& scene);

  struct Meeting {
    double overlap = 0;       ///< ξ [m], negative: the gap
    double closing = 0;       ///< ξ̇ [m/s]
    double slip = 0;          ///< u [m/s]
    double nx = 0, nz = 0;    ///< n
    double across = 0;        ///< (v_i − v_j)·t [m/s]
    double surface_vz = 0;    ///< velocity of the surface [m/s]; 0 between bodies
    double distance = 1e300;  ///< between centres [m]; of surfaces: without bound
  };
  struct Forces {
    Meeting at;
    double normal = 0;        ///< F_N [N], as the law gives it, also where it does not push
    double tangential = 0;    ///< F_T along t [N]
    double closing_rate = 0;  ///< ξ̈ [m/s²]
  };
  /// Of all bodies, of which only those that touch are kept up to date; the bend of each touch's
  /// asperity: ζ [m], or of a passive one while F_N grows ∫F_N dζ [N m]; and the energies so far.
  struct State {
    std::vector<PlanarMotion> bodies;
    std::vector<double> bends;
    double work = 0;        ///< of the floor, walls and lid on the bodies [J]
    double dissipated = 0;  ///< all that the contacts took but did not store in their overlap [J]
  };
  struct Rates {
    State rate;
    std::vector<Forces> forces;  ///< of each touch
  };

  std::vector<SoftTouch> touches;
  std::vector<std::size_t> moved;  ///< bodies that touch something

  std::size_t size() const { return scene_->hard.bodies.size(); }
  std::size_t surface(Face which) const { return size() + static_cast<std::size_t>(which); }
  bool has_lid() const { return scene_->hard.box->lid.has_value(); }
  const ContactScene& scene() const { return *scene_; }

  /// Where `partner` is a surface, `other` is not looked at.
  Meeting meeting(std::size_t first, std::size_t partner, double t, const PlanarMotion& one,
                  const PlanarMotion& other) const;
  /// A touch that begins so.
  SoftTouch touch(std::size_t first, std::size_t partner, const Meeting& at) const;
  /// Makes time_scale fit the energy in the contact.
  void scale(SoftTouch& touch, const Meeting& at) const;

  void evaluate(double t, const State& state, Rates& out) const;
  /// One step h [s] of the classical Runge-Kutta scheme of fourth order from `state` with the rates
  /// `now`; `then`: the rates after it.
  void step(double t, double h, const State& state, const Rates& now, State& after, Rates& then);
  /// Kinetic energy and that of gravity and of the overlap in the touches [J].
  double energy(double t, std::span<const PlanarMotion> bodies) const;

 private:
  const SoftContact& law(std::size_t first, std::size_t partner) const;
  void add(const State& state, double h, const Rates& rates, State& sum) const;

  struct Inertia {
    double inverse_mass, inverse_inertia, radius;
  };

  const ContactScene* scene_;
  std::vector<Inertia> inertia_;
  State stage_;
  Rates second_, third_, fourth_;
};

}  // namespace slipcheck
