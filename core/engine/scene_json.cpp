#include "engine/scene_json.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "engine/cbor.h"
#include "engine/contact_json.h"
#include "engine/message_fields.h"
#include "engine/soft_json.h"
#include "engine/surface_json.h"

namespace slipcheck {
namespace protocol {

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

std::vector<BodyState> unpack_states(const JsonNode& node) {
  const Bytes& bytes = node.bytes();
  if (bytes.size() % kStateBytes != 0)
    node.fault_alone(
        fmt::format("has {} bytes, must be a multiple of {}", bytes.size(), kStateBytes));
  std::vector<BodyState> states;
  states.reserve(bytes.size() / kStateBytes);
  for (std::size_t at = 0; at < bytes.size(); at += kStateBytes)
    states.push_back(read_state(bytes.data() + at));
  return states;
}

}  // namespace protocol

// --- fields --------------------------------------------------------------------------------------

template <>
inline constexpr std::array kNamesOf<Shape> = {"sphere", "block", "cylinder"};
template <>
inline constexpr std::array kNamesOf<SubstrateMotion::Kind> = {"still", "constant", "oscillation",
                                                               "table"};

namespace {

template <class Fields>
void describe_vector(Fields& f, const char* key, Vector2& vector) {
  std::pair<double, double> xy(vector.x(), vector.y());
  f(key, xy);
  if constexpr (Fields::kReads) vector = {xy.first, xy.second};
}

template <class Fields, class List>
void describe_unless_empty(Fields& f, const char* key, List& list) {
  if constexpr (Fields::kReads)
    f.if_any(key, list);
  else if (!list.empty())
    f(key, list);
}

/// Bodies and their materials go over one by one.
struct MaterialBody {
  Sphere sphere;
  std::size_t material = 0;
  std::optional<Extent> extent;
};

/// A sphere of many: radius, mass and shape factor as float64, and the material as u32.
constexpr std::size_t kPackedBytes = 3 * 8 + 4;

protocol::Bytes packed_bodies(const Scene& scene) {
  protocol::Bytes bytes;
  bytes.reserve(scene.bodies.size() * kPackedBytes);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Sphere& body = scene.bodies[i];
    for (const double value : {body.radius, body.mass, body.shape_factor})
      protocol::append_f64(bytes, value);
    protocol::append_u32(bytes, static_cast<std::uint32_t>(scene.material[i]));
  }
  return bytes;
}

void unpack_bodies(const JsonNode& node, Scene& scene) {
  const protocol::Bytes& bytes = node.bytes();
  if (bytes.size() % kPackedBytes != 0)
    node.fault_alone(
        fmt::format("has {} bytes, must be a multiple of {}", bytes.size(), kPackedBytes));
  scene.bodies.reserve(bytes.size() / kPackedBytes);
  scene.material.reserve(bytes.size() / kPackedBytes);
  for (std::size_t at = 0; at < bytes.size(); at += kPackedBytes) {
    const std::uint8_t* const from = bytes.data() + at;
    const Sphere body{protocol::read_f64(from), protocol::read_f64(from + 8),
                      protocol::read_f64(from + 16)};
    for (const double value : {body.radius, body.mass, body.shape_factor})
      if (!(value >= kTiny && std::isfinite(value)))
        node.fault_alone(
            fmt::format("has {} in body {}, must be finite and > 0", value, at / kPackedBytes));
    scene.bodies.push_back(body);
    scene.material.push_back(protocol::read_u32(from + 24));
  }
}

std::vector<SubstrateMotion::Point> motion_points(const JsonNode& node) {
  std::vector<SubstrateMotion::Point> points;
  for (const JsonNode& row : node.items()) {
    const std::vector<double> point = row.numbers(3);
    if (!points.empty() && point[0] <= points.back().time)
      row.items()[0].fault("must be above the one before");
    points.push_back({point[0], {point[1], point[2]}});
  }
  if (points.empty()) node.fault("must have a point");
  return points;
}

}  // namespace

