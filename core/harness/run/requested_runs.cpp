#include "harness/run/requested_runs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <variant>

#include "engine/engine_registry.h"
#include "engine/profile.h"
#include "engine/remote_engine.h"
#include "harness/run/engine_grid.h"
#include "scenario/fault.h"
#include "scenario/file_text.h"
#include "scenario/rules/rules.h"
#include "scene/scene_outline.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

/// A message to an engine holds so many bodies: 64 MiB and 4 million items, of which each takes
/// about 140 bytes and 9 items.
constexpr std::size_t kMostBodies = 400'000;

std::string precision_of(const EngineRequest& request) {
  if (!request.precision) return usual_precision(request.engine);
  return *request.precision == EngineRequest::Precision::single_ ? "single" : "double";
}

/// What has no headings, because its surroundings have directions of their own; "" where it has.
std::string without_headings(const Scenario& scenario) {
  if (std::holds_alternative<Container>(scenario.surroundings)) return "a box";
  return std::get<Substrate>(scenario.surroundings).periodic ? "a periodic plane" : "";
}

/// Finds, reads and checks the profiles of all scenes, each file and each engine once.
class Profiles {
 public:
  Profiles(const WorkerLimits& limits, const std::atomic<bool>* stop, const Settings& settings,
           bool general)
      : limits_(limits), stop_(stop), general_(general) {
    over_.file = "--set";
    over_.settings = settings;
  }

  /// The settings for the record of a request, or of one of a grid the reason why it is skipped; a
  /// fault in it is noted.
  void choose(const Scenario& scenario, const std::string& key, bool of_grid,
              EngineRecord& record) {
    if (std::ranges::find(engines_, engine_family(record.engine)) == engines_.end()) {
      note(fault_at(scenario, key + ".engine",
                    fmt::format("must be one of the engines {}{}", fmt::join(engines_, ", "),
                                did_you_mean(record.engine, engines_)),
                    record.engine));
      return;
    }
    const auto executable = find_engine(record.engine, record.precision);
    over_.engine = engine_family(record.engine);
    check(over_, record, executable);
    choose_profile(scenario, key, of_grid, executable, record);
    // Of both the setting that is given by hand holds.
    Settings settings = over_.settings;
    if (general_ && executable && takes_leaves_out(executable->command))
      settings.try_emplace("leaves_out", false);
    settings.merge(record.settings);
    record.settings = std::move(settings);
  }

  /// Notes a scene that no engine can be told of; whole: but one that takes many.
  void check_size(const Scenario& scenario, bool whole) {
    const std::size_t bodies = scenario.bodies.size();
    if (scenario.compare.engines.empty() && !scenario.compare.all_engines) return;
    const auto refuse = [&](std::size_t most, const char* what, const char* why) {
      note(fault_at(
          scenario, "compare.engines",
          fmt::format("must be [] with more than {} {}, the reference alone: {}", most, what, why),
          fmt::format("{} bodies", bodies)));
    };
    if (bodies > kMostBodies && !whole)
      refuse(kMostBodies, "bodies", "no message to an engine holds more");
    else if (has_own_contacts(scenario))
      refuse(kMostInTable, "sizes of bodies whose contacts depend on them",
             "engines are told of each two of them");
  }

  /// Notes the profiles that no engine of a grid has.
  void check_grid(const Scenario& scenario, const std::vector<EngineRecord>& records) {
    std::set<std::string> lacking;
    for (const EngineRecord& record : records)
      if (!record.reason.empty()) lacking.insert(record.profile);
    for (const EngineRecord& record : records)
      if (record.reason.empty()) lacking.erase(record.profile);
    if (lacking.empty()) return;
    std::set<std::string> had;
    for (const EngineRecord& record : records)
      if (const auto executable = find_engine(record.engine, record.precision))
        for (const std::string& name : profile_names(*executable)) had.insert(name);
    const std::vector<std::string> names(had.begin(), had.end());
    for (const std::string& profile : lacking) {
      std::string rule = fmt::format("must be profiles of the engines, {}, or paths{}",
                                     fmt::join(names, ", "), did_you_mean(profile, names));
      note(scenario.compare.all_engines
               ? fault_at(scenario, "compare.engines.profiles", std::move(rule), profile)
               : Fault{scenario.file, {}, "--profiles", std::move(rule), profile});
    }
  }

  void throw_faults() const {
    if (!faults_.empty()) throw BadScenario(faults_);
  }

 private:
  void choose_profile(const Scenario& scenario, const std::string& key, bool of_grid,
                      const std::optional<EngineExecutable>& executable, EngineRecord& record) {
    if (!executable && !is_profile_path(record.profile)) return;  // the run is skipped for that
    const auto file =
        find_profile(executable.value_or(EngineExecutable{}), record.profile, folder_of(scenario));
    if (!file) {
      if (record.profile == "default") return;  // without a file the engine's own settings
      if (of_grid) {
        record.reason = fmt::format("{} has no profile '{}'", record.engine, record.profile);
        return;
      }
      std::vector<std::string> names = profile_names(*executable);
      if (std::ranges::find(names, "default") == names.end()) names.push_back("default");
      note(fault_at(scenario, key + ".profile",
                    fmt::format("must be one of the profiles of {}, {}, or a path{}", record.engine,
                                fmt::join(names, ", "), did_you_mean(record.profile, names)),
                    record.profile));
      return;
    }
    const Profile* profile = load(*file, scenario, key + ".profile", record.profile);
    if (profile == nullptr) return;
    check(*profile, record, executable);
    record.settings = profile->settings;
  }

