#include "report/files/file_stem.h"

#include <fmt/format.h>

namespace slipcheck {
namespace {

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
         c == '_' || c == '-';
}

// Longer names are cut; file systems take 255 bytes, of which a suffix needs some.
constexpr std::size_t kLongest = 120;

}  // namespace

std::string file_stem(std::string_view name, std::set<std::string>& taken) {
  std::string stem;
  for (char c : name.substr(0, kLongest))
    if (is_plain(c))
      stem += c;
    else if (!stem.ends_with('-'))
      stem += '-';
  if (stem.empty()) stem = "unnamed";
  if (stem.front() == '.') stem.front() = '-';
  std::string result = stem;
  for (int number = 2; !taken.insert(result).second; ++number)
    result = fmt::format("{}-{}", stem, number);
  return result;
}

}  // namespace slipcheck
