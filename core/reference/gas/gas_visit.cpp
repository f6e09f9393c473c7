// Compiled once for each instruction set by Google Highway.
#include "reference/gas/gas_visit.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reference/gas/gas_visit.cpp"
#define HWY_DISABLED_TARGETS \
  (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "reference/gas/gas_visit-inl.h"

HWY_BEFORE_NAMESPACE();
namespace slipcheck {
namespace HWY_NAMESPACE {

template <std::size_t kD, bool kSpins>
HWY_ATTR void visit_with(const GasLaw& law, double shape_factor, GasRandom& random,
                         GasVisit& visit) {
  if (law.constant())
    visit_lanes<kD, kSpins, true>(law, shape_factor, random, visit);
  else
    visit_lanes<kD, kSpins, false>(law, shape_factor, random, visit);
}

HWY_ATTR void VisitCell(const GasLayout& layout, const GasLaw& law, double shape_factor,
                        GasRandom& random, GasVisit& visit) {
  if (layout.dimensions == 2 && layout.spins)
    return visit_with<2, true>(law, shape_factor, random, visit);
  if (layout.dimensions == 2) return visit_with<2, false>(law, shape_factor, random, visit);
  if (layout.spins) return visit_with<3, true>(law, shape_factor, random, visit);
  visit_with<3, false>(law, shape_factor, random, visit);
}

HWY_ATTR GasSquares SquaresOf(const GasLayout& layout, const GasVisit& visit) {
  return layout.dimensions == 2 ? squares_of_lanes<2>(layout, visit)
                                : squares_of_lanes<3>(layout, visit);
}

}  // namespace HWY_NAMESPACE
}  // namespace slipcheck
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace slipcheck {

HWY_EXPORT(VisitCell);
HWY_EXPORT(SquaresOf);

void visit_cell(const GasLayout& layout, const GasLaw& law, double shape_factor, GasRandom& random,
                GasVisit& visit) {
  HWY_DYNAMIC_DISPATCH(VisitCell)(layout, law, shape_factor, random, visit);
}

GasSquares squares_of(const GasLayout& layout, const GasVisit& visit) {
  return HWY_DYNAMIC_DISPATCH(SquaresOf)(layout, visit);
}

}  // namespace slipcheck
#endif
