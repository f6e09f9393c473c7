#pragma once

#include <string>
#include <string_view>

namespace slipcheck {

/// Base64 with padding, of any bytes.
std::string base64_of(std::string_view bytes);

/// Compressed by zlib, in its own format (RFC 1950), which browsers call "deflate".
std::string deflated(std::string_view bytes);

/// "sha256-…", by which a page's policy names the one script that may run.
std::string source_hash(std::string_view script);

}  // namespace slipcheck
