#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/cbor.h"
#include "engine/engine_scene.h"

namespace slipcheck::protocol {

/// Size of one body's state: position, velocity and angular velocity as nine little-endian
/// float64.
inline constexpr std::size_t kStateBytes = 9 * 8;

void append_u32(Bytes& bytes, std::uint32_t value);
void append_f64(Bytes& bytes, double value);
void append_state(Bytes& bytes, const BodyState& state);
std::uint32_t read_u32(const std::uint8_t* at);
double read_f64(const std::uint8_t* at);
BodyState read_state(const std::uint8_t* at);

Bytes pack_states(std::span<const BodyState> states);
/// Throws Rubbish where the size is no multiple of kStateBytes. Any float64 passes, NaN too.
std::vector<BodyState> unpack_states(const JsonNode& node);

/// The scene as docs/engine-protocol.md words it.
nlohmann::json scene_to_json(const EngineScene& scene);

/// The inverse; every index and range that EngineScene promises is checked. Throws Rubbish.
EngineScene scene_from_json(const JsonNode& node);

}  // namespace slipcheck::protocol
