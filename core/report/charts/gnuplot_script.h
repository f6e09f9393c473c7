#pragma once

#include <string>

#include "report/charts/chart.h"

namespace slipcheck {

/// What gnuplot draws a chart from, in the folder where both are: `script` is NAME.gp, `data` the
/// NAME.dat that it reads, a block for each curve. NAME.svg comes of it.
struct GnuplotScript {
  std::string script, data;
};
GnuplotScript gnuplot_script(const Chart& chart);

}  // namespace slipcheck
