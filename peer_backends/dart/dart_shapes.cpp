#include "peer_backends/dart/dart_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <dart/collision/CollisionObject.hpp>
#include <set>
#include <string>

#include "peer_backends/shared/surfaces.h"

namespace slipcheck::dart_engine {
namespace {

using ::dart::dynamics::CollisionAspect;
using ::dart::dynamics::DynamicsAspect;
using ::dart::dynamics::ShapeFrame;
using ::dart::dynamics::ShapePtr;

constexpr double kNoLimit = 1e18;  // of a surface's friction: the lesser one counts

/// A shape's name is whose it is, of which kind, and for which kind: "3 0 -1".
struct Tag {
  int owner, kind, partner;
};

Tag tag_of(const ShapeFrame* frame) {
  const std::string& name = frame->getName();
  char* rest = nullptr;
  Tag tag{};
  tag.owner = static_cast<int>(std::strtol(name.c_str(), &rest, 10));
  tag.kind = static_cast<int>(std::strtol(rest, &rest, 10));
  tag.partner = static_cast<int>(std::strtol(rest, &rest, 10));
  return tag;
}

constexpr int kAnyone = 1 << 20;

void add_shape(::dart::dynamics::BodyNode& node, const ShapePtr& shape, const Tag& tag,
               const peer::ContactValues& values) {
  auto* made = node.createShapeNodeWith<CollisionAspect, DynamicsAspect>(
      shape, fmt::format("{} {} {}", tag.owner, tag.kind, tag.partner));
  made->getDynamicsAspect()->setFrictionCoeff(values.friction);
  made->getDynamicsAspect()->setRestitutionCoeff(values.restitution);
}

class KindFilter final : public ::dart::collision::CollisionFilter {
 public:
  bool ignoresCollision(const ::dart::collision::CollisionObject* first,
                        const ::dart::collision::CollisionObject* second) const override {
    const Tag a = tag_of(first->getShapeFrame()), b = tag_of(second->getShapeFrame());
    if (a.owner == b.owner || (a.owner < 0 && b.owner < 0)) return true;
    return !(meets(a, b) && meets(b, a));
  }

 private:
  static bool meets(const Tag& a, const Tag& b) {
    return a.partner == kAnyone || a.partner == b.kind;
  }
};

}  // namespace

int index_of(const ShapeFrame* frame) { return tag_of(frame).owner; }

PairShapes::PairShapes(const Scene& scene, const DartSettings& settings)
    : scene_(scene), map_(settings.coefficients) {}

int PairShapes::kind_of(int body) const {
  return static_cast<int>(scene_.material[static_cast<std::size_t>(body)]);
}

peer::ContactValues PairShapes::typed_ball(int body) const {
  const int ground = scene_.has_substrate ? peer::kFloor : surface_touch(0);
  peer::ContactValues values = peer::typed_values(scene_, body, ground);
  if (scene_.bodies.size() == 1) return values;
  const peer::ContactValues pair = peer::typed_values(scene_, body, body == 0 ? 1 : 0);
  if (scene_.box) return pair;
  values.restitution = pair.restitution;
  return values;
}

peer::ContactValues PairShapes::typed_surface(int surface) const {
  return peer::typed_values(scene_, 0, surface);
}

void PairShapes::dress_ball(::dart::dynamics::BodyNode& node, int body,
                            const ShapePtr& shape) const {
  if (map_ == CoefficientMap::fields) {
    add_shape(node, shape, {body, kind_of(body), kAnyone}, typed_ball(body));
    return;
  }
  std::set<int> surfaces;
  for (const peer::Surface& surface : peer::surfaces_of(scene_)) surfaces.insert(surface.index);
  for (std::size_t k = 0; k < scene_.surfaces.size(); ++k) surfaces.insert(surface_touch(k));
  for (const int surface : surfaces)
    add_shape(node, shape, {body, kind_of(body), surface}, values(body, surface));
  std::set<std::size_t> met;
  for (std::size_t other = 0; other < scene_.bodies.size(); ++other) {
    if (static_cast<int>(other) == body || !met.insert(scene_.material[other]).second) continue;
    peer::ContactValues half = values(body, static_cast<int>(other));
    half.restitution = std::sqrt(half.restitution);
    add_shape(node, shape, {body, kind_of(body), static_cast<int>(scene_.material[other])}, half);
  }
}

void PairShapes::dress_surface(::dart::dynamics::BodyNode& node, int surface,
                               const ShapePtr& shape) const {
  const bool fields = map_ == CoefficientMap::fields;
  add_shape(node, shape, {surface, surface, kAnyone},
            fields ? typed_surface(surface) : peer::ContactValues{kNoLimit, 1, 0, 0});
}

std::shared_ptr<::dart::collision::CollisionFilter> PairShapes::filter() const {
  return std::make_shared<KindFilter>();
}

peer::ContactValues PairShapes::values(int body, int other) const {
  if (map_ == CoefficientMap::fields) {
    const peer::ContactValues a = typed_ball(body);
    const peer::ContactValues b = other < 0 ? typed_surface(other) : typed_ball(other);
    return {std::min(a.friction, b.friction), a.restitution * b.restitution, 0, 0};
  }
  // A law of restitution has one number, as nothing asks for it when two meet.
  peer::ContactValues values = peer::exact_values(scene_, body, other, {});
  values.restitution = peer::typed_values(scene_, body, other).restitution;
  values.rolling = values.drilling = 0;
  return values;
}

}  // namespace slipcheck::dart_engine
