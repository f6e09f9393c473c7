#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace slipcheck {

/// A file is not read; what() is the rule that it breaks, "must be a regular file".
class UnreadFile : public std::runtime_error {
 public:
  UnreadFile(const std::string& rule, int error) : std::runtime_error(rule), error_(error) {}
  int error() const { return error_; }  ///< of the system; 0 where the file is of the wrong kind

 private:
  int error_;
};

/// How large a file may be that is read as a whole.
struct FileLimit {
  std::size_t bytes;
  const char* name = "";  ///< in messages, "result files"; may be empty
};

inline constexpr FileLimit kResultFileLimit{std::size_t{512} << 20, "result files"};
inline constexpr FileLimit kBaselineFileLimit{std::size_t{64} << 20, "baseline files"};

/// The bytes of a file. Throws UnreadFile, without blocking, for what is not a readable regular
/// file within the limit: no pipe, no device.
std::string read_regular_file(const std::filesystem::path& path, const FileLimit& limit);

}  // namespace slipcheck
