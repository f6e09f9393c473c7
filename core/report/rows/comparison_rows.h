#pragma once

#include <string>
#include <vector>

#include "harness/compare/record.h"
#include "report/rows/quantity.h"
#include "report/rows/text_table.h"

namespace slipcheck {

/// One observable of one engine beside the reference, as text for people.
struct ComparisonRow {
  std::string name;  ///< "i.sliding_time"
  Cell reference;    ///< "27.67 ms", with "± …" where the uncertainty matters
  Cell median;       ///< in the reference's unit, "29.20"; with it where there is no reference
  Cell spread;       ///< "29.00 … 30.50", or one number where all phases agree
  Cell headings;     ///< how far the headings of a phase are apart, of several: "0.41 %"
  Cell worst;        ///< largest error: "10.2 %", "0.141", "1.2 mm"
  Cell tolerance;    ///< in the same form
  Verdict verdict = Verdict::unjudged;
  double severity = 0;  ///< largest error in units of the tolerance; NaN without one
  std::string note;     ///< why there is no error, or which phases are missing
};

/// The format for an observable of a scene, fit for the reference and, where that is zero, for what
/// the engine shows (`ensemble` may be null).
QuantityFormat format_for(const SceneRecord& scene, const std::string& name,
                          const EnsembleValue* ensemble);

/// An error as text: a relative one in percent, an absolute one in the observable's unit.
std::string error_text(double error, bool absolute, const Dimension& dimension);
/// A tolerance in the same form, without the zeros that it was not given with.
std::string tolerance_text(double tolerance, bool absolute, const Dimension& dimension);

/// "0.3571428571, agrees to 3e-16": the closed form beside the reference's value; empty without.
std::string closed_form_text(const ReferenceResult& reference, const std::string& name,
                             const QuantityFormat& format);

/// The reference's value of an observable, "–" where it shows none; with "± …" where the
/// uncertainty is more than a 1e-9 of the value.
Cell reference_cell(const SceneRecord& scene, const std::string& name,
                    const QuantityFormat& format);

/// One row for each of these observables that the reference or the engine shows, or that the run
/// has a verdict on. Where the scene
/// says what it expects of the run, tolerances do not count and are not in the rows.
std::vector<ComparisonRow> comparison_rows(const SceneRecord& scene, const EngineRecord& run,
                                           const std::vector<std::string>& names);

/// The most severe `count` of the rows, in their old order.
std::vector<ComparisonRow> most_severe(std::vector<ComparisonRow> rows, std::size_t count);

/// What comparisons show, behind what says whose they are: the columns, and the cells of one.
std::vector<Column> comparison_columns(std::vector<Column> whose = {});
std::vector<Cell> comparison_cells(const ComparisonRow& row, std::vector<Cell> whose = {});
/// They with their verdicts and notes, of many the `most` that are most severe.
TextTable comparison_table(std::vector<ComparisonRow> rows, std::size_t most);

/// The first `most` of these observables in the reference, beside their closed forms or the reason
/// why they are absent.
TextTable reference_table(const SceneRecord& scene, const std::vector<std::string>& names,
                          std::size_t most);

/// How many rows of a scene people are shown: one of many bodies would fill many screens, and the
/// result file has everything.
inline constexpr std::size_t kMostRows = 20;

/// "bullet 3.24 double, profile default, 240 Hz"
std::string run_name(const EngineRecord& run);

/// "32 phases", "32 phases × 8 headings"
std::string ensemble_text(const EngineRecord& run);

/// "event solver, 1 collision, ends at 83.01 ms, 2.1 µs of CPU time", for a box with what follows.
std::string reference_summary(const ReferenceResult& reference);

/// "means over 250 samples after 50 periods, steady; ± holds the true mean with 95 %"
std::string sampling_summary(const BoxReference& box);

/// "3.1 µs/step", empty where nothing was stepped.
std::string step_cost(const EngineRecord& run);

/// The status for people, "timed out".
std::string status_text(EngineRecord::Status status);

}  // namespace slipcheck
