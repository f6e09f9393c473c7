#include "engine/npm_install.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>
#include <vector>

#include "base/run_program.h"
#include "engine/remote_engine.h"
#include "scenario/rules/rules.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Runs npm and returns what it says; throws NotInstalled where it is not there or ends otherwise
/// than well, with `what` as the beginning of the message.
ProgramEnd run_npm(const std::vector<std::string>& arguments, const fs::path& folder) {
  std::vector<std::string> words = {"npm"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  for (const char* option : {"--loglevel=error", "--no-audit", "--no-fund",
                             "--update-notifier=false", "--fetch-retries=1"})
    words.emplace_back(option);
  try {
    return run_program(words, folder);
  } catch (const std::system_error& error) {
    if (error.code() == std::errc::no_such_file_or_directory)
      throw NotInstalled(
          "engines of this kind come through npm, which is not there: install nodejs and npm "
          "(Debian), or Node.js");
    throw NotInstalled(error.what());
  }
}

/// The versions of a package that were released, oldest first; none where npm cannot tell.
std::vector<std::string> published_versions(const std::string& package) {
  try {
    const ProgramEnd end =
        run_npm({"view", package, "versions", "--json"}, fs::temp_directory_path());
    const json versions = json::parse(end.said, nullptr, false);
    if (end.exit_code != 0 || !versions.is_array()) return {};
    auto released = versions.get<std::vector<std::string>>();
    std::erase_if(released, [](const std::string& version) {
      return version.find('-') != std::string::npos;
    });
    return released;
  } catch (const std::exception&) {
    return {};
  }
}

/// The first lines that npm says of its failure, without its own name before them.
std::string reason_of(const std::string& said) {
  std::vector<std::string> lines;
  std::istringstream all(said);
  for (std::string line; std::getline(all, line);) {
    for (const char* own : {"npm ERR! ", "npm error ", "code "})
      if (line.starts_with(own)) line.erase(0, std::strlen(own));
    const bool is_told =
        line.empty() || line.starts_with("npm ") || line.find("complete log") != std::string::npos;
    if (!is_told) lines.push_back(line);
  }
  if (lines.size() > 3) lines.resize(3);
  return lines.empty() ? "npm failed without a reason" : fmt::format("{}", fmt::join(lines, "; "));
}

/// Why npm could not install it.
std::string failure_of(const NpmChoice& choice, const std::string& said) {
  const bool is_no_version =
      said.find("ETARGET") != std::string::npos || said.find("E404") != std::string::npos;
  if (is_no_version) {
    const std::vector<std::string> versions = published_versions(choice.engine.package);
    return fmt::format("{}: there is no version {} of {}{}{}", choice.name(), choice.version,
                       choice.engine.package, versions.empty() ? "" : "; there are ",
                       fmt::join(versions, ", "));
  }
  const bool is_unreachable = std::ranges::any_of(
      std::vector<const char*>{"ENOTFOUND", "EAI_AGAIN", "ECONNREFUSED", "ETIMEDOUT", "ENETUNREACH",
                               "ENOTCACHED", "ECONNRESET"},
      [&](const char* code) { return said.find(code) != std::string::npos; });
  return fmt::format("{}: {}{}", choice.name(), reason_of(said),
                     is_unreachable ? "; npm needs the network for it, try again with one" : "");
}

/// What the folder is to hold: exact versions and nothing else.
void write_package_json(const NpmChoice& choice, const fs::path& folder) {
  json dependencies = {{choice.engine.package, choice.version}};
  for (const auto& [package, version] : choice.engine.also) dependencies[package] = version;
  const json package = {{"name", "slipcheck-engine"},
                        {"private", true},
                        {"description", "an engine for slipcheck: " + choice.name()},
                        {"dependencies", dependencies}};
  std::ofstream(folder / "package.json") << package.dump(2) << '\n';
}

void install_packages(const NpmChoice& choice, const fs::path& folder) {
  write_package_json(choice, folder);
  const fs::path lock = npm_worker_folder() / "locks" / (choice.name() + ".json");
  // With a lock npm installs what it names and checks each file. "npm ci" would as well, but some
  // of its versions ask for packages of other platforms that no installation here takes.
  std::error_code ignored;
  if (fs::exists(lock, ignored)) fs::copy_file(lock, folder / "package-lock.json");
  const ProgramEnd end = run_npm(
      {"install", "--ignore-scripts", "--omit=optional", "--omit-lockfile-registry-resolved"},
      folder);
  if (end.exit_code != 0) throw NotInstalled(failure_of(choice, end.said));
}

/// Throws NotInstalled where the worker does not tell who it is.
void try_worker(const NpmChoice& choice, const fs::path& folder) {
  try {
    const RemoteEngine worker(npm_worker(choice.engine, choice.version, folder).command);
  } catch (const WorkerFailure& failure) {
    throw NotInstalled(fmt::format(
        "{}: its packages are there, but it does not start: {} (it needs Node.js {} or later, and "
        "its adapter was tried with versions {})",
        choice.name(), failure.what(), choice.engine.node, choice.engine.versions));
  }
}

/// "0.19.3", "0.8.0-alpha.2"
bool is_version(const std::string& text) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const std::string numbers = text.substr(0, text.find('-'));
  const std::string suffix = text.substr(std::min(numbers.size() + 1, text.size()));
  if (text.ends_with('-') || std::ranges::count(numbers, '.') != 2) return false;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const bool stands_alone =
        numbers[k] == '.' && (k == 0 || k + 1 == numbers.size() || numbers[k + 1] == '.');
    if (stands_alone || (numbers[k] != '.' && !is_digit(numbers[k]))) return false;
  }
  return std::ranges::all_of(suffix, [&](char c) {
    return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '.' || c == '-';
  });
}

}  // namespace

