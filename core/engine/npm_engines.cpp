#include "engine/npm_engines.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "base/folder.h"
#include "base/json_node.h"
#include "base/regular_file.h"

namespace slipcheck {

namespace fs = std::filesystem;

namespace {

NpmEngine npm_engine(const std::string& name, const JsonNode& node) {
  NpmEngine engine;
  engine.name = name;
  engine.package = node["package"].text();
  engine.versions = node["versions"].text();
  engine.usual_version = node["default"].text();
  engine.precision = node["precision"].text();
  if (engine.precision != "single" && engine.precision != "double")
    node["precision"].fault("must be single or double");
  for (const auto& [package, version] : node["also"].members())
    engine.also.emplace_back(package, version.text());
  engine.node = node["node"].count();
  engine.about = node["about"].text();
  return engine;
}

std::string catalogue_text(const std::string& file) {
  constexpr FileLimit kLimit{std::size_t{1} << 20, "catalogues of engines"};
  try {
    return read_regular_file(file, kLimit);
  } catch (const UnreadFile& bad) {
    throw BadJson(file + ": " + bad.what());
  }
}

fs::path folder_of_environment(const char* variable, const char* below) {
  const char* path = std::getenv(variable);
  if (path == nullptr || *path == '\0') return {};
  return *below == '\0' ? fs::path(path) : fs::path(path) / below;
}

}  // namespace

fs::path npm_worker_folder() {
  for (const fs::path& directory : engine_directories()) {
    std::error_code ignored;
    if (fs::exists(directory / "node" / "catalog.json", ignored)) return directory / "node";
  }
  return {};
}

std::vector<NpmEngine> npm_engines() {
  const fs::path folder = npm_worker_folder();
  if (folder.empty()) return {};
  const std::string file = (folder / "catalog.json").string();
  const JsonNode::Json json = JsonNode::parse(catalogue_text(file), file);
  std::vector<NpmEngine> engines;
  for (const auto& [name, node] : JsonNode(json, file).members())
    engines.push_back(npm_engine(name, node));
  std::ranges::sort(engines, {}, &NpmEngine::name);
  return engines;
}

fs::path engines_folder() {
  for (const auto& [variable, below] : {std::pair{"SLIPCHECK_ENGINES", ""},
                                        {"XDG_DATA_HOME", "slipcheck/engines"},
                                        {"HOME", ".local/share/slipcheck/engines"}}) {
    fs::path folder = folder_of_environment(variable, below);
    if (!folder.empty()) return folder;
  }
  return {};
}

EngineExecutable npm_worker(const NpmEngine& engine, const std::string& version,
                            const fs::path& folder) {
  const fs::path kit = npm_worker_folder();
  return {
      engine.name + "@" + version,
      engine.precision,
      {"node", {(kit / "main.mjs").string(), engine.name, folder.string()}},
      kit / "profiles" / engine.name,
      {kit / "main.mjs", kit / "engines" / (engine.name + ".mjs"), folder / "package-lock.json"}};
}

std::vector<EngineExecutable> installed_npm_engines() {
  std::vector<EngineExecutable> found;
  const fs::path all = engines_folder();
  std::error_code ignored;
  if (all.empty()) return found;
  const std::vector<NpmEngine> engines = npm_engines();
  for (const fs::path& folder : entries_of(all, ignored)) {
    const std::string name = folder.filename().string();
    const std::string version = engine_version(name);
    const auto engine = std::ranges::find(engines, engine_family(name), &NpmEngine::name);
    if (version.empty() || engine == engines.end() || !fs::is_directory(folder, ignored)) continue;
    found.push_back(npm_worker(*engine, version, folder));
  }
  return found;
}

}  // namespace slipcheck
