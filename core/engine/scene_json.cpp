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

std::vector<double> numbers_from_json(const json& list, const std::string& place) {
  if (!list.is_array()) throw Rubbish(place + " is not a list");
  std::vector<double> numbers;
  numbers.reserve(list.size());
  for (const json& value : list) {
    if (!value.is_number() || !std::isfinite(value.get<double>())) {
      throw Rubbish(place + " holds something that is not a finite number");
    }
    numbers.push_back(value.get<double>());
  }
  return numbers;
}

std::vector<double> numbers_from_json(const Fields& fields, const char* key) {
  return numbers_from_json(fields.list(key), fields.place_of(key));
}

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

json to_json(double restitution) { return restitution; }
json to_json(const PowerLawRestitution& law) {
  return {{"coefficient", law.coefficient}, {"exponent", law.exponent}, {"speed", law.speed}};
}
json to_json(const TabulatedRestitution& table) {
  return {{"log_first", table.log_first},
          {"log_step", table.log_step},
          {"log_odds", table.log_odds},
          {"slope", table.slope}};
}

RestitutionLaw restitution_from_json(const Fields& pair) {
  if (!pair.member("restitution").is_object()) return pair.number("restitution", 0, 1);
  const json& object = pair.object("restitution");
  const Fields law(object, pair.place_of("restitution"));
  if (!object.contains("log_odds")) {
    return PowerLawRestitution{law.number("coefficient", kTiny), law.number("exponent", 0),
                               law.number("speed", kTiny)};
  }
  TabulatedRestitution table{law.number("log_first"), law.number("log_step", kTiny),
                             numbers_from_json(law, "log_odds"), numbers_from_json(law, "slope")};
  if (table.log_odds.empty()) throw Rubbish(law.place_of("log_odds") + " is empty");
  if (table.slope.size() != table.log_odds.size()) {
    throw Rubbish(fmt::format("{} has {} entries for {} points", law.place_of("slope"),
                              table.slope.size(), table.log_odds.size()));
  }
  return table;
}

// --- the substrate's motion ----------------------------------------------------------------------

json to_json(const Vector2& v) { return {v.x(), v.y()}; }

Vector2 vector2_from_json(const Fields& fields, const char* key) {
  const std::vector<double> numbers = numbers_from_json(fields, key);
  if (numbers.size() != 2) throw Rubbish(fields.place_of(key) + " is not [x, y]");
  return {numbers[0], numbers[1]};
}

json to_json(const SubstrateMotion& motion) {
  switch (motion.kind()) {
    case SubstrateMotion::Kind::constant:
      return {{"kind", "constant"}, {"velocity", to_json(motion.vector())}};
    case SubstrateMotion::Kind::oscillation:
      return {{"kind", "oscillation"},
              {"amplitude", to_json(motion.vector())},
              {"frequency", motion.frequency()},
              {"phase", motion.phase()}};
    case SubstrateMotion::Kind::table: {
      json points = json::array();
      for (const SubstrateMotion::Point& point : motion.points()) {
        points.push_back({point.time, point.position.x(), point.position.y()});
      }
      return {{"kind", "table"}, {"points", std::move(points)}};
    }
    case SubstrateMotion::Kind::still:
      break;
  }
  return {{"kind", "still"}};
}

std::vector<SubstrateMotion::Point> motion_points_from_json(const Fields& motion) {
  const std::string place = motion.place_of("points");
  std::vector<SubstrateMotion::Point> points;
  for (const json& row : motion.list("points")) {
    const std::vector<double> point = numbers_from_json(row, place);
    if (point.size() != 3) throw Rubbish(place + ": a point is not [time, x, y]");
    if (!points.empty() && point[0] <= points.back().time) {
      throw Rubbish(place + ": the times do not rise");
    }
    points.push_back({point[0], {point[1], point[2]}});
  }
  if (points.empty()) throw Rubbish(place + " is empty");
  return points;
}

SubstrateMotion motion_from_json(const Fields& motion) {
  const std::string kind = motion.text("kind");
  if (kind == "still") return {};
  if (kind == "constant") return SubstrateMotion::constant(vector2_from_json(motion, "velocity"));
  if (kind == "oscillation") {
    return SubstrateMotion::oscillation(vector2_from_json(motion, "amplitude"),
                                        motion.number("frequency", kTiny), motion.number("phase"));
  }
  if (kind == "table") return SubstrateMotion::table(motion_points_from_json(motion));
  throw Rubbish(fmt::format("{} is '{}', no kind of motion", motion.place_of("kind"), kind));
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
                         {"coupled_radius", contact.coupled_radius},
                         {"hertzian_pressure", contact.hertzian_pressure},
                         {"rolling_while_sliding", contact.rolling_while_sliding},
                         {"restitution", contact.restitution}});
  }
  json pairs = json::array();
  for (const PairContact& pair : scene.pairs) {
    pairs.push_back({{"restitution",
                      std::visit([](const auto& law) { return to_json(law); }, pair.restitution)},
                     {"friction", pair.friction},
                     {"tangential_restitution", pair.tangential_restitution}});
  }
  return {
      {"bodies", std::move(bodies)},       {"initial", json::binary(pack_states(scene.initial))},
      {"substrate", std::move(substrate)}, {"pairs", std::move(pairs)},
      {"gravity", scene.gravity},          {"downhill", to_json(scene.downhill)},
      {"motion", to_json(scene.motion)},   {"confined", scene.confined}};
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
    out.coupled_radius = contact.number("coupled_radius", 0);
    out.hertzian_pressure = contact.flag("hertzian_pressure");
    out.rolling_while_sliding = contact.flag("rolling_while_sliding");
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
  scene.downhill = vector2_from_json(fields, "downhill");
  scene.motion = motion_from_json(Fields(fields.object("motion"), fields.place_of("motion")));
  scene.confined = fields.flag("confined");
  return scene;
}

}  // namespace slipcheck::protocol