NpmChoice npm_choice(const std::string& name) {
  const std::vector<NpmEngine> engines = npm_engines();
  const std::string family = engine_family(name);
  const auto engine = std::ranges::find(engines, family, &NpmEngine::name);
  if (engine == engines.end()) {
    std::vector<std::string> names;
    for (const NpmEngine& each : engines) names.push_back(each.name);
    throw NotInstalled(fmt::format("{} is none of the engines that npm brings, {}{}", family,
                                   fmt::join(names, ", "), did_you_mean(family, names)));
  }
  std::string version = engine_version(name);
  if (name.find('@') == std::string::npos) version = engine->usual_version;
  if (!is_version(version))
    throw NotInstalled(fmt::format("a version must be three numbers as in {}@{}, got {}", family,
                                   engine->usual_version, name));
  return {*engine, version};
}

EngineExecutable install_engine(const NpmChoice& choice) {
  const fs::path all = engines_folder();
  if (all.empty())
    throw NotInstalled(
        "there is no folder for engines: HOME, XDG_DATA_HOME or SLIPCHECK_ENGINES must name one");
  const fs::path folder = all / choice.name();
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    fs::create_directories(all, error);
    if (error) throw NotInstalled(fmt::format("cannot make {}: {}", all.string(), error.message()));
    try {
      const TemporaryFolder work(".adding", all);
      install_packages(choice, work.path());
      try_worker(choice, work.path());
      fs::permissions(work.path(), fs::perms(0755));
      fs::rename(work.path(), folder);
    } catch (const std::system_error& trouble) {  // also of the file system
      throw NotInstalled(fmt::format("{}: {}", choice.name(), trouble.what()));
    }
  }
  return npm_worker(choice.engine, choice.version, folder);
}

void remove_engine(const NpmChoice& choice) {
  const fs::path folder = engines_folder() / choice.name();
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw NotInstalled(
        fmt::format("{} is not installed in {}", choice.name(), engines_folder().string()));
  // What is half removed must not look like an engine.
  const fs::path away = engines_folder() / (".removing-" + choice.name());
  fs::remove_all(away, error);
  fs::rename(folder, away, error);
  if (!error) fs::remove_all(away, error);
  if (error)
    throw NotInstalled(fmt::format("cannot remove {}: {}", folder.string(), error.message()));
}

}  // namespace slipcheck
