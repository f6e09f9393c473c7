#include "engine/settings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "some_scene.h"

namespace slipcheck {
namespace {

TEST(Settings, WhatTheEngineTakesHasNoFault) {
  const std::vector<SettingInfo> known = some_settings();
  EXPECT_TRUE(check_settings(known, {}).empty());
  for (const Settings& settings :
       {Settings{{"warm_starting", false}}, Settings{{"erp", 0.0}}, Settings{{"erp", 1.0}},
        Settings{{"iterations", 1.0}}, Settings{{"iterations", 1e9}},
        Settings{{"body", std::string("multibody")}}, Settings{{"label_2", std::string("any")}}})
    EXPECT_TRUE(check_settings(known, settings).empty()) << settings.begin()->first;
}

TEST(Settings, EveryFaultIsNamedWithItsRule) {
  const double infinity = std::numeric_limits<double>::infinity();
  struct Case {
    std::string name;
    Setting value;
    std::string rule, shown;
  };
  for (const Case& c : {
           Case{"warm_starting", 1.0, "must be true or false", "1"},
           Case{"warm_starting", std::string("yes"), "must be true or false", "yes"},
           Case{"erp", -1e-9, "must be a number >= 0 and <= 1 1/step", "-1e-09"},
           Case{"erp", 1.0000001, "must be a number >= 0 and <= 1 1/step", "1.0000001"},
           Case{"erp", std::nan(""), "must be a number >= 0 and <= 1 1/step", "nan"},
           Case{"erp", true, "must be a number >= 0 and <= 1 1/step", "true"},
           Case{"iterations", 2.5, "must be a whole number >= 1", "2.5"},
           Case{"iterations", 0.0, "must be a whole number >= 1", "0"},
           Case{"iterations", infinity, "must be a whole number >= 1", "inf"},
           Case{"body", std::string("soft"), "must be one of rigid, multibody", "soft"},
           Case{"body", 2.0, "must be one of rigid, multibody", "2"},
           Case{"label_2", false, "must be a word", "false"},
           Case{"earp", 0.2, "is no setting of this engine", ""},
       }) {
    const auto faults = check_settings(some_settings(), {{c.name, c.value}});
    ASSERT_EQ(faults.size(), 1u) << c.name << ' ' << c.shown;
    EXPECT_EQ(faults[0].name, c.name);
    EXPECT_EQ(faults[0].rule, c.rule);
    EXPECT_EQ(faults[0].value, c.shown);
  }
}

TEST(Settings, AllFaultsAreFoundAtOnce) {
  const auto faults = check_settings(
      some_settings(), {{"body", true}, {"erp", 0.5}, {"iterations", 0.5}, {"none", 0.0}});
  ASSERT_EQ(faults.size(), 3u);
  EXPECT_EQ(faults[0].name, "body");
  EXPECT_EQ(faults[1].name, "iterations");
  EXPECT_EQ(faults[2].name, "none");
}

}  // namespace
}  // namespace slipcheck
