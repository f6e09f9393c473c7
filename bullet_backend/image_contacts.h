#pragma once

#include <vector>

#include "bullet_backend/near_pairs.h"

class btCollisionAlgorithm;
class btCollisionDispatcher;
class btCollisionObject;
struct btDispatcherInfo;

namespace slipcheck::bullet {

/// Contacts of balls with images of each other across the edges of a periodic cell, which Bullet
/// does not have. Its own algorithm for two spheres looks at the one and the other's image; the
/// contact that it finds is then written as that of the two bodies where they are: solvers ask for
/// the place of a contact beside each of the two centres and for its normal, no more.
class ImageContacts {
 public:
  /// `cell` and `dispatcher` must outlive this.
  ImageContacts(const PeriodicCell& cell, btCollisionDispatcher& dispatcher);
  ~ImageContacts();
  ImageContacts(const ImageContacts&) = delete;
  ImageContacts& operator=(const ImageContacts&) = delete;

  /// The contacts of this instant in place of those of the last, of all balls among the objects.
  void find(const std::vector<btCollisionObject*>& balls, const btDispatcherInfo& info);

 private:
  void clear();
  void touch(btCollisionObject& first, btCollisionObject& second, const Vector3& shift,
             const btDispatcherInfo& info);

  const PeriodicCell* cell_;
  btCollisionDispatcher* dispatcher_;
  NearPairs near_;
  std::vector<btCollisionAlgorithm*> algorithms_;  // each has a contact of its own
};

}  // namespace slipcheck::bullet
