#pragma once

#include <string>
#include <vector>

#include "harness/compare/record.h"
#include "report/rows/text_table.h"

namespace slipcheck {

/// One statistic of a run beside what is expected of it, as text for people.
struct ExpectationRow {
  std::string name;       ///< "i-j.restitution"
  std::string statistic;  ///< "max"; empty where nothing of it is to be seen
  Cell value;             ///< "1.098", in the limits' unit; "–" where no phase shows it
  Cell limits;            ///< "1.080 … 1.110", "82.00 … 84.00 ms", "not seen"
  bool met = false;
  std::string note;  ///< which phases are missing, where that matters
};

/// One row for each statistic that the scene expects of a run; none for a run that is not ok.
std::vector<ExpectationRow> expectation_rows(const EngineRecord& run);

/// They beside each other, with notes.
TextTable expectation_table(const EngineRecord& run);

/// "as expected", "NOT AS EXPECTED"
const char* expectation_word(bool met);

/// The run's status for people beside what was expected of it: "unstable", "unstable, as expected",
/// "crashed, NOT AS EXPECTED (unstable)", "within", "UNDECIDED", "DEVIATES", "as expected".
std::string outcome_text(const EngineRecord& run);

/// The first thing that the run does not do as expected: "i-j.restitution max 0.9100", with the
/// limits ", expected 1.080 … 1.110"; empty where there is nothing.
std::string unmet_expectation(const EngineRecord& run, bool with_limits);

/// Whether all runs are judged by what is expected of them: then the scene's verdict says "as
/// expected" rather than "within".
bool is_judged_by_expectations(const SceneRecord& scene);

}  // namespace slipcheck
