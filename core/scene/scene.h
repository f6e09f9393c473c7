#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

#include "physics/contact/collision.h"
#include "physics/motion/shaken_floor.h"
#include "physics/motion/substrate_motion.h"
#include "physics/sphere.h"
#include "physics/surface.h"

namespace slipcheck {

/// L's vertical two-dimensional box around spheres in the plane y = 0: side walls x = 0 and
/// x = width, a vibrating floor z = z_f(t), and a lid where it has one. The contacts are by
/// material (Scene::material).
struct Box {
  double width = 0;  ///< [m], > 0
  ShakenFloor floor;
  /// The walls go up and down with the floor, and the lid with them.
  bool moving_walls = false;
  std::optional<double> lid;  ///< its (mean) height over the floor's mean height [m], > 0
  std::vector<PairContact> on_floor, on_wall, on_lid;
};

/// What keeps an endless cascade of ever weaker collisions (inelastic collapse) finite.
struct CollapseRule {
  enum class Model {
    /// A pair parts at least with a small fraction of its bodies' hardest impact (box: scene's
    /// speed).
    slowest_rebound,
    /// TC model, Luding and McNamara 1998: a collision does not dissipate if one of the two had its
    /// last one less than `contact_time` ago.
    contact_time,
    /// Bodies that collide again within `contact_time` form a cluster, in which the pair that
    /// approaches fastest goes first until none approaches (largest relative velocity); below
    /// that, and against walls, as slowest_rebound.
    largest_velocity,
  };
  Model model = Model::slowest_rebound;
  double contact_time = 0;  ///< t_c [s], > 0 for the last two
};

/// A class of bodies on a surface beside the substrate: as it lies there, and as it bounces off.
struct SurfaceContact {
  SubstrateContact lasting;  ///< friction, rolling and drilling while it touches
  PairContact impact;        ///< restitution, friction and β0 of an impact
};

/// Where materials are too many for a table of all pairs of them, and each two bodies have a
/// contact of their own (own_contacts.h): which of them share a row of it.
struct SharedRows {
  std::vector<std::size_t> of;  ///< by material; empty: each has its own
  std::size_t count = 0;
};

/// A scene in numbers alone, with every contact hard: what the event-driven reference solves and
/// what engines are given. Spheres on a plane z = 0 or in a box; all values SI.
struct Scene {
  std::vector<Sphere> bodies;
  std::vector<BodyState> initial;  ///< one for each body
  /// Of each body, an index below `substrate.size()`. Bodies of one material that a contact tells
  /// apart by their size count as several (scene_outline.h).
  std::vector<std::uint32_t> material;
  std::vector<SubstrateContact> substrate;  ///< by material
  std::vector<PairContact> pairs;           ///< by row × row, symmetric
  SharedRows rows;                          ///< of `pairs`: by material
  /// The same, or empty: what those pairs exchange instead that have one.
  std::vector<std::shared_ptr<const CollisionLaw>> laws;
  double gravity = 0;                  ///< along −z, normal to the plane [m/s²], >= 0
  Vector2 downhill = Vector2::Zero();  ///< gravity along the tilted plane [m/s²]
  /// Of each body that is no sphere; empty where all are.
  std::vector<std::optional<Extent>> extents;
  SubstrateMotion motion;  ///< of the plane
  bool confined = false;   ///< bodies never leave the plane
  /// Lengths of the cell in which the plane repeats itself [m], 0 in a direction in which it does
  /// not. Positions are not folded into the cell.
  Vector2 periodic = Vector2::Zero();
  std::optional<Box> box;  ///< in place of the substrate
  /// There is a plane z = 0; without it only `surfaces`, or a box.
  bool has_substrate = true;
  std::vector<Surface> surfaces;            ///< beside the substrate
  std::vector<SurfaceContact> on_surfaces;  ///< by material × surface
  CollapseRule collapse;

  std::size_t row_of(std::size_t body) const {
    return rows.of.empty() ? material[body] : rows.of[material[body]];
  }
  std::size_t row_count() const { return rows.of.empty() ? substrate.size() : rows.count; }
  const SubstrateContact& on_substrate(std::size_t body) const { return substrate[material[body]]; }
  const PairContact& between(std::size_t i, std::size_t j) const { return pairs[place_of(i, j)]; }
  const SurfaceContact& on_surface(std::size_t body, std::size_t surface) const {
    return on_surfaces[material[body] * surfaces.size() + surface];
  }
  /// [m/s²]
  Vector3 gravity_vector() const { return {downhill.x(), downhill.y(), -gravity}; }
  /// The way from one place to the nearest image of another across the plane's edges, if `apart` is
  /// that to the other itself [m].
  Vector3 to_nearest_image(Vector3 apart) const {
    for (int k = 0; k < 2; ++k)
      if (periodic[k] > 0) apart[k] -= periodic[k] * std::round(apart[k] / periodic[k]);
    return apart;
  }
  /// Two bodies of these materials that touch exchange their impulse; states as seen from the
  /// substrate.
  CollisionResult collide(std::size_t i, std::size_t j, const CollisionRule& rule,
                          const CollidingBody& first, const CollidingBody& second) const {
    const CollisionLaw* law = laws.empty() ? nullptr : laws[place_of(i, j)].get();
    return law ? law->collide(rule, first, second)
               : slipcheck::collide(between(i, j), rule, first, second);
  }

 private:
  std::size_t place_of(std::size_t i, std::size_t j) const {
    return row_of(i) * row_count() + row_of(j);
  }
};

/// A model that is valid but that nothing here can solve; the message names it and its place.
class Unsupported : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace slipcheck
