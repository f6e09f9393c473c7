#pragma once

#include <cstddef>
#include <stdexcept>
#include <vector>

#include "physics/hard_contact.h"
#include "physics/sphere.h"
#include "physics/substrate_motion.h"
#include "scenario/scenario.h"

namespace slipcheck {

/// A scene in numbers alone, with every contact hard: what the event-driven reference solves and
/// what engines are given. Spheres on a plane z = 0; all values SI.
struct HardScene {
  std::vector<Sphere> bodies;
  std::vector<BodyState> initial;  ///< one for each body
  /// Of each body, an index below `substrate.size()`. Bodies of one material that a contact tells
  /// apart by their size count as several (scene_outline.h).
  std::vector<std::size_t> material;
  std::vector<SubstrateContact> substrate;  ///< by material
  std::vector<PairContact> pairs;           ///< by material × material, symmetric
  double gravity = 0;                       ///< along −z, normal to the plane [m/s²], >= 0
  Vector2 downhill = Vector2::Zero();       ///< gravity along the tilted plane [m/s²]
  SubstrateMotion motion;                   ///< of the plane
  bool confined = false;                    ///< bodies never leave the plane

  const SubstrateContact& on_substrate(std::size_t body) const { return substrate[material[body]]; }
  const PairContact& between(std::size_t i, std::size_t j) const {
    return pairs[material[i] * substrate.size() + material[j]];
  }
};

/// A model that is valid but that nothing here can solve; the message names it and its place.
class Unsupported : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The pair contact of a normal model `hard`; a restitution `viscoelastic` is left at 1.
PairContact hard_pair(const BodyContact& contact);

}  // namespace slipcheck
