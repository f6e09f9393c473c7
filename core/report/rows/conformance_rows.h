#pragma once

#include <string>

#include "report/rows/text_table.h"
#include "studies/conformance/conformance.h"

namespace slipcheck {

/// A row for each check of a worker; what to mend is a note of its row.
TextTable conformance_table(const ConformanceReport& report);

/// "38 passed, 1 failed, 2 not judged"
std::string conformance_counts(const ConformanceReport& report);

}  // namespace slipcheck
