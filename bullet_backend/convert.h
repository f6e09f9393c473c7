#pragma once

#include <LinearMath/btVector3.h>

#include "physics/vector.h"

namespace slipcheck::bullet {

inline btVector3 to_bullet(const Vector3& v) {
  return btVector3(btScalar(v.x()), btScalar(v.y()), btScalar(v.z()));
}

inline Vector3 from_bullet(const btVector3& v) { return Vector3(v.x(), v.y(), v.z()); }

}  // namespace slipcheck::bullet