  static fs::path folder_of(const Scenario& scenario) {
    return fs::path(scenario.file).parent_path();
  }

  static Fault fault_at(const Scenario& scenario, const std::string& key, std::string rule,
                        std::string value) {
    const auto place = scenario.locations.find(key);
    return {scenario.file, place == scenario.locations.end() ? Location{} : place->second, key,
            std::move(rule), std::move(value)};
  }

  /// The same file may be asked for at many places.
  void note(Fault fault) {
    if (noted_.insert(fault.message()).second) faults_.push_back(std::move(fault));
  }

  const Profile* load(const fs::path& file, const Scenario& scenario, const std::string& key,
                      const std::string& written) {
    const auto [found, is_new] = profiles_.try_emplace(file);
    if (!is_new && found->second) return &*found->second;
    std::string text;
    try {
      text = read_file(file);
    } catch (const BadScenario& bad) {
      const std::string rule = file.string() + ' ' + bad.faults().front().rule;
      note(fault_at(scenario, key, rule, written));
      return nullptr;
    }
    try {
      return &found->second.emplace(parse_profile(text, file.string()));
    } catch (const BadScenario& bad) {
      for (const Fault& fault : bad.faults()) note(fault);
      return nullptr;
    }
  }

  void check(const Profile& profile, const EngineRecord& record,
             const std::optional<EngineExecutable>& executable) {
    EngineInfo info{engine_family(record.engine), "", record.precision, {}};
    if (!profile.settings.empty()) {
      const EngineInfo* known = executable ? ask(executable->command) : nullptr;
      if (known == nullptr) return;  // the run will tell why
      info.settings = known->settings;
    }
    for (Fault& fault : check_profile(profile, info)) {
      if (&profile == &over_) fault.key.erase(0, fault.key.find('.') + 1);  // "settings."
      note(std::move(fault));
    }
  }

  bool takes_leaves_out(const WorkerCommand& command) {
    const EngineInfo* info = ask(command);
    return info && std::ranges::any_of(info->settings, [](const SettingInfo& setting) {
             return setting.name == "leaves_out";
           });
  }

  const EngineInfo* ask(const WorkerCommand& command) {
    const auto [found, is_new] = infos_.try_emplace(command);
    try {
      if (is_new) found->second = RemoteEngine(command, limits_, stop_).info();
    } catch (const WorkerFailure&) {
    } catch (const Interrupted&) {
    }
    return found->second ? &*found->second : nullptr;
  }

  WorkerLimits limits_;
  const std::atomic<bool>* stop_;
  bool general_;
  Profile over_;  // over every other; its engine is that of the record at hand
  std::vector<std::string> engines_ = engine_names();
  std::map<fs::path, std::optional<Profile>> profiles_;
  std::map<WorkerCommand, std::optional<EngineInfo>> infos_;  // none: it has failed
  std::vector<Fault> faults_;
  std::set<std::string> noted_;
};

/// What is expected is known of the scene's own size alone.
EngineRecord at_rate(EngineRecord record, double rate, double scale) {
  record.rate = rate;
  record.scale = scale;
  if (scale != 1) record.expect.reset();
  return record;
}

}  // namespace

void choose_headings(const Scenario& scenario, EngineRecord& record) {
  const std::string without = without_headings(scenario);
  if (without.empty())
    record.headings = scenario.compare.headings;
  else if (scenario.compare.headings > 1)
    record.warnings.push_back("headings are left out: " + without + " has directions of its own");
}

std::vector<std::vector<EngineRecord>> requested_runs(const std::vector<Scenario>& scenarios,
                                                      const WorkerLimits& limits,
                                                      const std::atomic<bool>* stop,
                                                      const Settings& settings, bool general,
                                                      bool whole) {
  Profiles profiles(limits, stop, settings, general);
  std::vector<std::vector<EngineRecord>> runs;
  for (const Scenario& scenario : scenarios) {
    std::vector<EngineRecord>& records = runs.emplace_back();
    profiles.check_size(scenario, whole);
    const std::vector<EngineRequest> requests = requests_of(scenario);
    for (std::size_t k = 0; k < requests.size(); ++k) {
      const EngineRequest& request = requests[k];
      EngineRecord record;
      record.engine = request.engine;
      record.precision = precision_of(request);
      record.profile = request.profile;
      record.expect = request.expect;
      choose_headings(scenario, record);
      profiles.choose(scenario, fmt::format("compare.engines[{}]", k), request.of_grid, record);
      for (const double rate : request.rates)
        for (const double scale : scenario.compare.scales)
          records.push_back(at_rate(record, rate, scale));
    }
    profiles.check_grid(scenario, records);
  }
  profiles.throw_faults();
  return runs;
}

}  // namespace slipcheck
