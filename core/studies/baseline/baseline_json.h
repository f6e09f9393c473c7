#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "studies/baseline/baseline.h"

namespace slipcheck {

/// A baseline's file cannot be used; the message gives file, place, rule and value.
class BadBaseline : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The baseline as a file of "slipcheck-baseline/1": JSON with a line for each observable, so that
/// a difference of two is readable, and numbers that read back as the very same.
std::string baseline_text(const SceneBaseline& baseline);

/// Reads such a file's text; `file` names it in messages. Throws BadBaseline.
SceneBaseline parse_baseline(const std::string& text, const std::string& file);

/// The file of a scene's baseline in a folder.
std::filesystem::path baseline_file(const std::filesystem::path& folder, const std::string& scene);

}  // namespace slipcheck
