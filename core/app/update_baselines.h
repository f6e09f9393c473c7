#pragma once

#include <filesystem>
#include <string>

#include "report/rows/check_rows.h"
#include "studies/baseline/update.h"

namespace slipcheck {

/// The line that tells of an update: date, versions, how much has moved, the largest move, and why.
std::string changes_line(const BaselineUpdate& update, const CheckReport& report,
                         const std::string& engines, const std::string& why);

/// What the file of `--changes` says so far; empty where there is none. Throws UnreadFile.
std::string changes_text(const std::filesystem::path& file);

/// Writes the files of an update, removes what is left over, and appends the line to `changes`.
/// Throws WriteFailure and UnreadFile.
void write_update(const BaselineUpdate& update, const std::filesystem::path& folder,
                  const std::filesystem::path& changes, const std::string& line);

}  // namespace slipcheck
