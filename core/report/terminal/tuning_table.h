#pragma once

#include <string>

#include "report/json/tuning_record.h"
#include "report/terminal/table_style.h"

namespace slipcheck {

/// A tuning for the terminal: every scene and rate before and after, held-out scenes beside those
/// trained on, the trade-off of accuracy and time, the settings that were chosen.
std::string tuning_table(const TuningRecord& tuning, const TableStyle& style);

/// An error in tolerances as "4.31", of a run that failed as "✗ 25 % of phases fail".
std::string tuning_error_text(const RunScore& run);

}  // namespace slipcheck
