#pragma once

#include <map>
#include <string>
#include <vector>

#include "report/charts/chart.h"
#include "report/charts/gnuplot.h"

namespace slipcheck {

/// A chart as a figure with its caption; where there is no image, `trouble` stands in its place.
std::string html_chart(const Chart& chart, const std::string& svg, const std::string& trouble);

/// What of a page's charts stands in it without a script.
class StandingCharts {
 public:
  /// The page's script draws: captions alone, shown where no script runs.
  StandingCharts() = default;
  /// Images of all of these.
  explicit StandingCharts(const std::vector<Chart>& charts);

  std::string html(const std::vector<Chart>& charts) const;

 private:
  bool are_drawn_ = false;
  std::map<std::string, std::string> svgs_;  // by name
  std::string trouble_;
};

}  // namespace slipcheck
