#include "engine/scene_json.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace slipcheck::protocol {

using nlohmann::json;

namespace {

// Numbers go over as they lie in memory: frames are many, and byte by byte takes longer than the
// steps themselves.
static_assert(std::endian::native == std::endian::little);
static_assert(sizeof(BodyState) == kStateBytes && sizeof(Vector3) == 3 * sizeof(double));

void append(Bytes& bytes, const void* data, std::size_t size) {
  const auto* begin = static_cast<const std::uint8_t*>(data);
  bytes.insert(bytes.end(), begin, begin + size);
}

template <class T>
T copy(const std::uint8_t* at) {
  T value;
  std::memcpy(static_cast<void*>(&value), at, sizeof value);
  return value;
}

constexpr double kTiny = std::numeric_limits<double>::min();  // stands for "> 0"
constexpr double kHuge = std::numeric_limits<double>::max();

json to_json(const RollingFriction& rolling) {
  json table = json::array();
  for (const RollingFriction::Point& point : rolling.points()) {
    table.push_back({point.speed, point.coefficient});
  }
  return table;
}

RollingFriction rolling_from_json(const json& table, const std::string& place) {
  std::vector<RollingFriction::Point> points;
  for (const json& row : table) {
    if (!row.is_array() || row.size() != 2 || !row[0].is_number() || !row[1].is_number()) {
      throw Rubbish(fmt::format("{}: a point is not [speed, coefficient]", place));
    }
    const RollingFriction::Point point = {row[0].get<double>(), row[1].get<double>()};
    const bool in_range = std::isfinite(point.speed) && point.speed >= 0 &&
                          std::isfinite(point.coefficient) && point.coefficient >= 0;
    if (!in_range) throw Rubbish(fmt::format("{}: a point is out of range", place));
    if (!points.empty() && point.speed <= points.back().speed) {
      throw Rubbish(fmt::format("{}: the speeds do not rise", place));
    }
    points.push_back(point);
  }
  if (points.empty()) throw Rubbish(fmt::format("{} has no point", place));
  return RollingFriction(std::move(points));
}

json to_json(const RestitutionLaw& law) {
  if (const double* e = std::get_if<double>(&law)) return *e;
  const auto& power = std::get<PowerLawRestitution>(law);
  return {{"coefficient", power.coefficient}, {"exponent", power.exponent}, {"speed", power.speed}};
}

RestitutionLaw restitution_from_json(const Fields& pair) {
  if (!pair.member("restitution").is_object()) return pair.number("restitution", 0, 1);
  const Fields power(pair.object("restitution"), pair.place_of("restitution"));
  return PowerLawRestitution{power.number("coefficient", kTiny), power.number("exponent", 0),
                             power.number("speed", kTiny)};
}

}  // namespace

void append_u32(Bytes& bytes, std::uint32_t value) { append(bytes, &value, sizeof value); }

void append_f64(Bytes& bytes, double value) { append(bytes, &value, sizeof value); }

void append_state(Bytes& bytes, const BodyState& state) { append(bytes, &state, sizeof state); }

std::uint32_t read_u32(const std::uint8_t* at) { return copy<std::uint32_t>(at); }

double read_f64(const std::uint8_t* at) { return copy<double>(at); }

BodyState read_state(const std::uint8_t* at) { return copy<BodyState>(at); }

Bytes pack_states(std::span<const BodyState> states) {
  Bytes bytes;
  bytes.reserve(states.size() * kStateBytes);
  for (const BodyState& state : states) append_state(bytes, state);
  return bytes;
}

std::vector<BodyState> unpack_states(const Bytes& bytes, const std::string& place) {
  if (bytes.size() % kStateBytes != 0) {
    throw Rubbish(
        fmt::format("{} has {} bytes, no multiple of {}", place, bytes.size(), kStateBytes));
  }
  std::vector<BodyState> states;
  states.reserve(bytes.size() / kStateBytes);
  for (std::size_t at = 0; at < bytes.size(); at += kStateBytes) {
    states.push_back(read_state(bytes.data() + at));
  }
  return states;
}

json scene_to_json(const HardScene& scene) {
  json bodies = json::array();
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Sphere& body = scene.bodies[i];
    bodies.push_back({{"radius", body.radius},
                      {"mass", body.mass},
                      {"shape_factor", body.shape_factor},
                      {"material", scene.material[i]}});
  }
  json substrate = json::array();
  for (const SubstrateContact& contact : scene.substrate) {
    substrate.push_back({{"static_friction", contact.static_friction},
                         {"kinetic_friction", contact.kinetic_friction},
                         {"rolling", to_json(contact.rolling)},
                         {"drilling_length", contact.drilling_length},
                         {"restitution", contact.restitution}});
  }
  json pairs = json::array();
  for (const PairContact& pair : scene.pairs) {
    pairs.push_back({{"restitution", to_json(pair.restitution)},
                     {"friction", pair.friction},
                     {"tangential_restitution", pair.tangential_restitution}});
  }
  return {
      {"bodies", std::move(bodies)},       {"initial", json::binary(pack_states(scene.initial))},
      {"substrate", std::move(substrate)}, {"pairs", std::move(pairs)},
      {"gravity", scene.gravity},          {"confined", scene.confined}};
}

HardScene scene_from_json(const json& object) {
  const Fields fields(object, "scene");
  HardScene scene;
  for (const json& each : fields.list("substrate")) {
    const Fields contact(each, fmt::format("scene.substrate[{}]", scene.substrate.size()));
    SubstrateContact out;
    out.kinetic_friction = contact.number("kinetic_friction", 0);
    out.static_friction = contact.number("static_friction", out.kinetic_friction);
    out.rolling = rolling_from_json(contact.list("rolling"), contact.place_of("rolling"));
    out.drilling_length = contact.number("drilling_length", 0);
    out.restitution = contact.number("restitution", 0, 1);
    scene.substrate.push_back(std::move(out));
  }
  if (scene.substrate.empty()) throw Rubbish("scene.substrate is empty");

  for (const json& each : fields.list("bodies")) {
    const Fields body(each, fmt::format("scene.bodies[{}]", scene.bodies.size()));
    scene.bodies.push_back({body.number("radius", kTiny, kHuge), body.number("mass", kTiny, kHuge),
                            body.number("shape_factor", kTiny, kHuge)});
    scene.material.push_back(body.count("material", scene.substrate.size() - 1));
  }
  if (scene.bodies.empty()) throw Rubbish("scene.bodies is empty");

  for (const json& each : fields.list("pairs")) {
    const Fields pair(each, fmt::format("scene.pairs[{}]", scene.pairs.size()));
    scene.pairs.push_back({restitution_from_json(pair), pair.number("friction", 0),
                           pair.number("tangential_restitution", -1, 1)});
  }
  if (scene.pairs.size() != scene.substrate.size() * scene.substrate.size()) {
    throw Rubbish(fmt::format("scene.pairs has {} entries for {} materials", scene.pairs.size(),
                              scene.substrate.size()));
  }
  scene.initial = unpack_states(fields.bytes("initial"), "scene.initial");
  if (scene.initial.size() != scene.bodies.size()) {
    throw Rubbish(fmt::format("scene.initial has {} states for {} bodies", scene.initial.size(),
                              scene.bodies.size()));
  }
  scene.gravity = fields.number("gravity", 0);
  scene.confined = fields.flag("confined");
  return scene;
}

}  // namespace slipcheck::protocol
