#include "report/html/packed_text.h"

#include <nettle/base64.h>
#include <nettle/sha2.h>
#include <zlib.h>

#include <array>
#include <cstdint>
#include <stdexcept>

namespace slipcheck {
namespace {

const std::uint8_t* bytes_of(std::string_view text) {
  return reinterpret_cast<const std::uint8_t*>(text.data());
}

}  // namespace

std::string base64_of(std::string_view bytes) {
  std::string text(BASE64_ENCODE_RAW_LENGTH(bytes.size()), '\0');
  base64_encode_raw(text.data(), bytes.size(), bytes_of(bytes));
  return text;
}

std::string deflated(std::string_view bytes) {
  uLongf size = compressBound(bytes.size());
  std::string packed(size, '\0');
  auto* out = reinterpret_cast<Bytef*>(packed.data());
  if (compress2(out, &size, bytes_of(bytes), bytes.size(), Z_BEST_COMPRESSION) != Z_OK)
    throw std::runtime_error("zlib cannot compress the page's data");  // out of memory
  packed.resize(size);
  return packed;
}

std::string source_hash(std::string_view script) {
  sha256_ctx context;
  sha256_init(&context);
  sha256_update(&context, script.size(), bytes_of(script));
  std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest;
  sha256_digest(&context, digest.size(), digest.data());
  return "sha256-" + base64_of({reinterpret_cast<const char*>(digest.data()), digest.size()});
}

}  // namespace slipcheck
