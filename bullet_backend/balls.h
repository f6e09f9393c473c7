#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "bullet_backend/bullet_settings.h"
#include "scene/scene.h"

class btCollisionObject;
class btDiscreteDynamicsWorld;

namespace slipcheck::bullet {

/// The spheres of a world, or its one block or cylinder, as rigid bodies or as multibodies without
/// links. Everything is in the world's units and axes. A ball's user index is its index in the
/// scene. In a box rigid balls are held in the plane y = 0; multibodies stay there by symmetry.
class Balls {
 public:
  virtual ~Balls() = default;

  virtual BodyState state(std::size_t body) const = 0;

  std::size_t count() const { return objects_.size(); }
  btCollisionObject& object(std::size_t body) const { return *objects_[body]; }

 protected:
  std::vector<btCollisionObject*> objects_;
};

/// Adds the scene's balls in these states to `world`, of the kind that the settings ask for, which
/// must outlive them. `turn`: from the scene's axes to the world's, for what is no sphere.
std::unique_ptr<Balls> make_balls(btDiscreteDynamicsWorld& world, const Scene& scene,
                                  std::span<const BodyState> states, const Eigen::Matrix3d& turn,
                                  const BulletSettings& settings);

/// Velocity and angular velocity of anything in a world; the position is left at zero.
BodyState motion_of(const btCollisionObject& object);

}  // namespace slipcheck::bullet
