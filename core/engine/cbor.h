#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>

#include "engine/fields.h"

namespace slipcheck::protocol {

/// Reads one CBOR item (RFC 8949) from bytes that nobody vouches for; throws Rubbish.
/// Accepted: definite lengths, at most 16 levels of nesting and 4 million items, no tags, nothing
/// after the item.
nlohmann::json read_cbor(std::span<const std::uint8_t> bytes);

}  // namespace slipcheck::protocol
