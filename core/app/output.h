#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "report/charts/gnuplot.h"
#include "report/terminal/table_style.h"

namespace slipcheck {

/// What cannot be written in the end is refused before anything runs: throws BadOption with the
/// option, the rule and the path. No path is not written, and - is stdout.
void check_output(const std::string& option, const std::filesystem::path& path, bool is_directory);

/// Writes what --json asks for: nothing without a path, - to stdout.
void write_json(const std::string& path, const std::function<std::string()>& text);

/// Draws charts into a folder beside other results: why some are missing is told on stderr, and is
/// no failure. Throws WriteFailure.
ChartDrawings write_charts_if_drawn(const std::filesystem::path& folder,
                                    const std::vector<Chart>& charts);

/// How tables look on stdout: as wide as COLUMNS says, else as the terminal is; where it is none
/// they have all columns, and text is 100 wide. `all`: with what is else left out.
TableStyle table_style(bool all = false);

}  // namespace slipcheck
