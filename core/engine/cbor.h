#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "base/json_node.h"

namespace slipcheck::protocol {

using Bytes = std::vector<std::uint8_t>;

/// A JSON value of these bytes; nlohmann's own binary() is broken where its allocation fails.
nlohmann::json byte_string(Bytes bytes);

/// What came in does not keep to the protocol.
using Rubbish = BadJson;

/// Reads one CBOR item (RFC 8949) from bytes that nobody vouches for; throws Rubbish.
/// Accepted: definite lengths, at most 16 levels of nesting and 4 million items, no tags, nothing
/// after the item.
nlohmann::json read_cbor(std::span<const std::uint8_t> bytes);

}  // namespace slipcheck::protocol
