// The table of settings, and that each one arrives.

#include "engine/settings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "../support/refusal.h"
#include "bullet_run.h"

namespace slipcheck {
namespace {

class BulletSettingsTable : public ::testing::Test {
 protected:
  RemoteEngine engine_{bullet_executable("double")};
  const std::vector<SettingInfo>& table() const { return engine_.info().settings; }
};

TEST_F(BulletSettingsTable, NamesUnitsAndValuesAreWellFormed) {
  std::set<std::string> names;
  for (const SettingInfo& info : table()) {
    EXPECT_TRUE(names.insert(info.name).second) << info.name << " twice";
    EXPECT_EQ(info.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"),
              std::string::npos)
        << info.name;
    EXPECT_FALSE(info.about.empty()) << info.name;
    EXPECT_EQ(broken_rule(info, info.shipped), "") << info.name;
    for (const Setting& value : info.candidates)
      EXPECT_EQ(broken_rule(info, value), "") << info.name;
    if (info.range) {
      EXPECT_EQ(broken_rule(info, info.range->low), "") << info.name;
      EXPECT_EQ(broken_rule(info, info.range->high), "") << info.name;
      EXPECT_LT(info.range->low, info.range->high) << info.name;
    }
    EXPECT_EQ(std::holds_alternative<std::string>(info.shipped), !info.choices.empty())
        << info.name;
  }
  EXPECT_GT(names.size(), 50u);
}

TEST_F(BulletSettingsTable, EachSettingArrivesAndLeavesTheOthersAlone) {
  const Scene scene =
      scene_of(steel_ball(0.01), {rolling_along_x(0.01, 0, 0), rolling_along_x(0.01, 1, 0)},
               ground_with_friction(0.1));
  const auto value_of = [](const Applied& applied, const SettingInfo& info) -> Setting {
    const auto found = applied.settings.find(info.name);
    return found == applied.settings.end() ? Setting("missing") : found->second;
  };
  // What Bullet is asked back for may have been stored in single precision.
  const auto same = [](const Setting& a, const Setting& b) {
    const double *x = std::get_if<double>(&a), *y = std::get_if<double>(&b);
    return x && y ? std::abs(*x - *y) <= 1e-7 * std::abs(*y) : a == b;
  };
  for (const SettingInfo& changed : table()) {
    const Setting value = another(changed);
    const Applied applied = engine_.configure(scene, {{changed.name, value}}, 1e-3);
    for (const SettingInfo& each : table()) {
      Setting expected = each.name == changed.name ? value : each.shipped;
      // Without warm starting Bullet is given no part of the old impulse.
      if (changed.name == "warm_starting" && each.name == "warm_starting_factor") expected = 0.0;
      EXPECT_TRUE(same(value_of(applied, each), expected))
          << each.name << " is " << exact_text(value_of(applied, each)) << " after " << changed.name
          << " = " << exact_text(value);
    }
  }
}

TEST_F(BulletSettingsTable, EveryShippedProfileIsTaken) {
  const auto folder = std::filesystem::path(SLIPCHECK_BINARY_DIR) / "profiles" / "bullet";
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const Profile profile = load_profile(entry.path());
    EXPECT_EQ(profile.name, entry.path().stem()) << entry.path();
    EXPECT_FALSE(profile.about.empty()) << entry.path();
    EXPECT_TRUE(check_profile(profile, engine_.info()).empty()) << entry.path();
    names.insert(profile.name);
  }
  for (const char* name : {"naive", "default", "physical", "tuned", "fast"})
    EXPECT_TRUE(names.contains(name)) << name;
}

TEST_F(BulletSettingsTable, DefaultAndNaiveAreWhatTheirNamesSay) {
  EXPECT_EQ(shipped("default"), kDefault);
  EXPECT_EQ(shipped("naive"), kNaive);
}

TEST_F(BulletSettingsTable, TheSameBitsWhereTheShippedValuesAreSpelledOut) {
  PairContact pair;
  pair.restitution = 0.9;
  const Scene scene =
      scene_of(steel_ball(0.01), {rolling_along_x(0.01, 0, 0.3), rolling_along_x(0.01, 0.03, 0)},
               ground_with_friction(0.1), pair);
  Settings spelled_out;
  for (const SettingInfo& info : table()) spelled_out[info.name] = info.shipped;
  const auto silent = run(engine_, scene, {}, 240, 60),
             spelled = run(engine_, scene, spelled_out, 240, 60);
  EXPECT_EQ(silent.back().bodies[1].velocity, spelled.back().bodies[1].velocity);
  EXPECT_GT(silent.back().bodies[1].velocity.x(), 0);
}

TEST(BulletReach, ScenesBeyondItAreRefusedOrTold) {
  RemoteEngine engine(bullet_executable("double"));
  const double radius = 0.002, rate = 240;
  const auto approach = [&](double radii) {  // in a step
    const double speed = radii * radius * rate;
    Scene scene = scene_of(steel_ball(radius),
                           {rolling_along_x(radius, 0, speed), rolling_along_x(radius, 1, 0)},
                           ground_with_friction(0.1), PairContact{0.0, 0, -1});
    scene.bodies[0].radius *= 2;  // the smaller one's counts
    return scene;
  };
  const Settings limited = {{"reach", 0.5}};
  EXPECT_TRUE(engine.configure(approach(0.49), limited, 1 / rate).not_represented.empty());
  EXPECT_EQ(texts_of(engine.configure(approach(0.51), limited, 1 / rate).not_represented),
            std::vector<std::string>{"an approach of 0.51 radii in a step: the profile is meant "
                                     "for up to 0.5"});
  const Settings strict = with(limited, {{"beyond_reach", "refuse"}});
  EXPECT_NO_THROW(engine.configure(approach(0.49), strict, 1 / rate));
  EXPECT_EQ(test::refusal_of<Refused>([&] { engine.configure(approach(0.51), strict, 1 / rate); }),
            "bullet: bodies approach each other by 0.51 radii in a step, and these settings "
            "are for up to 0.5");
}

}  // namespace
}  // namespace slipcheck
