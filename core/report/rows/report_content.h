#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/compare/record.h"
#include "report/rows/context.h"
#include "report/rows/text_table.h"
#include "studies/precision/precision.h"
#include "studies/stability/limits.h"
#include "studies/stability/stability.h"

namespace slipcheck {

/// What has moved since something else: a sentence, and a table of what.
struct Moved {
  std::string finding;
  TextTable table;
};

/// Everything that a page can show: results just made, or read from folders.
struct ReportContent {
  Context context;                    ///< under which the results came about
  std::vector<std::string> commands;  ///< that the user typed for them
  std::optional<Moved> moved;         ///< shown first
  std::vector<SceneRecord> scenes;
  std::vector<PrecisionScene> precision;
  std::vector<StabilityCase> cases;
  LimitResults limits;
  OutcomeCriteria criteria;  ///< of cases and limits
};

}  // namespace slipcheck
