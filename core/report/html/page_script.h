#pragma once

#include <string_view>

namespace slipcheck {

/// The page's script with the libraries in it, and their licences; built from
/// core/report/html/page. Both are empty if the program is built without (SLIPCHECK_PAGE_SCRIPT).
extern const std::string_view kPageScript;
extern const std::string_view kPageLicences;

}  // namespace slipcheck
