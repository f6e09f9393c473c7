#include "report/json/motion_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <utility>

#include "base/text.h"
#include "harness/observe/observables.h"

namespace slipcheck {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "slipcheck-motion/1";
constexpr const char* kInfinite = "infinite";  ///< an error, for which JSON has no number

// --- written -------------------------------------------------------------------------------------

/// To nine significant digits; never −0.
Json rounded(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::strtod(fmt::format("{:.9g}", value).c_str(), nullptr) + 0.0;
}

void push(Json& list, const Vector3& vector) {
  for (const double component : vector) list.push_back(rounded(component));
}

Json states_json(const RecordedMotion& motion, Vector3 BodyState::*member) {
  Json frames = Json::array();
  for (const MotionFrame& frame : motion.frames) {
    Json& numbers = frames.emplace_back(Json::array());
    for (const BodyState& body : frame.bodies) push(numbers, body.*member);
  }
  return frames;
}

void put_motion(Json& json, const RecordedMotion& motion) {
  json["role"] = motion.role;
  json["phase"] = motion.phase;
  if (motion.heading > 0) json["heading"] = motion.heading;
  json["error"] = std::isinf(motion.error) ? Json(kInfinite) : rounded(motion.error);
  json["time"] = Json::array();
  json["substrate"] = Json::array();
  for (const MotionFrame& frame : motion.frames) {
    json["time"].push_back(frame.time);
    push(json["substrate"].emplace_back(Json::array()), frame.substrate);
  }
  json["position"] = states_json(motion, &BodyState::position);
  json["velocity"] = states_json(motion, &BodyState::velocity);
  json["angular_velocity"] = states_json(motion, &BodyState::angular_velocity);
  json["touches"] = Json::array();
  for (std::size_t k = 0; k < motion.frames.size(); ++k)
    for (const auto& [first, second] : motion.frames[k].touches)
      json["touches"].push_back({k, first, second});
}

// --- read ----------------------------------------------------------------------------------------

void expect(const JsonNode& node, const std::string& value) {
  if (node.text() != value) node.fault("must be " + value);
}

int integer(const JsonNode& node, int least, std::size_t most) {
  const double value = node.json().is_number_integer() ? node.number() : kNotObserved;
  if (!(value >= least && value <= static_cast<double>(most)))
    node.fault(fmt::format("must be a whole number from {} to {}", least, most));
  return static_cast<int>(value);
}

double read_error(const JsonNode& node) {
  if (node.json().is_null()) return kNotObserved;
  if (node.json().is_number()) return node.number();
  expect(node, kInfinite);
  return std::numeric_limits<double>::infinity();
}

void read_states(const JsonNode& node, RecordedMotion& motion, Vector3 BodyState::*member) {
  const std::vector<JsonNode> frames = node.items(motion.frames.size());
  for (std::size_t k = 0; k < frames.size(); ++k) {
    std::vector<BodyState>& bodies = motion.frames[k].bodies;
    const std::vector<double> numbers = frames[k].numbers(3 * bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i)
      bodies[i].*member = Vector3(numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]);
  }
}

