#include "bullet_backend/touches.h"

#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <utility>

#include "bullet_backend/coefficients.h"

namespace slipcheck::bullet {
namespace {

/// Whether the solver saw the manifold in the last step. It does not where both bodies sleep (the
/// plane always does where it is still), and the impulses found there are those of the last step
/// before.
bool was_solved(const btPersistentManifold& manifold) {
  return manifold.getBody0()->getActivationState() != ISLAND_SLEEPING ||
         manifold.getBody1()->getActivationState() != ISLAND_SLEEPING;
}

/// Summed over a manifold's points: a rolling sphere keeps up to four. A point further away than
/// the processing threshold is passed over by the solver and keeps an old impulse.
double normal_impulse(const btPersistentManifold& manifold) {
  double sum = 0;
  for (int k = 0; k < manifold.getNumContacts(); ++k) {
    const btManifoldPoint& point = manifold.getContactPoint(k);
    if (point.getDistance() > manifold.getContactProcessingThreshold()) continue;
    sum += double(point.getAppliedImpulse());
  }
  return sum;
}

}  // namespace

void find_touches(btCollisionDispatcher& dispatcher, bool in_box, std::vector<Touch>& touches) {
  touches.clear();
  for (int k = 0; k < dispatcher.getNumManifolds(); ++k) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(k);
    if (!was_solved(manifold)) continue;
    const double impulse = normal_impulse(manifold);
    if (!(impulse > 0)) continue;
    int first = manifold.getBody0()->getUserIndex();
    int second = manifold.getBody1()->getUserIndex();
    if (first < 0 || (second >= 0 && second < first)) std::swap(first, second);
    if (in_box && (second == kWall || second == kLid)) continue;
    touches.push_back({first, second, impulse});
  }
  std::ranges::sort(touches, {},
                    [](const Touch& touch) { return std::pair(touch.first, touch.second); });
}

}  // namespace slipcheck::bullet
