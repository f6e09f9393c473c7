#include "engine/scene_json.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <limits>
#include <utility>

#include "engine/contact_json.h"

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

constexpr double kHuge = std::numeric_limits<double>::max();

// --- the substrate's motion ----------------------------------------------------------------------

json to_json(const Vector2& v) { return {v.x(), v.y()}; }

Vector2 vector2_from_json(const Fields& fields, const char* key) {
  const std::vector<double> numbers = fields.numbers(key);
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
    const std::vector<double> point = finite_numbers(row, place);
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

// --- the box -------------------------------------------------------------------------------------

json to_json(const Box& box) {
  json out = {{"width", box.width},
              {"floor", {{"amplitude", box.floor.amplitude}, {"frequency", box.floor.frequency}}},
              {"moving_walls", box.moving_walls},
              {"on_floor", pairs_to_json(box.on_floor)},
              {"on_wall", pairs_to_json(box.on_wall)},
              {"on_lid", pairs_to_json(box.on_lid)}};
  if (box.lid) out["lid"] = *box.lid;
  return out;
}

std::vector<PairContact> surface_from_json(const Fields& box, const char* key,
                                           std::size_t materials) {
  std::vector<PairContact> contacts = pairs_from_json(box, key);
  if (contacts.size() != materials) {
    throw Rubbish(fmt::format("{} has {} entries for {} materials", box.place_of(key),
                              contacts.size(), materials));
  }
  return contacts;
}

Box box_from_json(const Fields& fields, std::size_t materials) {
  Box box;
  box.width = fields.number("width", kTiny);
  const Fields floor(fields.object("floor"), fields.place_of("floor"));
  box.floor = {floor.number("amplitude", 0), floor.number("frequency", 0)};
  box.moving_walls = fields.flag("moving_walls");
  if (fields.has("lid")) box.lid = fields.number("lid", kTiny);
  box.on_floor = surface_from_json(fields, "on_floor", materials);
  box.on_wall = surface_from_json(fields, "on_wall", materials);
  box.on_lid = surface_from_json(fields, "on_lid", materials);
  return box;
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

json scene_to_json(const Scene& scene) {
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
    substrate.push_back(contact_to_json(contact));
  }
  json out = {
      {"bodies", std::move(bodies)},        {"initial", json::binary(pack_states(scene.initial))},
      {"substrate", std::move(substrate)},  {"pairs", pairs_to_json(scene.pairs)},
      {"gravity", scene.gravity},           {"downhill", to_json(scene.downhill)},
      {"motion", to_json(scene.motion)},    {"confined", scene.confined},
      {"periodic", to_json(scene.periodic)}};
  if (scene.box) out["box"] = to_json(*scene.box);
  return out;
}

Scene scene_from_json(const json& object) {
  const Fields fields(object, "scene");
  Scene scene;
  for (const json& each : fields.list("substrate")) {
    const Fields contact(each, fmt::format("scene.substrate[{}]", scene.substrate.size()));
    scene.substrate.push_back(substrate_contact_from_json(contact));
  }
  if (scene.substrate.empty()) throw Rubbish("scene.substrate is empty");

  for (const json& each : fields.list("bodies")) {
    const Fields body(each, fmt::format("scene.bodies[{}]", scene.bodies.size()));
    scene.bodies.push_back({body.number("radius", kTiny, kHuge), body.number("mass", kTiny, kHuge),
                            body.number("shape_factor", kTiny, kHuge)});
    scene.material.push_back(body.count("material", scene.substrate.size() - 1));
  }
  if (scene.bodies.empty()) throw Rubbish("scene.bodies is empty");

  scene.pairs = pairs_from_json(fields, "pairs");
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
  scene.periodic = vector2_from_json(fields, "periodic");
  if (scene.periodic.minCoeff() < 0) throw Rubbish("scene.periodic holds a length below 0");
  if (fields.has("box")) {
    scene.box =
        box_from_json(Fields(fields.object("box"), fields.place_of("box")), scene.substrate.size());
  }
  return scene;
}

}  // namespace slipcheck::protocol
