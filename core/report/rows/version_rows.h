#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "harness/compare/record.h"
#include "report/rows/text_table.h"

namespace slipcheck {

/// Two versions of an engine on the same scenes: of each scene's runs the first half is of the one
/// before, the other half, in the same order, of the one after.
struct VersionComparison {
  std::string engine;         ///< "rapier"
  std::string before, after;  ///< "0.19.3", "0.21.0"
  std::vector<SceneRecord> scenes;
  double threshold = 0.1;  ///< what moves by less counts as unmoved [tolerances], >= 0
};

/// What differs between the two in a run: an observable, or that it came to its end at all.
struct VersionChange {
  const SceneRecord* scene = nullptr;
  const EngineRecord* before = nullptr;
  const EngineRecord* after = nullptr;
  std::string observable;  ///< with a tolerance; empty: only one of them came to its end
  std::vector<std::string> twins = {};  ///< others that could not be told apart from it
  /// The worst phase's error [tolerances]; NaN where there is none.
  double error_before = std::numeric_limits<double>::quiet_NaN();
  double error_after = std::numeric_limits<double>::quiet_NaN();
  /// How far the distribution over the phases has moved [tolerances]: the largest difference of
  /// two values that have as many below them; infinite where one of the two has no such value.
  double moved = 0;
};

/// What has moved by more than the threshold, what moved farthest first.
std::vector<VersionChange> version_changes(const VersionComparison& comparison);

/// How many runs and values were held against each other.
struct VersionTotals {
  std::size_t runs = 0, compared = 0, moved = 0;
  std::size_t better = 0, worse = 0;  ///< of those moved, by the worst phase's error
  std::size_t failed = 0;             ///< runs of the version after that are not ok or skipped
};
VersionTotals totals_of(const VersionComparison& comparison,
                        const std::vector<VersionChange>& changes);

/// The changes as a table, at most `most`.
TextTable version_table(const VersionComparison& comparison,
                        const std::vector<VersionChange>& changes, std::size_t most);

/// "rapier 0.19.3 → 0.21.0: 12 of 214 values in 78 runs have moved, 10 for the better, …"
std::string version_finding(const VersionComparison& comparison,
                            const std::vector<VersionChange>& changes);

}  // namespace slipcheck
