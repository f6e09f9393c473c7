#pragma once

#include "report/rows/text_table.h"
#include "studies/gas/gas_run.h"

namespace slipcheck {

/// The course of a gas: about ten of its samples.
TextTable gas_course(const GasRun& run);

/// What was measured beside theory.
TextTable gas_statements(const GasRun& run);

}  // namespace slipcheck
