#pragma once

#include <string>

#include "report/phase_spread.h"

namespace slipcheck {

/// The shapes that the charts' dots refer to; once on a page that has charts.
std::string strip_chart_shapes();

/// A strip for each run with a dot for each phase (`<use>`): across its value, downwards the phase,
/// so that what hangs on the phase shows as a line. The reference is a vertical line, the
/// tolerance a band about it; dots outside are crosses, those beyond the axis arrows at its end.
std::string strip_chart(const PhaseSpread& spread);

}  // namespace slipcheck
