#include "engine/setting_json.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../support/refusal.h"
#include "engine/fields.h"
#include "some_scene.h"

namespace slipcheck::protocol {
namespace {

using nlohmann::json;

TEST(SettingJson, WhatAnEngineTakesComesThrough) {
  const std::vector<SettingInfo> sent = some_settings();
  const auto received = setting_infos_from_json(setting_infos_to_json(sent));
  ASSERT_EQ(received.size(), sent.size());
  for (std::size_t k = 0; k < sent.size(); ++k) {
    const SettingInfo &a = sent[k], &b = received[k];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.about, b.about);
    EXPECT_EQ(a.unit, b.unit);
    EXPECT_EQ(a.shipped, b.shipped) << a.name;
    EXPECT_EQ(a.low, b.low) << a.name;
    EXPECT_EQ(a.high, b.high) << a.name;
    EXPECT_EQ(a.whole, b.whole) << a.name;
    EXPECT_EQ(a.choices, b.choices) << a.name;
    EXPECT_EQ(a.candidates, b.candidates) << a.name;
    ASSERT_EQ(a.range.has_value(), b.range.has_value()) << a.name;
    if (a.range) {
      EXPECT_EQ(a.range->low, b.range->low);
      EXPECT_EQ(a.range->high, b.range->high);
      EXPECT_EQ(a.range->logarithmic, b.range->logarithmic);
    }
  }
}

TEST(SettingJson, NumbersOfAnyKindAreNumbers) {
  const Settings settings = settings_from_json({{"a", 1}, {"b", 1.5}, {"c", true}, {"d", "1"}});
  EXPECT_EQ(settings, (Settings{{"a", 1.0}, {"b", 1.5}, {"c", true}, {"d", std::string("1")}}));
}

/// The setting `erp` or `body` of some_settings() with another member.
json changed(std::size_t which, const char* key, const json& value) {
  json list = setting_infos_to_json(some_settings());
  list[which][key] = value;
  return list;
}

void expect_rubbish(const json& list, const std::string& reason) {
  EXPECT_EQ(test::refusal_of<Rubbish>([&] { setting_infos_from_json(list); }), reason);
}

TEST(SettingJson, InfosThatContradictThemselvesAreRubbish) {
  constexpr std::size_t kErp = 1, kIterations = 2, kBody = 3;
  expect_rubbish(changed(kErp, "name", "Erp"),
                 "reply.settings[1].name is no name of a-z, 0-9 and _");
  expect_rubbish(changed(kErp, "name", ""), "reply.settings[1].name is no name of a-z, 0-9 and _");
  expect_rubbish(changed(kErp, "name", "warm_starting"),
                 "reply.settings[1] is a second warm_starting");
  expect_rubbish(changed(kErp, "shipped", json::array()),
                 "reply.settings[1].shipped is no number, text, true or false");
  expect_rubbish(changed(kErp, "shipped", 2),
                 "reply.settings[1].shipped must be a number >= 0 and <= 1 1/step");
  expect_rubbish(changed(kErp, "shipped", std::nan("")),
                 "reply.settings[1].shipped must be a number >= 0 and <= 1 1/step");
  expect_rubbish(changed(kErp, "low", "none"), "reply.settings[1].low is not a number");
  expect_rubbish(changed(kErp, "whole", 1), "reply.settings[1].whole is neither true nor false");
  expect_rubbish(changed(kErp, "candidates", {0.1, "x"}),
                 "reply.settings[1].candidates must be a number >= 0 and <= 1 1/step");
  expect_rubbish(changed(kIterations, "candidates", {0}),
                 "reply.settings[2].candidates must be a whole number >= 1");
  expect_rubbish(changed(kErp, "choices", {"a"}),
                 "reply.settings[1].shipped is no text, but has choices");
  expect_rubbish(changed(kBody, "choices", {"soft"}),
                 "reply.settings[3].shipped must be one of soft");
  expect_rubbish(changed(kBody, "low", 0),
                 "reply.settings[3].shipped is no number, but has limits");
  const auto range = [](double low, double high, bool logarithmic) {
    return json{{"low", low}, {"high", high}, {"logarithmic", logarithmic}};
  };
  const std::string no_range = "reply.settings[1].range is no range of what the setting takes";
  expect_rubbish(changed(kErp, "range", range(-1, 1, false)), no_range);
  expect_rubbish(changed(kErp, "range", range(0, 2, false)), no_range);
  expect_rubbish(changed(kErp, "range", range(0.5, 0.5, false)), no_range);
  expect_rubbish(changed(kErp, "range", range(0, 1, true)),
                 "reply.settings[1].range is logarithmic, but not > 0");
  EXPECT_NO_THROW(setting_infos_from_json(changed(kErp, "range", range(0, 1, false))));
  expect_rubbish(json::array({3}), "reply.settings[0] is not a map");
}

TEST(SettingJson, AMissingMemberIsNamed) {
  for (const char* key : {"name", "about", "unit", "shipped", "whole", "choices", "candidates"}) {
    json list = setting_infos_to_json(some_settings());
    list[0].erase(key);
    expect_rubbish(list, std::string("reply.settings[0].") + key + " is missing");
  }
}

TEST(SettingJson, OtherValuesAreNoSettings) {
  for (const json& value : {json(), json::array(), json::object()})
    EXPECT_THROW(settings_from_json({{"erp", value}}), Rubbish);
  EXPECT_THROW(settings_from_json({{"erp", "\xff"}}), Rubbish);
}

}  // namespace
}  // namespace slipcheck::protocol
