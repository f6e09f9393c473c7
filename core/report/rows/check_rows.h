#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "report/rows/report_content.h"
#include "report/rows/text_table.h"
#include "studies/baseline/check.h"

namespace slipcheck {

/// All scenes in numbers.
struct CheckTotals {
  std::size_t moved_scenes = 0;
  std::size_t runs = 0;                                  ///< of engines
  std::size_t better = 0, worse = 0, neither = 0;        ///< changes that gate
  std::size_t verdicts = 0;                              ///< that have changed and do not gate
  std::size_t compared = 0, drifted = 0, uncertain = 0;  ///< as in SceneCheck
  std::vector<std::string> versions;  ///< of engines that are not those of the baselines
  /// Geometric means over the scenes of CPU time now over that of the baseline; NaN without any.
  double reference_time_ratio = 0, engine_time_ratio = 0;

  std::size_t gating() const { return better + worse + neither; }
};

CheckTotals totals_of(const CheckReport& report);

/// A change as text for people.
struct ChangeRow {
  std::string part;         ///< "bullet double default 240 Hz"
  std::string what;         ///< "i-j.effective_restitution"; the note where all of it has changed
  std::string statistic;    ///< "median"
  std::string before, now;  ///< "27.65", "28.10 ms"; all digits where fewer show no difference
  std::string allowed;      ///< "± 0.28 ms"; may be empty
  Cell direction;           ///< "worse", "moved" where it is neither; "told only"
  std::string note;         ///< may be empty
  std::size_t others = 0;   ///< more changes of this part that have no row
};

/// Whether a change says more than another: it gates and the other does not, or it is farther
/// beyond what is allowed.
bool is_more_severe(const Change& one, const Change& other);

/// A scene's changes; unless `all` only the most severe of the reference and of each run, and none
/// that neither gates nor changes a verdict.
std::vector<ChangeRow> change_rows(const SceneCheck& scene, bool all);

/// A change in one line with all digits: "symmetric-30cms, bullet double default 240 Hz:
/// i-j.effective_restitution median was 0.4283, is 0.4451, allowed 0.005: worse".
std::string change_message(const Change& change);

/// The most severe of all scenes' changes in one table, the scenes that have moved first.
TextTable change_table(const CheckReport& report);

/// "✓ nothing has moved", "✗ 2 of 77 scenes have moved", without the symbol.
std::string check_verdict(const CheckReport& report);

/// What is told and does not gate, a line each: other versions, changed verdicts, moves within
/// what is allowed, CPU times.
std::vector<std::string> check_remarks(const CheckReport& report);

/// For a page and a summary of the results that were held against baselines.
Moved moved_since(const CheckReport& report);

}  // namespace slipcheck
