#include "studies/baseline/baseline_json.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

namespace slipcheck {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "slipcheck-baseline/1";

// --- writing -------------------------------------------------------------------------------------

Json number_json(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json run_json(const BaselineRun& run) {
  Json json = {{"engine", run.engine},   {"version", run.version}, {"precision", run.precision},
               {"profile", run.profile}, {"rate", run.rate},       {"status", name_of(run.status)}};
  if (run.verdict) json["verdict"] = name_of(*run.verdict);
  json["phases"] = run.phases;
  json["cpu_seconds"] = number_json(run.cpu_seconds);
  Json& observables = json["observables"] = Json::object();
  for (const auto& [name, seen] : run.observables) {
    Json& each = observables[name] = {{"median", number_json(seen.median)},
                                      {"min", number_json(seen.min)},
                                      {"max", number_json(seen.max)}};
    if (seen.missing > 0) each["missing"] = seen.missing;
  }
  return json;
}

/// Indented down to what holds only plain values, which stays on one line.
void write(const Json& json, std::size_t indent, std::string& text) {
  bool is_flat = true;
  for (const Json& each : json) is_flat &= each.is_primitive();
  if (json.is_primitive() || is_flat) {
    text += json.dump();
    return;
  }
  const std::string blanks(indent + 2, ' ');
  text += json.is_object() ? "{\n" : "[\n";
  std::size_t left = json.size();
  for (auto item = json.begin(); item != json.end(); ++item) {
    text += blanks;
    if (json.is_object()) text += Json(item.key()).dump() + ": ";
    write(*item, indent + 2, text);
    text += --left > 0 ? ",\n" : "\n";
  }
  text += std::string(indent, ' ') + (json.is_object() ? '}' : ']');
}

// --- reading -------------------------------------------------------------------------------------

/// A value of the file with its place, for messages.
class Node {
 public:
  Node(const Json& json, std::string place, const std::string& file)
      : json_(&json), place_(std::move(place)), file_(&file) {}

  [[noreturn]] void fault(const std::string& rule) const {
    const std::string where = place_.empty() ? "" : place_ + ": ";
    throw BadBaseline(fmt::format("{}: {}{}, got {}", *file_, where, rule,
                                  json_->is_primitive() ? json_->dump()
                                  : json_->is_object()  ? "an object"
                                                        : "a list"));
  }

  bool has(const std::string& key) const { return json_->is_object() && json_->contains(key); }

  Node operator[](const std::string& key) const {
    if (!json_->is_object()) fault("must be an object");
    const std::string place = place_.empty() ? key : place_ + '.' + key;
    const auto found = json_->find(key);
    if (found == json_->end())
      throw BadBaseline(fmt::format("{}: {}: must be there", *file_, place));
    return {*found, place, *file_};
  }

  std::vector<Node> items() const {
    if (!json_->is_array()) fault("must be a list");
    std::vector<Node> items;
    for (const Json& each : *json_)
      items.emplace_back(each, fmt::format("{}[{}]", place_, items.size()), *file_);
    return items;
  }

  std::vector<std::pair<std::string, Node>> members() const {
    if (!json_->is_object()) fault("must be an object");
    std::vector<std::pair<std::string, Node>> members;
    for (const auto& [key, value] : json_->items())
      members.emplace_back(key, Node(value, place_ + '.' + key, *file_));
    return members;
  }

  std::string text() const {
    if (!json_->is_string()) fault("must be text");
    return json_->get<std::string>();
  }
  double number() const {
    if (!json_->is_number()) fault("must be a number");
    return json_->get<double>();
  }
  /// null is a number that was not finite.
  double number_or_nan() const {
    return json_->is_null() ? std::numeric_limits<double>::quiet_NaN() : number();
  }
  std::size_t count() const {
    if (!json_->is_number_unsigned()) fault("must be a whole number >= 0");
    return json_->get<std::size_t>();
  }

  template <class Enumeration>
  Enumeration one_of(std::initializer_list<Enumeration> values) const {
    std::string names;
    for (const Enumeration value : values) {
      if (json_->is_string() && json_->get<std::string>() == name_of(value)) return value;
      names += (names.empty() ? "" : ", ") + std::string(name_of(value));
    }
    fault("must be one of " + names);
  }

 private:
  const Json* json_;
  std::string place_;
  const std::string* file_;
};

BaselineRun read_run(const Node& node) {
  using enum RunStatus;
  BaselineRun run;
  run.engine = node["engine"].text();
  run.version = node["version"].text();
  run.precision = node["precision"].text();
  run.profile = node["profile"].text();
  run.rate = node["rate"].number();
  if (!(run.rate > 0)) node["rate"].fault("must be > 0 Hz");
  run.status = node["status"].one_of({ok, unstable, crashed, timed_out, skipped});
  if (node.has("verdict"))
    run.verdict = node["verdict"].one_of({Verdict::unjudged, Verdict::within, Verdict::undecided,
                                          Verdict::deviates, Verdict::failed});
  run.phases = node["phases"].count();
  run.cpu_seconds = node["cpu_seconds"].number_or_nan();
  for (const auto& [name, seen] : node["observables"].members())
    run.observables[name] = {seen["median"].number_or_nan(), seen["min"].number_or_nan(),
                             seen["max"].number_or_nan(),
                             seen.has("missing") ? seen["missing"].count() : 0};
  return run;
}

}  // namespace

std::string baseline_text(const SceneBaseline& baseline) {
  Json json = {{"schema", kSchema},
               {"slipcheck", baseline.slipcheck},
               {"scene", baseline.scene},
               {"sha256", baseline.sha256},
               {"phases", baseline.phases}};
  Json& reference = json["reference"] = {{"solver", baseline.solver},
                                         {"cpu_seconds", number_json(baseline.cpu_seconds)}};
  Json& observables = reference["observables"] = Json::object();
  for (const auto& [name, value] : baseline.reference)
    observables[name] = {{"value", number_json(value.value)},
                         {"uncertainty", number_json(value.uncertainty)}};
  Json& runs = json["runs"] = Json::array();
  for (const BaselineRun& run : baseline.runs) runs.push_back(run_json(run));
  std::string text;
  write(json, 0, text);
  return text + '\n';
}

SceneBaseline parse_baseline(const std::string& text, const std::string& file) {
  Json json;
  try {
    json = Json::parse(text);
  } catch (const Json::parse_error& error) {
    throw BadBaseline(fmt::format("{}: must be JSON: {}", file, error.what()));
  }
  const Node root(json, "", file);
  if (root["schema"].text() != kSchema) root["schema"].fault(fmt::format("must be {}", kSchema));
  SceneBaseline baseline;
  baseline.slipcheck = root["slipcheck"].text();
  baseline.scene = root["scene"].text();
  if (const auto stem = std::filesystem::path(file).stem(); baseline.scene != stem)
    root["scene"].fault(fmt::format("must be {}, as the file is named", stem.string()));
  baseline.sha256 = root["sha256"].text();
  baseline.phases = root["phases"].count();
  if (baseline.phases == 0) root["phases"].fault("must be >= 1");
  const Node reference = root["reference"];
  baseline.solver = reference["solver"].text();
  baseline.cpu_seconds = reference["cpu_seconds"].number_or_nan();
  for (const auto& [name, value] : reference["observables"].members())
    baseline.reference[name] = {value["value"].number_or_nan(),
                                value["uncertainty"].number_or_nan()};
  for (const Node& run : root["runs"].items()) baseline.runs.push_back(read_run(run));
  return baseline;
}

std::filesystem::path baseline_file(const std::filesystem::path& folder, const std::string& scene) {
  return folder / (scene + ".json");
}

}  // namespace slipcheck
