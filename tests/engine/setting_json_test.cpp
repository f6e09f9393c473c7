#include "engine/setting_json.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../support/refusal.h"
#include "engine/message_fields.h"
#include "some_scene.h"

namespace slipcheck::protocol {
namespace {

using nlohmann::json;

const std::string kPlace = "settings";

std::vector<SettingInfo> infos_of(const json& list) {
  return setting_infos_from_json(JsonNode(list, kPlace));
}

Settings settings_of(const json& object) { return read_finite<Settings>(JsonNode(object, kPlace)); }

TEST(SettingJson, WhatAnEngineTakesComesThrough) {
  const std::vector<SettingInfo> sent = some_settings();
  const auto received = infos_of(setting_infos_to_json(sent));
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
  const Settings settings = settings_of({{"a", 1}, {"b", 1.5}, {"c", true}, {"d", "1"}});
  EXPECT_EQ(settings, (Settings{{"a", 1.0}, {"b", 1.5}, {"c", true}, {"d", std::string("1")}}));
}

/// The setting `erp` or `body` of some_settings() with another member.
json changed(std::size_t which, const char* key, const json& value) {
  json list = setting_infos_to_json(some_settings());
  list[which][key] = value;
  return list;
}

void expect_rubbish(const json& list, const std::string& reason) {
  EXPECT_EQ(test::refusal_of<BadJson>([&] { infos_of(list); }), "settings: " + reason);
}

TEST(SettingJson, InfosThatContradictThemselvesAreRubbish) {
  constexpr std::size_t kErp = 1, kIterations = 2, kBody = 3;
  expect_rubbish(changed(kErp, "name", "Erp"),
                 "[1].name: must be a name of a-z, 0-9 and _, got \"Erp\"");
  expect_rubbish(changed(kErp, "name", ""), "[1].name: must be a name of a-z, 0-9 and _, got \"\"");
  expect_rubbish(changed(kErp, "name", "warm_starting"),
                 "[1].name: must be the name of no other, got \"warm_starting\"");
  expect_rubbish(changed(kErp, "shipped", json::array()),
                 "[1].shipped: must be a number, got a list");
  expect_rubbish(changed(kErp, "shipped", 2),
                 "[1].shipped: must be a number >= 0 and <= 1 1/step, got 2");
  expect_rubbish(changed(kErp, "shipped", std::nan("")),
                 "[1].shipped: must be a number >= 0 and <= 1 1/step, got nan");
  expect_rubbish(changed(kErp, "low", "none"), "[1].low: must be a number, got \"none\"");
  expect_rubbish(changed(kErp, "whole", 1), "[1].whole: must be true or false, got 1");
  expect_rubbish(changed(kErp, "candidates", {0.1, "x"}),
                 "[1].candidates[1]: must be a number >= 0 and <= 1 1/step, got \"x\"");
  expect_rubbish(changed(kIterations, "candidates", {0}),
                 "[2].candidates[0]: must be a whole number >= 1, got 0");
  expect_rubbish(changed(kErp, "choices", {"a"}),
                 "[1].shipped: must be a text, as it has choices, got 0.2");
  expect_rubbish(changed(kBody, "choices", {"soft"}),
                 "[3].shipped: must be one of soft, got \"rigid\"");
  expect_rubbish(changed(kBody, "low", 0),
                 "[3].shipped: must be a number, as it has limits, got \"rigid\"");
  const auto range = [](double low, double high, bool logarithmic) {
    return json{{"low", low}, {"high", high}, {"logarithmic", logarithmic}};
  };
  const std::string no_range = "[1].range: must be a range of what the setting takes";
  expect_rubbish(changed(kErp, "range", range(-1, 1, false)), no_range);
  expect_rubbish(changed(kErp, "range", range(0, 2, false)), no_range);
  expect_rubbish(changed(kErp, "range", range(0.5, 0.5, false)), no_range);
  expect_rubbish(changed(kErp, "range", range(0, 1, true)),
                 "[1].range: must be > 0, as it is logarithmic");
  EXPECT_NO_THROW(infos_of(changed(kErp, "range", range(0, 1, false))));
  expect_rubbish(json::array({3}), "[0]: must be an object, got 3");
}

TEST(SettingJson, AMissingMemberIsNamed) {
  for (const char* key : {"name", "about", "unit", "shipped", "whole", "choices", "candidates"}) {
    json list = setting_infos_to_json(some_settings());
    list[0].erase(key);
    expect_rubbish(list, std::string("[0].") + key + ": must be there");
  }
}

TEST(SettingJson, OtherValuesAreNoSettings) {
  for (const json& value : {json(), json::array(), json::object()})
    EXPECT_THROW(settings_of({{"erp", value}}), BadJson);
  EXPECT_THROW(settings_of({{"erp", "\xff"}}), BadJson);
}

}  // namespace
}  // namespace slipcheck::protocol
