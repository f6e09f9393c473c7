#include "app/tune_setup.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>

#include "app/commands.h"
#include "app/load_files.h"
#include "base/stop_scope.h"
#include "engine/engine_registry.h"
#include "engine/profile.h"
#include "engine/protocol.h"
#include "engine/remote_engine.h"
#include "scenario/fault.h"
#include "scenario/file_text.h"
#include "scenario/units.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

EngineExecutable executable_of(const TuneArguments& arguments) {
  const std::string precision =
      arguments.precision.empty() ? usual_precision(arguments.engine) : arguments.precision;
  auto found = find_engine(arguments.engine, precision);
  if (found) return *found;
  std::set<std::string> names;
  for (const EngineExecutable& executable : find_engines())
    names.insert(fmt::format("{} ({})", executable.engine, executable.precision));
  throw BadOption(fmt::format("--engine: must be one of those installed: {}; got {} ({})",
                              fmt::join(names, ", "), arguments.engine, precision));
}

/// The name under which the profile will be known.
std::string profile_name(const std::string& output) {
  std::string name = fs::path(output).stem().string();
  const bool good = !name.empty() && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
  });
  if (!good)
    throw BadOption(fmt::format(
        "-o: the file's name must be the profile's, of a-z, 0-9 and -, got {}", output));
  const std::string extension = fs::path(output).extension().string();
  if (extension != ".yaml" && extension != ".yml")
    throw BadOption(fmt::format("-o: must end in .yaml, got {}", output));
  return name;
}

/// "5%", "5 %" or "0.05".
std::optional<double> share_of(const std::string& within) {
  if (within.empty()) return std::nullopt;
  try {
    const bool is_percent = within.ends_with('%');
    std::string digits = is_percent ? within.substr(0, within.size() - 1) : within;
    while (digits.ends_with(' ')) digits.pop_back();
    const double share = parse_number(digits) / (is_percent ? 100 : 1);
    if (share > 0) return share;
  } catch (const BadQuantity&) {
    // The rule is told below.
  }
  throw BadOption(fmt::format("--within: must be a share > 0 as in 5%, got {}", within));
}

Settings start_settings(const TuneArguments& arguments, const EngineExecutable& executable,
                        const EngineInfo& info) {
  const auto file = find_profile(executable, arguments.start, fs::current_path());
  if (!file) {
    // An engine need not ship profiles to be tuned: its own settings are the default ones.
    if (arguments.start == TuneArguments().start) return {};
    throw BadOption(fmt::format("--start: must be a profile of {} ({}) or a file, got {}",
                                arguments.engine, fmt::join(profile_names(executable), ", "),
                                arguments.start));
  }
  const Profile profile = load_profile(*file);
  std::vector<Fault> faults = check_profile(profile, info);
  if (!faults.empty()) throw BadScenario(std::move(faults));
  return profile.settings;
}

TuningSpace space_of(const TuneArguments& arguments, const EngineInfo& info,
                     const Settings& start) {
  try {
    return tuning_space(info, start, arguments.settings);
  } catch (const std::invalid_argument& bad) {
    throw BadOption(fmt::format("--settings: {}", bad.what()));
  }
}

/// The search may begin from every profile that the engine ships with.
void add_shipped_profiles(TuningSpace& space, const TuneArguments& arguments,
                          const EngineExecutable& executable, const EngineInfo& info) {
  for (const std::string& name : profile_names(executable)) {
    const auto file = find_profile(executable, name, fs::current_path());
    if (!file) continue;
    const Profile profile = load_profile(*file);
    std::vector<Fault> faults = check_profile(profile, info);
    if (!faults.empty()) throw BadScenario(std::move(faults));
    add_start(space, name, profile.settings, arguments.settings);
  }
}

/// A program built otherwise may answer otherwise.
std::string fingerprint(const std::vector<fs::path>& files) {
  std::string bytes;
  for (const fs::path& file : files) {
    std::ifstream in(file, std::ios::binary);
    bytes.append(std::istreambuf_iterator<char>(in), {});
  }
  return sha256_hex(bytes).substr(0, 16);
}

std::string identity_of(const EngineExecutable& executable, const EngineInfo& info) {
  return fmt::format("slipcheck {}, {} {} {} {}, protocol {}", fingerprint({"/proc/self/exe"}),
                     info.engine, info.version, info.precision, fingerprint(executable.made_of),
                     protocol::kVersion);
}

}  // namespace

TuneSetup prepare_tuning(const TuneArguments& arguments) {
  TuneSetup setup;
  TuningRecord& record = setup.record;
  record.profile = profile_name(arguments.output);
  record.goal.within = share_of(arguments.within);
  record.observables.named = arguments.observables;
  record.phases = arguments.phases;
  record.final_phases = arguments.final_phases;
  record.seed = arguments.seed;
  record.start = arguments.start;
  record.rates = arguments.rates;
  std::ranges::sort(record.rates);
  const auto repeated = std::ranges::unique(record.rates);
  record.rates.erase(repeated.begin(), repeated.end());

  std::vector<std::string> files = arguments.files;
  files.insert(files.end(), arguments.held_out.begin(), arguments.held_out.end());
  std::vector<Scenario> scenarios = load_files(files);

  const EngineExecutable executable = executable_of(arguments);
  const EngineInfo info = RemoteEngine(executable.command).info();
  record.engine = arguments.engine;
  record.version = info.version;
  record.precision = info.precision;
  record.space = space_of(arguments, info, start_settings(arguments, executable, info));
  add_shipped_profiles(record.space, arguments, executable, info);

  setup.scenes = prepare_scenes(std::move(scenarios), false, 1, arguments.time_limit);
  heed_stop();
  for (const PreparedScene& scene : setup.scenes)
    if (scene.reference.run.failed)
      throw BadOption(fmt::format("{}: must have a reference to fit to, but it {}",
                                  scene.scenario.file, scene.reference.run.reason));
  const std::string nothing = nothing_to_tune(setup.scenes, record.observables);
  if (!nothing.empty()) throw BadOption(nothing);
  record.tasks = tuning_tasks(setup.scenes, arguments.files.size(), record.rates);
  setup.identity = identity_of(executable, info);

  setup.journal_file =
      arguments.journal.empty() ? arguments.output + ".journal" : arguments.journal;
  try {
    setup.journal = std::make_unique<TuningJournal>(setup.journal_file);
  } catch (const BadJournal& bad) {
    throw BadOption(fmt::format("--journal: {}", bad.what()));
  }
  return setup;
}

}  // namespace slipcheck
