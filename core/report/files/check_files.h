#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "report/files/junit.h"
#include "report/rows/check_rows.h"

namespace slipcheck {

/// "slipcheck-check/1" (docs/ci.md): every change with all digits [SI].
nlohmann::ordered_json json_of(const CheckReport& report);

/// A check as tests, one for each scene's reference and each of its runs. A failure's message has
/// scene, run, observable, old and new value and what is allowed.
std::vector<TestOutcome> test_outcomes(const CheckReport& report);

/// What a pull request's comment or a job's summary says of a check, within `most` bytes, as of a
/// run (markdown.h); what does not fit is counted.
std::string markdown_of(const CheckReport& report, std::size_t most = 8000);

}  // namespace slipcheck