template <class Fields>
void describe(Fields& f, SubstrateContact& contact) {
  f("kinetic_friction", contact.kinetic_friction, kNotBelowZero);
  f("static_friction", contact.static_friction, NumberRange{contact.kinetic_friction});
  if constexpr (Fields::kReads) {
    contact.rolling = RollingFriction(friction_points(f["rolling"]));
  } else {
    f("rolling", rows_of(contact.rolling));
  }
  f("drilling_length", contact.drilling_length, kNotBelowZero);
  f("coupled_radius", contact.coupled_radius, kNotBelowZero);
  f("hertzian_pressure", contact.hertzian_pressure);
  f("rolling_while_sliding", contact.rolling_while_sliding);
  f("restitution", contact.restitution, NumberRange{0, 1});
}

template <class Fields>
void describe(Fields& f, MaterialBody& body) {
  f("radius", body.sphere.radius, kAboveZero);
  f("mass", body.sphere.mass, kAboveZero);
  f("shape_factor", body.sphere.shape_factor, kAboveZero);
  f("material", body.material);
  f.unless("shape", body.sphere.shape, Shape::sphere);
  const bool is_solid = body.sphere.shape != Shape::sphere;
  if (is_solid) {
    Extent extent = body.extent.value_or(Extent{});
    std::vector<double> size(extent.size.begin(), extent.size.end());
    f("size", size);
    describe_vector(f, "axis", extent.axis);
    if constexpr (Fields::kReads) {
      if (size.size() != 3 || !(*std::ranges::min_element(size) > 0))
        f["size"].fault("must hold three lengths > 0");
      extent.size = {size[0], size[1], size[2]};
      body.extent = extent;
    }
  }
}

template <class Fields>
void describe(Fields& f, SubstrateMotion& motion) {
  using enum SubstrateMotion::Kind;
  SubstrateMotion::Kind kind = motion.kind();
  Vector2 vector = motion.vector();
  double frequency = motion.frequency(), phase = motion.phase();
  f("kind", kind);
  if (kind == constant) describe_vector(f, "velocity", vector);
  if (kind == oscillation) {
    describe_vector(f, "amplitude", vector);
    f("frequency", frequency, kAboveZero);
    f("phase", phase);
  }
  if constexpr (Fields::kReads) {
    motion = kind == constant      ? SubstrateMotion::constant(vector)
             : kind == oscillation ? SubstrateMotion::oscillation(vector, frequency, phase)
             : kind == table       ? SubstrateMotion::table(motion_points(f["points"]))
                                   : SubstrateMotion();
  } else if (kind == table) {
    std::vector<std::vector<double>> points;
    for (const auto& [time, position] : motion.points())
      points.push_back({time, position.x(), position.y()});
    f("points", points);
  }
}

template <class Fields>
void describe(Fields& f, ShakenFloor& floor) {
  f("amplitude", floor.amplitude, kNotBelowZero);
  f("frequency", floor.frequency, kNotBelowZero);
}

template <class Fields>
void describe(Fields& f, Box& box) {
  f("width", box.width, kAboveZero);
  f("floor", box.floor);
  f("moving_walls", box.moving_walls);
  f("lid", box.lid);
  f("on_floor", box.on_floor);
  f("on_wall", box.on_wall);
  f("on_lid", box.on_lid);
  if constexpr (Fields::kReads)
    if (box.lid && !(*box.lid > 0)) f["lid"].fault("must be > 0");
}

