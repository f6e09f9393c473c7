#pragma once

#include <filesystem>
#include <string>

namespace slipcheck {

/// What cannot be written in the end is refused before anything runs: throws BadOption with the
/// option, the rule and the path.
void check_output(const std::string& option, const std::filesystem::path& path, bool is_directory);

/// Columns of the terminal that stdout is; 100 where it is none.
int terminal_width();

}  // namespace slipcheck
