#include "scenario/file_text.h"

#include <fmt/format.h>
#include <nettle/sha2.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/regular_file.h"
#include "scenario/fault.h"

namespace slipcheck {
namespace {

[[noreturn]] void refuse(const std::string& file, const std::string& rule, Location location = {}) {
  throw BadScenario({{file, location, "", rule, ""}});
}

/// Length of the well-formed UTF-8 character at the start of `text`, 0 if there is none
/// (Unicode 15, table 3-7).
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const auto continues = [&](std::size_t n) {
    if (text.size() < n) return false;
    for (std::size_t i = 1; i < n; ++i) {
      if ((byte(i) & 0xC0) != 0x80) return false;
    }
    return true;
  };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return continues(2) ? 2 : 0;
  if (first >= 0xE0 && first <= 0xEF) {
    if (!continues(3)) return 0;
    if (first == 0xE0 && byte(1) < 0xA0) return 0;  // longer than needed
    if (first == 0xED && byte(1) > 0x9F) return 0;  // surrogates
    return 3;
  }
  if (first >= 0xF0 && first <= 0xF4) {
    if (!continues(4)) return 0;
    if (first == 0xF0 && byte(1) < 0x90) return 0;
    if (first == 0xF4 && byte(1) > 0x8F) return 0;
    return 4;
  }
  return 0;
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
    const std::size_t length = character_length(rest);
    const auto first = static_cast<unsigned char>(rest[0]);
    if (length == 0) {
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
    rest.remove_prefix(length);
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
