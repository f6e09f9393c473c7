#pragma once

#include "harness/compare/record.h"
#include "report/rows/text_table.h"

namespace slipcheck {

/// What a run that was looked at as a whole shows over its second half, beside the reference where
/// that was not left out: means with standard errors [SI]. The run has an assembly.
TextTable whole_table(const SceneRecord& scene, const EngineRecord& run);

}  // namespace slipcheck
