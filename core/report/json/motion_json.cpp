#include "report/json/motion_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "harness/observe/observables.h"
#include "report/terminal/text.h"

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

[[noreturn]] void fail(const std::string& place, std::string_view rule) {
  throw std::runtime_error(fmt::format("{}: must be {}", place, rule));
}

/// A value of the file with its place, as in "runs[1].time".
class Item {
 public:
  Item(const Json& json, std::string place) : json_(&json), place_(std::move(place)) {}

  Item operator[](const char* key) const {
    const std::string place = place_.empty() ? key : fmt::format("{}.{}", place_, key);
    if (!json_->is_object() || !json_->contains(key)) fail(place, "there");
    return {(*json_)[key], place};
  }
  std::vector<Item> list() const {
    if (!json_->is_array()) fail(place_, "a list");
    std::vector<Item> items;
    for (std::size_t k = 0; k < json_->size(); ++k)
      items.emplace_back((*json_)[k], fmt::format("{}[{}]", place_, k));
    return items;
  }
  std::vector<Item> list(std::size_t size) const {
    std::vector<Item> items = list();
    if (items.size() != size)
      fail(place_, fmt::format("a list of {}, is of {}", size, items.size()));
    return items;
  }
  std::vector<double> numbers(std::size_t size) const {
    if (!json_->is_array() || json_->size() != size ||
        !std::ranges::all_of(*json_, [](const Json& each) { return each.is_number(); }))
      fail(place_, fmt::format("a list of {} numbers", size));
    return json_->get<std::vector<double>>();
  }
  double number() const {
    if (!json_->is_number()) fail(place_, "a number");
    return json_->get<double>();
  }
  int integer(int low, std::size_t high) const {
    const double value = json_->is_number_integer() ? number() : kNotObserved;
    if (!(value >= low && value <= static_cast<double>(high)))
      fail(place_, fmt::format("a whole number from {} to {}", low, high));
    return static_cast<int>(value);
  }
  std::string text() const {
    if (!json_->is_string()) fail(place_, "a text");
    return json_->get<std::string>();
  }
  void expect(std::string_view value) const {
    if (const std::string found = text(); found != value)
      fail(place_, fmt::format("{}, is {}", value, found));
  }
  const Json& json() const { return *json_; }
  const std::string& place() const { return place_; }

 private:
  const Json* json_;
  std::string place_;
};

double read_error(const Item& item) {
  if (item.json().is_null()) return kNotObserved;
  if (item.json().is_number()) return item.number();
  item.expect(kInfinite);
  return std::numeric_limits<double>::infinity();
}

void read_states(const Item& item, RecordedMotion& motion, Vector3 BodyState::*member) {
  const std::vector<Item> frames = item.list(motion.frames.size());
  for (std::size_t k = 0; k < frames.size(); ++k) {
    std::vector<BodyState>& bodies = motion.frames[k].bodies;
    const std::vector<double> numbers = frames[k].numbers(3 * bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i)
      bodies[i].*member = Vector3(numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]);
  }
}

RecordedMotion read_motion(const Item& item, std::size_t bodies) {
  RecordedMotion motion;
  motion.role = item["role"].text();
  motion.phase = static_cast<std::size_t>(item["phase"].integer(0, 1'000'000'000));
  motion.error = read_error(item["error"]);

  const std::vector<Item> times = item["time"].list();
  if (times.empty()) fail(item["time"].place(), "a list of one time at least");
  const std::vector<Item> substrate = item["substrate"].list(times.size());
  for (std::size_t k = 0; k < times.size(); ++k) {
    MotionFrame& frame = motion.frames.emplace_back();
    frame.time = times[k].number();
    if (k > 0 && frame.time <= motion.frames[k - 1].time)
      fail(times[k].place(), "later than the one before");
    frame.substrate = Vector3(substrate[k].numbers(3).data());
    frame.bodies.resize(bodies);
  }
  read_states(item["position"], motion, &BodyState::position);
  read_states(item["velocity"], motion, &BodyState::velocity);
  read_states(item["angular_velocity"], motion, &BodyState::angular_velocity);
  for (const Item& touch : item["touches"].list()) {
    const std::vector<Item> parts = touch.list(3);
    const auto frame = static_cast<std::size_t>(parts[0].integer(0, times.size() - 1));
    motion.frames[frame].touches.emplace_back(parts[1].integer(0, bodies - 1),
                                              parts[2].integer(kSubstrate, bodies - 1));
  }
  return motion;
}

/// The run of the result that a motion of this role is of.
EngineRecord& run_of(const Item& item, const std::string& role, std::vector<EngineRecord>& runs) {
  const std::string engine = item["engine"].text(), precision = item["precision"].text();
  const std::string profile = item["profile"].text();
  const double rate = item["rate"].number();
  for (EngineRecord& run : runs)
    if (valid_utf8(run.engine) == engine && run.precision == precision &&
        valid_utf8(run.profile) == profile && run.rate == rate &&
        std::ranges::none_of(run.motions, [&](const auto& other) { return other.role == role; }))
      return run;
  fail(item.place(), fmt::format("of a run of the result, is of {} {} {} at {} Hz", engine,
                                 precision, profile, rate));
}

}  // namespace

bool has_motions(const SceneRecord& scene) {
  return scene.reference.motion || std::ranges::any_of(scene.runs, [](const EngineRecord& run) {
           return !run.motions.empty();
         });
}

Json motion_json_of(const SceneRecord& scene) {
  Json json;
  json["schema"] = kSchema;
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
      put_motion(entry, motion);
    }
  return json;
}

void read_motions(const Json& json, SceneRecord& scene) {
  const Item file(json, "");
  file["schema"].expect(kSchema);
  file["scenario"]["name"].expect(valid_utf8(scene.scenario.name));
  file["scenario"]["sha256"].expect(scene.scenario.sha256);
  const std::vector<Body>& bodies = scene.scenario.bodies;
  const std::vector<Item> names = file["bodies"].list(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) names[i].expect(valid_utf8(bodies[i].name));

  std::optional<RecordedMotion> reference;
  if (json.contains("reference")) reference = read_motion(file["reference"], bodies.size());
  std::vector<EngineRecord> runs = scene.runs;
  for (EngineRecord& run : runs) run.motions.clear();
  for (const Item& item : file["runs"].list()) {
    RecordedMotion motion = read_motion(item, bodies.size());
    run_of(item, motion.role, runs).motions.push_back(std::move(motion));
  }
  scene.reference.motion = std::move(reference);
  scene.runs = std::move(runs);
}

}  // namespace slipcheck
