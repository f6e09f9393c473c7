#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "report/rows/text_table.h"
#include "studies/sweep/store_query.h"

namespace slipcheck {

/// One parameter of a sweep over the runs that a query has found.
struct SweptParameter {
  std::string name;  ///< with its unit in brackets
  bool is_number = true;
  bool logarithmic = false;  ///< spread over its range evenly in the logarithm
  /// By run: a number [SI], or the place of a word among `levels`; NaN where the run has none.
  std::vector<double> values;
  /// What groups of runs have: words by the alphabet, numbers rising; of more numbers than
  /// kMostSweptLevels the middles of as many equal parts of the range.
  std::vector<std::string> levels;
  std::vector<double> places;      ///< of the levels, as in `values`
  std::vector<std::size_t> level;  ///< by run; levels.size() where the run has none
  /// The share of the outcome's scatter that goes with this parameter alone: ε² of an analysis of
  /// variance, η² without what so many groups would show by chance, in [0, 1]; NaN undecided.
  double effect = std::numeric_limits<double>::quiet_NaN();
};

inline constexpr std::size_t kMostSweptLevels = 16;

/// Runs of a sweep as charts want them: what varies, what tells most first, and one outcome.
struct StoreView {
  std::string scene;
  std::string outcome;         ///< with its unit in brackets
  bool in_tolerances = false;  ///< an error, over the tolerance that it has in each run
  bool logarithmic = false;    ///< no value is below 0, and they span decades
  /// By run; NaN of runs that do not show it, on a logarithmic scale in place of 0 the least above.
  std::vector<double> values;
  std::vector<SweptParameter> parameters;
  std::size_t without = 0;  ///< runs that do not show the outcome

  /// Of the runs that show it, each of them; NaN of none.
  double median_of(const std::vector<std::size_t>& runs) const;
  /// That of the runs at each level of a parameter.
  std::vector<double> medians_over(const SweptParameter& parameter) const;
};

/// The first error in a store of what has a tolerance, else the first value of the reference; empty
/// in a store without any. Throws SqliteFailure.
std::string usual_outcome(SqliteFile& store);

/// Of rows with a value for each of so many parameters, then the outcome and, where it is an error,
/// the tolerance. Throws BadQuery where no row shows the outcome as a number.
StoreView view_of(const std::string& scene, const QueryResult& result, std::size_t parameters);

/// Of the runs that these filters find, with a column of the store as outcome. Throws BadQuery and
/// SqliteFailure.
StoreView view_of_store(SqliteFile& store, const std::vector<std::string>& filters,
                        const std::string& outcome);

/// "448 runs of pair; i-j.effective_restitution.error [tolerances]: 2 in the median, … Of its
/// scatter 61 % goes with rate [Hz], 20 % with …"
std::string store_finding(const StoreView& view);

/// How much goes with each parameter, and which of its values is best and worst in the median.
TextTable effects_table(const StoreView& view);

}  // namespace slipcheck