RecordedMotion read_motion(const JsonNode& node, std::size_t bodies, int lowest) {
  RecordedMotion motion;
  motion.role = node["role"].text();
  motion.phase = node["phase"].count(1'000'000'000);
  if (node.has("heading")) motion.heading = node["heading"].count(kMostHeadings - 1);
  motion.error = read_error(node["error"]);

  const std::vector<JsonNode> times = node["time"].items();
  if (times.empty()) node["time"].fault("must be a list of one time at least");
  const std::vector<JsonNode> substrate = node["substrate"].items(times.size());
  for (std::size_t k = 0; k < times.size(); ++k) {
    MotionFrame& frame = motion.frames.emplace_back();
    frame.time = times[k].number();
    if (k > 0 && frame.time <= motion.frames[k - 1].time)
      times[k].fault("must be later than the one before");
    frame.substrate = Vector3(substrate[k].numbers(3).data());
    frame.bodies.resize(bodies);
  }
  read_states(node["position"], motion, &BodyState::position);
  read_states(node["velocity"], motion, &BodyState::velocity);
  read_states(node["angular_velocity"], motion, &BodyState::angular_velocity);
  for (const JsonNode& touch : node["touches"].items()) {
    const std::vector<JsonNode> parts = touch.items(3);
    motion.frames[parts[0].count(times.size() - 1)].touches.emplace_back(
        integer(parts[1], 0, bodies - 1), integer(parts[2], lowest, bodies - 1));
  }
  return motion;
}

/// The run of the result that a motion of this role is of.
EngineRecord& run_of(const JsonNode& node, const std::string& role,
                     std::vector<EngineRecord>& runs) {
  const std::string engine = node["engine"].text(), precision = node["precision"].text();
  const std::string profile = node["profile"].text();
  const double rate = node["rate"].number();
  const double scale = node.has("scale") ? node["scale"].number() : 1;
  for (EngineRecord& run : runs)
    if (valid_utf8(run.engine) == engine && run.precision == precision &&
        valid_utf8(run.profile) == profile && run.rate == rate && run.scale == scale &&
        std::ranges::none_of(run.motions, [&](const auto& other) { return other.role == role; }))
      return run;
  node.fault_alone(fmt::format("must be of a run of the result, is of {} {} {} at {} Hz", engine,
                               precision, profile, rate));
}

}  // namespace

bool has_motions(const SceneRecord& scene) {
  return scene.reference.motion || std::ranges::any_of(scene.runs, [](const EngineRecord& run) {
           return !run.motions.empty();
         });
}

Json motion_json_of(const SceneRecord& scene) {
  Json json = {{"schema", kSchema}};
  json["scenario"] = {{"name", valid_utf8(scene.scenario.name)}, {"sha256", scene.scenario.sha256}};
  json["bodies"] = Json::array();
  for (const Body& body : scene.scenario.bodies) json["bodies"].push_back(valid_utf8(body.name));
  if (scene.reference.motion) put_motion(json["reference"], *scene.reference.motion);
  json["runs"] = Json::array();
  for (const EngineRecord& run : scene.runs)
    for (const RecordedMotion& motion : run.motions) {
      Json& entry = json["runs"].emplace_back();
      entry = {{"engine", valid_utf8(run.engine)},
               {"precision", run.precision},
               {"profile", valid_utf8(run.profile)},
               {"rate", run.rate}};
      if (run.scale != 1) entry["scale"] = run.scale;
      put_motion(entry, motion);
    }
  return json;
}

void read_motions(const JsonNode& file, SceneRecord& scene) {
  expect(file["schema"], kSchema);
  expect(file["scenario"]["name"], valid_utf8(scene.scenario.name));
  expect(file["scenario"]["sha256"], scene.scenario.sha256);
  const std::vector<Body>& bodies = scene.scenario.bodies;
  const std::vector<JsonNode> names = file["bodies"].items(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) expect(names[i], valid_utf8(bodies[i].name));

  const std::size_t surfaces = scene.scenario.surfaces.size();
  const int lowest = surfaces == 0 ? kSubstrate : surface_touch(surfaces - 1);
  std::optional<RecordedMotion> reference;
  if (file.has("reference")) reference = read_motion(file["reference"], bodies.size(), lowest);
  std::vector<EngineRecord> runs = scene.runs;
  for (EngineRecord& run : runs) run.motions.clear();
  for (const JsonNode& node : file["runs"].items()) {
    RecordedMotion motion = read_motion(node, bodies.size(), lowest);
    run_of(node, motion.role, runs).motions.push_back(std::move(motion));
  }
  scene.reference.motion = std::move(reference);
  scene.runs = std::move(runs);
}

}  // namespace slipcheck
