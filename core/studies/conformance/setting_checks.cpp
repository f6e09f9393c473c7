// Settings: what the table promises holds.

#include <fmt/format.h>

#include <cmath>

#include "engine/settings.h"
#include "studies/conformance/checks.h"
#include "studies/conformance/trial_scenes.h"

namespace slipcheck {
namespace {

constexpr std::size_t kSteps = 64;

/// A sphere that falls, bounces and slides within the steps of a run.
Scene eventful_scene() { return one_sphere(1e-3, {0.5, 0.2, -0.3}); }

/// Configures again what was taken before: a refusal must leave nothing behind.
void expect_still_usable(RemoteEngine& engine, const std::string& after) {
  try {
    const Scene scene = eventful_scene();
    engine.configure(scene, {}, kStep);
    run(engine, scene, 1);
  } catch (const WorkerFailure& failure) {
    throw Breach(fmt::format("after it refused {}: {}", after, failure.what()));
  } catch (const Refused& refused) {
    throw Breach(
        fmt::format("after it refused {} it refuses what it took: {}", after, refused.what()));
  }
}

/// Throws Breach unless the setting is refused with a reason.
void expect_refused(RemoteEngine& engine, const std::string& name, const Setting& value) {
  const std::string what = fmt::format("{}: {}", name, exact_text(value));
  try {
    engine.configure(eventful_scene(), {{name, value}}, kStep);
  } catch (const Refused& refused) {
    if (*refused.what() == '\0') throw Breach(fmt::format("it refuses {} without a reason", what));
    return;
  } catch (const WorkerFailure& failure) {
    throw Breach(fmt::format("{} is not refused: {}", what, failure.what()));
  }
  throw Breach(fmt::format("{} is taken", what));
}

std::string unknown_setting(const Trial& trial) {
  RemoteEngine engine = trial.engine();
  engine.configure(eventful_scene(), {}, kStep);
  expect_refused(engine, "no_such_setting", 1.0);
  expect_still_usable(engine, "a setting");
  return {};
}

/// Values that a setting must not take, by its own table.
std::vector<Setting> wrong_values(const SettingInfo& info) {
  std::vector<Setting> wrong;
  if (!std::holds_alternative<double>(info.shipped)) {
    wrong.emplace_back(0.5);
    if (!info.choices.empty()) wrong.emplace_back(std::string("no such choice"));
    return wrong;
  }
  wrong.emplace_back(true);
  wrong.emplace_back(std::string("a text"));
  if (std::isfinite(info.low)) wrong.emplace_back(info.low - 1);
  if (std::isfinite(info.high)) wrong.emplace_back(2 * std::abs(info.high) + 1);
  if (info.whole) wrong.emplace_back(std::get<double>(info.shipped) + 0.5);
  return wrong;
}

std::string values_outside(const Trial& trial) {
  RemoteEngine engine = trial.engine();
  if (engine.info().settings.empty()) throw NotJudged("it has no settings");
  engine.configure(eventful_scene(), {}, kStep);
  std::size_t count = 0;
  for (const SettingInfo& info : engine.info().settings)
    for (const Setting& value : wrong_values(info)) {
      expect_refused(engine, info.name, value);
      ++count;
    }
  expect_still_usable(engine, "values");
  return fmt::format("{} values refused", count);
}

std::string candidates(const Trial& trial) {
  RemoteEngine engine = trial.engine();
  const Scene scene = eventful_scene();
  std::size_t taken = 0, refused = 0;
  for (const SettingInfo& info : engine.info().settings)
    for (const Setting& value : info.candidates) {
      try {
        engine.configure(scene, {{info.name, value}}, kStep);
        run(engine, scene, 8);
        ++taken;
      } catch (const Refused&) {
        ++refused;
      } catch (const WorkerFailure& failure) {
        throw Breach(fmt::format("{}: {}: {}", info.name, exact_text(value), failure.what()));
      }
    }
  if (taken + refused == 0) throw NotJudged("there are none");
  return fmt::format("{} taken, {} refused", taken, refused);
}

std::string shipped_values(const Trial& trial) {
  RemoteEngine engine = trial.engine();
  if (engine.info().settings.empty()) throw NotJudged("it has no settings");
  const Scene scene = eventful_scene();
  engine.configure(scene, {}, kStep);
  const Frames without = run(engine, scene, kSteps);
  Settings shipped;
  for (const SettingInfo& info : engine.info().settings) shipped.emplace(info.name, info.shipped);
  try {
    engine.configure(scene, shipped, kStep);
  } catch (const Refused& refused) {
    throw Breach(fmt::format("it refuses the values that it ships: {}", refused.what()));
  }
  expect_same(without, run(engine, scene, kSteps), "with all settings as shipped and with none");
  return {};
}

std::string settings_forgotten(const Trial& trial) {
  RemoteEngine engine = trial.engine();
  const Scene scene = eventful_scene();
  engine.configure(scene, {}, kStep);
  const Frames before = run(engine, scene, kSteps);
  std::size_t count = 0;
  for (const SettingInfo& info : engine.info().settings)
    for (const Setting& value : info.candidates) {
      if (value == info.shipped) continue;
      try {
        engine.configure(scene, {{info.name, value}}, kStep);
        run(engine, scene, 1);
      } catch (const Refused&) {
        continue;
      }
      engine.configure(scene, {}, kStep);
      expect_same(
          before, run(engine, scene, kSteps),
          fmt::format("before and after a configure with {}: {}", info.name, exact_text(value)));
      ++count;
    }
  if (count == 0) throw NotJudged("no setting has a candidate that is not as shipped");
  return fmt::format("{} values forgotten", count);
}

}  // namespace

std::vector<Check> setting_checks() {
  return {
      {"unknown setting",
       "Refuse a setting that you do not have, {type: \"refused\", reason: text}, and stay usable.",
       unknown_setting},
      {"values outside",
       "Refuse values of another type, beyond low and high, not whole or not among the choices: a "
       "typing error must not pass for a result.",
       values_outside},
      {"candidates", "Take each candidate that the table offers, or refuse it with the reason.",
       candidates},
      {"shipped values", "Give as `shipped` what is in force where a profile says nothing.",
       shipped_values},
      {"settings forgotten",
       "Begin each configure with the shipped values: those of an earlier one no longer hold.",
       settings_forgotten},
  };
}

}  // namespace slipcheck
