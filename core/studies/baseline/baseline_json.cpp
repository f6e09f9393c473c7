#include "studies/baseline/baseline_json.h"

#include <fmt/format.h>

#include "base/json_fields.h"

namespace slipcheck {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "slipcheck-baseline/1";

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

}  // namespace

template <class Fields>
void describe(Fields& f, BaselineSpread& seen) {
  f("median", seen.median);
  f("min", seen.min);
  f("max", seen.max);
  f.if_any("missing", seen.missing);
}

template <class Fields>
void describe(Fields& f, BaselineRun& run) {
  f("engine", run.engine);
  f("version", run.version);
  f("precision", run.precision);
  f("profile", run.profile);
  f("rate", run.rate, kAboveZero);
  f.unless("scale", run.scale, 1.0);
  f.unless("headings", run.headings, std::size_t{1});
  f("status", run.status);
  f("verdict", run.verdict);
  f("phases", run.phases);
  f("cpu_seconds", run.cpu_seconds);
  f("observables", run.observables);
}

template <class Fields>
void describe(Fields& f, UncertainValue& value) {
  f("value", value.value);
  f("uncertainty", value.uncertainty);
  if constexpr (Fields::kReads)
    if (value.uncertainty < 0) f["uncertainty"].fault("must be >= 0");
}

template <class Fields>
void describe(Fields& f, SceneBaseline& baseline) {
  f("slipcheck", baseline.slipcheck);
  f("scene", baseline.scene);
  f("sha256", baseline.sha256);
  f("phases", baseline.phases);
  f.object("reference", [&](auto& reference) {
    reference("solver", baseline.solver);
    reference("cpu_seconds", baseline.cpu_seconds);
    reference("observables", baseline.reference);
  });
  f("runs", baseline.runs);
}

std::string baseline_text(const SceneBaseline& baseline) {
  Json json{{"schema", kSchema}};
  json.update(FieldWriter<Json, NotFinite::null>::json_of_value(baseline));
  std::string text;
  write(json, 0, text);
  return text + '\n';
}

SceneBaseline parse_baseline(const std::string& text, const std::string& file) {
  const nlohmann::json json = JsonNode::parse(text, file);
  const JsonNode root(json, file);
  if (root["schema"].text() != kSchema) root["schema"].fault(fmt::format("must be {}", kSchema));
  auto baseline = read_record<SceneBaseline>(root);
  if (const auto stem = std::filesystem::path(file).stem(); baseline.scene != stem)
    root["scene"].fault(fmt::format("must be {}, as the file is named", stem.string()));
  if (baseline.phases == 0) root["phases"].fault("must be >= 1");
  return baseline;
}

std::filesystem::path baseline_file(const std::filesystem::path& folder, const std::string& scene) {
  return folder / (scene + ".json");
}

}  // namespace slipcheck
