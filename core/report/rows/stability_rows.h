#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "report/rows/text_table.h"
#include "studies/stability/limits.h"
#include "studies/stability/stability.h"

namespace slipcheck {

/// An engine in a precision under a profile.
struct StabilityMethod {
  std::string engine, precision, profile;

  std::string label() const;  ///< "bullet double tuned"
  bool operator==(const StabilityMethod&) const = default;
};

/// A case at one rate beside all methods.
struct StabilityRow {
  const StabilityCase* scene = nullptr;
  std::optional<double> rate;             ///< [Hz]; none of a case without runs
  std::vector<const StabilityRun*> runs;  ///< by method; null where there is none
  std::string label;                      ///< the case's name, with the rate where rates differ
};

/// Cases by methods, in the order in which they appear.
struct StabilityOverview {
  std::vector<StabilityMethod> methods;
  std::vector<StabilityRow> rows;
  std::optional<double> rate;                         ///< [Hz] of all runs, where it is one
  std::vector<OutcomeCounts> totals;                  ///< runs by method and outcome
  std::size_t accurate = 0, refused = 0, failed = 0;  ///< cases, in the reference
};
/// Points into `cases`.
StabilityOverview overview_of(const std::vector<StabilityCase>& cases);
/// Runs by method and outcome; `none`: how "·" looks.
TextTable totals_table(const StabilityOverview& overview, Tone none);

/// "accurate", "refused", "FAILED"
const char* word_of(const ReferenceOutcome& reference);
/// Its place among the outcomes; a failure counts as a crash.
Outcome outcome_of(const ReferenceOutcome& reference);
/// What a run did and why, "energy growing in 3 of 16 phases: …".
std::string words_of(const StabilityRun& run);

/// Limits of one kind on one scene.
struct LimitGroup {
  Limit::Kind kind;
  std::string scene;
  std::vector<const Limit*> limits;
};
/// In order of appearance; points into `limits`.
std::vector<LimitGroup> limit_groups(const std::vector<Limit>& limits);

/// The maps that have an outcome in every cell: not those that were interrupted.
std::vector<const OutcomeMap*> complete_maps(const LimitResults& results);

/// "largest stable step"
const char* words_of(Limit::Kind kind);
/// "bullet double tuned", "fixed-step"
std::string label_of(const Limit& limit);
/// A value of this kind, "4.17 ms" or "0.0123".
std::string value_text(Limit::Kind kind, double value);
/// "4.17 … 4.21 ms", "all from 10 µs to 1 s", "none from …"; "–" where there is no answer.
std::string range_text(const Limit& limit);
/// The limit over theory; NaN where one of them is missing.
double ratio_to_theory(const Limit& limit);
/// Limits beside theory, what is beyond them and why.
TextTable limits_table(const std::vector<const Limit*>& limits);

}  // namespace slipcheck
