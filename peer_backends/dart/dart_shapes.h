#pragma once

#include <dart/collision/CollisionFilter.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <memory>

#include "peer_backends/dart/dart_settings.h"
#include "peer_backends/shared/contact_values.h"

namespace slipcheck::dart_engine {

/// Friction and restitution of shapes. Of two shapes DART takes the lesser friction and the product
/// of restitutions (dart/constraint/ContactConstraint.cpp), so that no choice of one number for
/// each body gives each two their own. Here a body has a shape for each kind of partner, the
/// materials and the surfaces, and a shape only meets its kind: two shapes of which each has the
/// pair's friction and the square root of its restitution; a surface has μ = ∞ and e = 1.
class PairShapes {
 public:
  PairShapes(const Scene& scene, const DartSettings& settings);

  /// Gives a body its shapes, or a surface its one.
  void dress_ball(::dart::dynamics::BodyNode& node, int body,
                  const ::dart::dynamics::ShapePtr& shape) const;
  void dress_surface(::dart::dynamics::BodyNode& node, int surface,
                     const ::dart::dynamics::ShapePtr& shape) const;

  /// Lets shapes meet that are made for each other.
  std::shared_ptr<::dart::collision::CollisionFilter> filter() const;

  /// The numbers that a body and another, or a surface, come to.
  peer::ContactValues values(int body, int other) const;

 private:
  peer::ContactValues typed_ball(int body) const;
  peer::ContactValues typed_surface(int surface) const;
  int kind_of(int body) const;

  const Scene& scene_;
  CoefficientMap map_;
};

/// The body or surface that a shape belongs to.
int index_of(const ::dart::dynamics::ShapeFrame* frame);

}  // namespace slipcheck::dart_engine
