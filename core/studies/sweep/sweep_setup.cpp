#include "studies/sweep/sweep_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "base/enum_names.h"
#include "engine/remote_engine.h"
#include "engine/settings.h"
#include "harness/run/requested_runs.h"
#include "scenario/fault.h"
#include "scenario/file_text.h"
#include "studies/sweep/sweep_choice.h"

namespace slipcheck {
namespace {

using Kind = SweepParameter::Kind;

constexpr std::array kKindNames = {"scene", "engine", "version", "precision", "profile",
                                   "rate",  "scale",  "phases",  "setting"};

EngineRequest request_of(const SweepChoice& choice) {
  EngineRequest request;
  request.engine = choice.engine_name();
  if (!choice.precision.empty())
    request.precision = choice.precision == "single" ? EngineRequest::Precision::single_
                                                     : EngineRequest::Precision::double_;
  request.profile = choice.profile;
  request.rates = {1};
  return request;
}

/// The fault as one of the sweep: what is there a request of `compare` is here a name that varies.
Fault as_sweeps(Fault fault) {
  const std::size_t end = fault.key.find("].");
  if (fault.key.starts_with("compare.engines[") && end != std::string::npos)
    fault.key = "sweep." + fault.key.substr(end + 2);
  return fault;
}

}  // namespace

SweepSetup::Key SweepSetup::key_of(const SweepChoice& choice) {
  return {choice.engine_name(), choice.precision, choice.profile};
}

SweepSetup::SweepSetup(SweepPlan plan, const WorkerLimits& limits, const std::atomic<bool>* stop)
    : plan_(std::move(plan)) {
  if (!plan_.is_reference_alone()) choose_engines(limits, stop);
  for (std::size_t part = 0; part < plan_.parts().size(); ++part) check_settings_of(part);

  ReadNumbers numbers;
  for (const SweepParameter& parameter : plan_.parameters())
    if (parameter.kind == Kind::scene) numbers[parameter.path.text()];
  plan_.scene(0, &numbers);
  for (const SweepParameter& parameter : plan_.parameters()) {
    StoreColumn column{parameter.name, "", kKindNames[static_cast<std::size_t>(parameter.kind)]};
    if (parameter.kind == Kind::scene) {
      const auto& number = numbers[parameter.path.text()];
      if (number) column.unit = number->unit;
    } else if (parameter.kind == Kind::rate) {
      column.unit = "Hz";
    } else if (parameter.kind == Kind::setting) {
      for (const auto& [key, engine] : engines_)
        if (const SettingInfo* info = find_setting(engine.info.settings, parameter.setting))
          column.unit = info->unit;
    }
    columns_.push_back(std::move(column));
  }
}

void SweepSetup::choose_engines(const WorkerLimits& limits, const std::atomic<bool>* stop) {
  std::map<Kind, Location> places;
  for (const SweepParameter& parameter : plan_.parameters())
    places.try_emplace(parameter.kind, parameter.location);
  // What the scene itself asks for is wrong at its own place.
  if (!places.contains(Kind::engine)) requested_runs({plan_.whole_scene(0)}, limits, stop);

  const std::vector<SweepChoice> choices = plan_.engine_choices();
  Scenario asking = plan_.scene(0);
  asking.compare.engines.clear();
  asking.compare.all_engines.reset();
  asking.compare.scales = {1};
  const auto place = [&](std::size_t k, const char* key, Kind kind) {
    if (const auto found = places.find(kind); found != places.end())
      asking.locations[fmt::format("compare.engines[{}].{}", k, key)] = found->second;
  };
  for (std::size_t k = 0; k < choices.size(); ++k) {
    asking.compare.engines.push_back(request_of(choices[k]));
    place(k, "engine", Kind::engine);
    place(k, "profile", Kind::profile);
  }
  std::vector<EngineRecord> records;
  std::vector<Fault> faults;
  const auto note = [&](Fault fault) {
    const auto same = [&](const Fault& each) { return each.message() == fault.message(); };
    if (std::ranges::none_of(faults, same)) faults.push_back(std::move(fault));
  };
  try {
    records = requested_runs({asking}, limits, stop).front();
  } catch (const BadScenario& bad) {
    for (const Fault& fault : bad.faults()) note(as_sweeps(fault));
    throw BadScenario(faults);
  }
  std::map<WorkerCommand, EngineInfo> infos;
  for (std::size_t k = 0; k < choices.size(); ++k) {
    EngineRecord& record = records[k];
    const auto found = find_engine(record.engine, record.precision);
    if (!found) {
      note({plan_.file(), places[Kind::engine], "sweep.engine",
            "must be installed: " + not_installed_text(record.engine, record.precision), ""});
      continue;
    }
    const auto [info, is_new] = infos.try_emplace(found->command);
    if (is_new) info->second = RemoteEngine(found->command, limits, stop).info();
    engines_.insert({key_of(choices[k]), {found->command, std::move(record), info->second}});
  }
  if (!faults.empty()) throw BadScenario(faults);
}

/// Settings must be known to all engines, or to that which is chosen in the same row.
void SweepSetup::check_settings_of(std::size_t part) const {
  const SweepPart& rows = plan_.parts()[part];
  std::vector<SweepParameter> named;
  for (const SweepName& name : rows.names) named.push_back(named_parameter(name));
  const auto is_of_kind = [&](Kind kind) {
    return std::ranges::any_of(named,
                               [&](const SweepParameter& each) { return each.kind == kind; });
  };
  if (!is_of_kind(Kind::setting)) return;
  std::vector<Fault> faults;
  std::set<std::string> told;
  for (std::size_t row = 0; row < rows.count; ++row) {
    SweepChoice choice;
    Reading ignored(plan_.file(), UnitSystem::si);
    for (std::size_t k = 0; k < named.size(); ++k)
      if (named[k].kind != Kind::scene) choose(named[k], *rows.value(row, k), ignored, choice);
    for (const auto& [key, engine] : engines_) {
      if (is_of_kind(Kind::engine) && std::get<0>(key) != choice.engine_name()) continue;
      for (const SettingFault& fault : check_settings(engine.info.settings, choice.settings)) {
        const auto parameter = std::ranges::find(named, fault.name, &SweepParameter::setting);
        Fault told_fault{plan_.file(), parameter->location, "sweep." + parameter->name,
                         fmt::format("{} ({})", fault.rule, engine.info.engine), fault.value};
        if (told.insert(told_fault.message()).second) faults.push_back(std::move(told_fault));
      }
    }
    if (faults.size() > 100) break;
  }
  if (!faults.empty()) throw BadScenario(std::move(faults));
}

const SweepSetup::Engine& SweepSetup::engine(const SweepChoice& choice) const {
  return engines_.at(key_of(choice));
}

EngineRecord SweepSetup::record_of(const SweepChoice& choice) const {
  EngineRecord record = engine(choice).record;
  record.expect.reset();
  record.rate = choice.rate;
  record.scale = choice.scale;
  for (const auto& [name, value] : choice.settings) record.settings[name] = value;
  return record;
}

StoreHead SweepSetup::head(const std::string& program) const {
  std::string content = plan_.digest();
  for (const auto& [key, engine] : engines_) {
    content += fmt::format("\n{} {} {}", engine.record.engine, engine.record.precision,
                           engine.record.profile);
    for (const auto& [name, value] : engine.record.settings)
      content += fmt::format(" {}={}", name, exact_text(value));
  }
  return {plan_.name(), sha256_hex(content), plan_.runs(), program, plan_.text(), columns_};
}

std::vector<std::array<std::string, 3>> SweepSetup::versions() const {
  std::set<std::array<std::string, 3>> versions;
  for (const auto& [key, engine] : engines_)
    versions.insert(
        {engine_family(engine.record.engine), engine.record.precision, engine.info.version});
  return {versions.begin(), versions.end()};
}

}  // namespace slipcheck