/// packed: the bodies are to be written so.
template <class Fields>
void describe_scene(Fields& f, Scene& scene, bool packed) {
  std::vector<MaterialBody> bodies;
  if constexpr (Fields::kReads) packed = f.has("packed_bodies");
  if (packed) {
    if constexpr (Fields::kReads)
      unpack_bodies(f["packed_bodies"], scene);
    else
      f("packed_bodies", protocol::byte_string(packed_bodies(scene)));
  } else {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
      bodies.push_back({scene.bodies[i], scene.material[i],
                        scene.extents.empty() ? std::nullopt : scene.extents[i]});
    f("bodies", bodies);
  }
  f("substrate", scene.substrate);
  f("pairs", scene.pairs);
  f("gravity", scene.gravity, kNotBelowZero);
  describe_vector(f, "downhill", scene.downhill);
  f("motion", scene.motion);
  f("confined", scene.confined);
  describe_vector(f, "periodic", scene.periodic);
  f("box", scene.box);
  f.unless("has_substrate", scene.has_substrate, true);
  describe_unless_empty(f, "surfaces", scene.surfaces);
  describe_unless_empty(f, "on_surfaces", scene.on_surfaces);
  if constexpr (Fields::kReads) {
    for (const MaterialBody& body : bodies) {
      scene.bodies.push_back(body.sphere);
      scene.material.push_back(body.material);
      if (!body.extent) continue;
      scene.extents.resize(bodies.size());
      scene.extents[scene.bodies.size() - 1] = body.extent;
    }
    scene.initial = protocol::unpack_states(f["initial"]);
  } else {
    f("initial", protocol::byte_string(protocol::pack_states(scene.initial)));
  }
}

template <class Fields>
void describe(Fields& f, EngineScene& scene) {
  describe_scene(f, scene, scene.packed);
  f("soft", scene.soft);
}

namespace protocol {
namespace {

void check_soft_sizes(const JsonNode& node, const Scene& scene, const SoftContacts& soft) {
  const std::size_t materials = scene.substrate.size();
  check_size(node["pairs"], soft.pairs.size(), materials * materials, "pairs of materials");
  if (node.has("on_surfaces"))
    check_size(node["on_surfaces"], soft.surfaces.size(), scene.on_surfaces.size(),
               "materials on surfaces");
  const std::size_t surfaces = scene.box ? materials : 0;
  for (const auto& [key, contacts] : {std::pair{"on_floor", &soft.box.on_floor},
                                      {"on_wall", &soft.box.on_wall},
                                      {"on_lid", &soft.box.on_lid}})
    check_size(node[key], contacts->size(), surfaces, "materials in a box");
}

void check_surfaces(const JsonNode& node, const Scene& scene) {
  const std::size_t count = scene.substrate.size() * scene.surfaces.size();
  if (count > 0 || !scene.on_surfaces.empty())
    check_size(node["on_surfaces"], scene.on_surfaces.size(), count, "materials on surfaces");
  const bool is_beside = !scene.surfaces.empty() || !scene.has_substrate;
  if (scene.box && is_beside) node["box"].fault_alone("must stand alone, without surfaces");
}

}  // namespace

json scene_to_json(const EngineScene& scene) { return message_json(scene); }

EngineScene scene_from_json(const JsonNode& node) {
  auto scene = read_finite<EngineScene>(node);
  const std::size_t materials = scene.substrate.size();
  if (materials == 0) node["substrate"].fault("must have an entry");
  const char* const bodies = node.has("packed_bodies") ? "packed_bodies" : "bodies";
  if (scene.bodies.empty()) node[bodies].fault("must have an entry");
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    if (scene.material[i] >= materials) {
      if (node.has("packed_bodies"))
        node[bodies].fault_alone(fmt::format("has the material {} in body {}, must be below {}",
                                             scene.material[i], i, materials));
      node[bodies].items()[i]["material"].fault(fmt::format("must be below {}", materials));
    }
  check_size(node["pairs"], scene.pairs.size(), materials * materials, "pairs of materials");
  check_size(node["initial"], scene.initial.size(), scene.bodies.size(), "bodies");
  if (scene.periodic.minCoeff() < 0) node["periodic"].fault("must hold lengths >= 0");
  if (scene.box)
    for (const auto& [key, contacts] : {std::pair{"on_floor", &scene.box->on_floor},
                                        {"on_wall", &scene.box->on_wall},
                                        {"on_lid", &scene.box->on_lid}})
      check_size(node["box"][key], contacts->size(), materials, "materials");
  check_surfaces(node, scene);
  if (scene.soft) check_soft_sizes(node["soft"], scene, *scene.soft);
  return scene;
}

}  // namespace protocol
}  // namespace slipcheck
