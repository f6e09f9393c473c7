// In place of the script where the program is built without Node.js: the page has what it has
// without.
#include "report/html/page_script.h"

namespace slipcheck {

const std::string_view kPageScript;
const std::string_view kPageLicences;

}  // namespace slipcheck
