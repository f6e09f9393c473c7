#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace slipcheck {

/// What became of a program that has ended.
struct ProgramEnd {
  int exit_code = 0;  ///< 128 + the signal's number where a signal ended it
  std::string said;   ///< on standard output and standard error, as it came
};

/// Runs a program, the first of `words`, found by PATH where it is no path, in a folder to its end;
/// there is nothing for it to read. Throws std::system_error where it cannot be started, with
/// ENOENT where it is not there.
ProgramEnd run_program(std::vector<std::string> words, const std::filesystem::path& folder);

/// A folder of its own among the system's temporary ones, or in `parent`, that goes away with all
/// that is in it. Throws std::system_error.
class TemporaryFolder {
 public:
  /// `name` is the beginning of its name.
  explicit TemporaryFolder(const std::string& name, const std::filesystem::path& parent =
                                                        std::filesystem::temp_directory_path());
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace slipcheck
