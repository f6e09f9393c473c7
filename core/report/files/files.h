#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace slipcheck {

/// A file could not be written; the message names it and says why.
class WriteFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Why nothing can be written into a folder, or the folder not be made, "Permission denied"; empty
/// where it can. Tried, since neither a file system nor root keeps to permissions; nothing is left.
std::string why_not_writable(const std::filesystem::path& folder);

/// Writes a whole file or nothing: under a temporary name beside it, which then takes its place.
/// Who reads the file at any moment, or after a crash, finds the old text or the new one. What is
/// no regular file (a pipe, /dev/stdout) is written to directly. Throws WriteFailure and leaves
/// nothing behind.
void write_file_atomically(const std::filesystem::path& path, std::string_view text);

}  // namespace slipcheck
