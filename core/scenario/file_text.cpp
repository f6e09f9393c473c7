#include "scenario/file_text.h"

#include <fmt/format.h>
#include <nettle/sha2.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/regular_file.h"
#include "base/text.h"
#include "scenario/fault.h"

namespace slipcheck {
namespace {

[[noreturn]] void refuse(const std::string& file, const std::string& rule, Location location = {}) {
  throw BadScenario({{file, location, "", rule, ""}});
}

}  // namespace

std::string read_file(const std::filesystem::path& path) {
  try {
    return read_regular_file(path, {kMostBytes});
  } catch (const UnreadFile& bad) {
    refuse(path.string(), bad.what());
  }
}

std::string_view checked_text(std::string_view bytes, const std::string& file,
                              const char* content) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (bytes.starts_with(kByteOrderMark)) bytes.remove_prefix(kByteOrderMark.size());
  if (bytes.size() > kMostBytes)
    refuse(file, fmt::format("must have at most {} bytes", kMostBytes));
  Location place{1, 1};
  for (std::string_view rest = bytes; !rest.empty();) {
    const auto first = static_cast<unsigned char>(rest[0]);
    if (!take_code_point(rest)) {
      refuse(file, fmt::format("must be UTF-8 text, got byte 0x{:02x}", first), place);
    }
    if ((first < 0x20 && first != '\t' && first != '\n' && first != '\r') || first == 0x7F) {
      refuse(file, fmt::format("must be text, got control character 0x{:02x}", first), place);
    }
    if (first == '\n') {
      place = {place.line + 1, 1};
    } else {
      ++place.column;
    }
  }
  if (bytes.empty()) refuse(file, fmt::format("must hold a {}, but is empty", content));
  return bytes;
}

std::string sha256_hex(std::string_view bytes) {
  sha256_ctx context;
  sha256_init(&context);
  std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest;
  sha256_update(&context, bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data()));
  sha256_digest(&context, digest.size(), digest.data());
  std::string hex;
  for (const std::uint8_t byte : digest) hex += fmt::format("{:02x}", byte);
  return hex;
}

}  // namespace slipcheck
