#include "report/json/read_folders.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/folder.h"
#include "base/regular_file.h"
#include "report/json/common_fields.h"
#include "report/json/json_report.h"
#include "report/json/motion_json.h"
#include "report/json/precision_json.h"
#include "report/json/stability_json.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  try {
    return read_regular_file(file, kResultFileLimit);
  } catch (const UnreadFile& bad) {
    const char* rule = bad.error() != 0 ? "cannot be read" : bad.what();
    throw BadJson(fmt::format("{}: {}", file.string(), rule));
  }
}

/// The JSON files of a folder by name.
std::vector<fs::path> files_of(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const fs::path& file : entries_of(folder, error)) {
    if (file.extension() == ".json" && fs::is_regular_file(file, error)) files.push_back(file);
    if (error) break;
  }
  if (error) throw BadJson(fmt::format("{}: cannot be read: {}", folder.string(), error.message()));
  return files;
}

/// Adds to "1, 2" what is not yet among it.
void add_to_list(std::string& list, const std::string& value) {
  if (list.empty()) {
    list = value;
  } else if (fmt::format(", {}, ", list).find(fmt::format(", {}, ", value)) == std::string::npos) {
    list += ", " + value;
  }
}

class Reader {
 public:
  /// Whether it is part of a report.
  bool take(const fs::path& path) {
    const std::string file = path.string();
    nlohmann::json json = JsonNode::parse(text_of(path), file);
    const std::string schema = schema_of(json);
    const auto reader = readers().find(schema);
    if (schema == kMotion) {
      motions_.push_back({file, std::move(json)});
      return true;
    }
    if (reader == readers().end()) {
      refuse_other_versions(json, schema, file);
      results_.ignored.push_back(fmt::format(
          "{}: {}", file,
          schema.empty() ? "is no file of Slipcheck" : schema + " has no part in a report"));
      return false;
    }
    const JsonNode node(json, file);
    (this->*reader->second)(node);
    return true;
  }

  ReadResults finish() {
    for (const Motion& motion : motions_) add_motion(motion);
    return std::move(results_);
  }

 private:
  using Read = void (Reader::*)(const JsonNode&);
  static constexpr const char* kMotion = "slipcheck-motion/1";

  static const std::map<std::string, Read>& readers() {
    static const std::map<std::string, Read> result = {
        {"slipcheck-result/1", &Reader::add_result},
        {"slipcheck-results/1", &Reader::add_results},
        {"slipcheck-precision/1", &Reader::add_precision},
        {"slipcheck-stability/1", &Reader::add_stability}};
    return result;
  }

  static std::string schema_of(const nlohmann::json& json) {
    const auto schema = json.is_object() ? json.find("schema") : json.end();
    if (schema == json.end() || !schema->is_string()) return {};
    const auto text = schema->get<std::string>();
    return text.starts_with("slipcheck-") ? text : "";
  }

  /// "slipcheck-result/2"
  static void refuse_other_versions(const nlohmann::json& json, const std::string& schema,
                                    const std::string& file) {
    const auto is_other = [&](std::string_view known) {
      return schema.starts_with(known.substr(0, known.find('/') + 1));
    };
    std::vector<std::string> names = {kMotion};
    for (const auto& [name, read] : readers()) names.push_back(name);
    for (const std::string& name : names)
      if (is_other(name))
        JsonNode(json, file)["schema"].fault(fmt::format("must be {} for this version", name));
  }

  void note_scene(std::map<std::string, std::string>& files, const std::string& scene,
                  const JsonNode& node) {
    const auto [known, is_new] = files.emplace(scene, node.file());
    if (!is_new)
      throw BadJson(
          fmt::format("{}: the scene {} is in {} already", node.file(), scene, known->second));
  }

  void note_context(const JsonNode& node) {
    const auto found = read_record<Context>(node);
    Context& all = results_.content.context;
    for (const auto part : {&Context::version, &Context::commit, &Context::build,
                            &Context::compiler, &Context::system, &Context::cpu})
      add_to_list(all.*part, found.*part);
    if (all.cores == 0) all.cores = found.cores;
  }

  void add_result(const JsonNode& node) {
    note_context(node);
    SceneRecord scene = read_result(node);
    note_scene(scenes_, scene.scenario.name, node);
    results_.content.scenes.push_back(std::move(scene));
  }

  void add_results(const JsonNode& node) {
    for (const JsonNode& result : node["results"].items()) add_result(result);
  }

  void add_precision(const JsonNode& node) {
    note_context(node);
    for (PrecisionScene& scene : read_precision(node)) {
      note_scene(precision_, scene.scenario.name, node);
      results_.content.precision.push_back(std::move(scene));
    }
  }

  void add_stability(const JsonNode& node) {
    note_context(node);
    StabilityFile stability = read_stability(node);
    if (criteria_.is_null()) criteria_ = node.json()["criteria"];
    if (criteria_ != node.json()["criteria"])
      node["criteria"].fault("must be the same in all files, else their cases do not compare");
    ReportContent& content = results_.content;
    content.criteria = stability.criteria;
    for (StabilityCase& scene : stability.cases) {
      note_scene(cases_, scene.scenario.name, node);
      content.cases.push_back(std::move(scene));
    }
    std::ranges::move(stability.limits.limits, std::back_inserter(content.limits.limits));
    std::ranges::move(stability.limits.maps, std::back_inserter(content.limits.maps));
  }

  struct Motion {
    std::string file;
    nlohmann::json json;
  };
  void add_motion(const Motion& motion) {
    const JsonNode node(motion.json, motion.file);
    const std::string name = node["scenario"]["name"].text();
    std::vector<SceneRecord>& scenes = results_.content.scenes;
    const auto scene = std::ranges::find_if(
        scenes, [&](const SceneRecord& each) { return each.scenario.name == name; });
    if (scene == scenes.end())
      results_.ignored.push_back(fmt::format("{}: there is no result of its scene", motion.file));
    else
      read_motions(node, *scene);
  }

  ReadResults results_;
  std::vector<Motion> motions_;
  std::map<std::string, std::string> scenes_, precision_, cases_;  // files by scene
  nlohmann::json criteria_;
};

}  // namespace

ReadResults read_folders(const std::vector<fs::path>& paths) {
  Reader reader;
  for (const fs::path& path : paths) {
    std::error_code error;
    if (!fs::exists(path, error))
      throw BadJson(fmt::format("{}: there is no such file or folder", path.string()));
    bool any = false;
    const bool is_folder = fs::is_directory(path, error);
    for (const fs::path& file : is_folder ? files_of(path) : std::vector{path})
      any |= reader.take(file);
    if (!any)
      throw BadJson(fmt::format("{} {}", path.string(),
                                is_folder ? "holds no result file" : "is no result file"));
  }
  return reader.finish();
}

}  // namespace slipcheck
