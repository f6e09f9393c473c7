// Compiled once for each instruction set by Google Highway. No operation is fused and nothing is
// summed over lanes, so that every set gives the same bits.
#include "reference/piles/pile_motion.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reference/piles/pile_motion.cpp"
#define HWY_DISABLED_TARGETS \
  (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "reference/piles/pile_motion-inl.h"

HWY_BEFORE_NAMESPACE();
namespace slipcheck {
namespace HWY_NAMESPACE {

HWY_ATTR PileSpeed move(PileWorld& world, std::span<const std::uint32_t> places,
                        std::span<NearSphere> spheres, const Vector3& drift) {
  constexpr std::size_t kAhead = 16;
  const PileMove move(world, drift);
  PileSpeed fastest;
  for (std::size_t k = 0; k < places.size(); ++k) {
    prefetch(world.bodies[places[std::min(k + kAhead, places.size() - 1)]]);
    move.run(reinterpret_cast<double*>(&world.bodies[places[k]]), spheres[places[k]], fastest);
  }
  return fastest;
}

}  // namespace HWY_NAMESPACE
}  // namespace slipcheck
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace slipcheck {

HWY_EXPORT(move);

PileSpeed move_bodies(PileWorld& world, std::span<const std::uint32_t> places,
                      std::span<NearSphere> spheres, const Vector3& drift) {
  return HWY_DYNAMIC_DISPATCH(move)(world, places, spheres, drift);
}

}  // namespace slipcheck
#endif
