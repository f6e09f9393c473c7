#pragma once

#include <string>

#include "report/rows/report_content.h"

namespace slipcheck {

/// Whether a page has its script: charts, replay, filter and sorting. Tables, drawings and texts
/// are there without. A program built without the script has none to include.
enum class PageScript { included, left_out };

/// One page over all that is known: complete in itself, with a policy that forbids it the network
/// and every script but its own.
std::string report_page(const ReportContent& content, PageScript script = PageScript::included);

}  // namespace slipcheck
