#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/json_node.h"
#include "report/rows/report_content.h"

namespace slipcheck {

struct ReadResults {
  ReportContent content;  ///< without commands; where contexts differ it lists them
  /// Files that have no part in it, each with the reason, in the order in which they were met.
  std::vector<std::string> ignored;
};

/// Reads the JSON files of these folders, by name, and files that are named themselves: results,
/// motions, precision and stability. Files of folders that are nothing of that are ignored.
///
/// Throws BadJson for what is not there or cannot be read, faulty files and those of newer
/// versions, a scene that occurs twice, and paths that hold no result.
ReadResults read_folders(const std::vector<std::filesystem::path>& paths);

}  // namespace slipcheck
