#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/compare/record.h"
#include "report/rows/report_content.h"
#include "report/rows/text_table.h"

namespace slipcheck {

/// Text as Markdown shows it literally, inside a table too.
std::string markdown_escaped(const std::string& text);

/// A table of GitHub-flavoured Markdown; cells are escaped, those that a row lacks are empty.
std::string markdown_table(const TextTable& table);

/// What a pull request's comment or a job's summary says of a run within `most` characters, so that
/// it fits on a screen: the finding, what failed, what has moved, the worst deviations, a table of
/// scores; the scenes one by one are folded, and what does not fit is counted.
std::string markdown_of(const std::vector<SceneRecord>& scenes,
                        const std::optional<Moved>& moved = std::nullopt, std::size_t most = 8000);

/// Engines beside each other over all scenes: what that comes to, a score for each, and scenes by
/// engines; one line that says so where there are not two scenes and two engines.
std::string engines_markdown(const std::vector<SceneRecord>& scenes);

}  // namespace slipcheck
