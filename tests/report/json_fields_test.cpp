#include "base/json_fields.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <vector>

#include "records.h"

namespace slipcheck {

enum class Colour { red, green };
template <>
inline constexpr std::array kNamesOf<Colour> = {"red", "green"};

/// A record with fields of every kind.
struct EveryField {
  double number = 0;
  std::size_t count = 0, some = 0;
  bool flag = false;
  Colour colour = Colour::red;
  std::string text, reason;
  std::optional<double> optional, null;
  double limit = testing::kInfinity;
  std::vector<double> numbers;
  std::vector<std::vector<double>> rows;
  std::set<std::string> names;
  std::pair<double, double> point;
  std::map<std::string, double> by_name;
  std::map<std::string, std::variant<bool, double, std::string>> settings;
  std::vector<EveryField> inner;
};

template <class Fields>
void describe(Fields& f, EveryField& all) {
  f("number", all.number);
  f("count", all.count);
  f.if_any("some", all.some);
  f("flag", all.flag);
  f("colour", all.colour);
  f("text", all.text);
  f.reason(all.reason);
  f("optional", all.optional);
  f.or_null("null", all.null, "there is none");
  f.if_finite("limit", all.limit);
  f("numbers", all.numbers, "some are null");
  f("rows", all.rows);
  f("names", all.names);
  f("point", all.point);
  f("by_name", all.by_name);
  f("settings", all.settings);
  f("inner", all.inner);
}

namespace testing {
namespace {

EveryField read_back(const EveryField& all) {
  const std::string file = "x.json";
  const auto json = nlohmann::json::parse(written(all).dump());
  auto again = read_record<EveryField>(JsonNode(json, file));
  EXPECT_EQ(written(again).dump(), written(all).dump());
  return again;
}

TEST(JsonFields, ComeBackAsTheyWere) {
  EveryField all;
  all.number = 0.1 + 0.2;
  all.count = 7;
  all.some = 2;
  all.flag = true;
  all.colour = Colour::green;
  all.text = "µ \"x\"";
  all.reason = "it ended";
  all.optional = 3;
  all.null = -2.5;
  all.limit = 1e300;
  all.numbers = {1, 2.5};
  all.rows = {{1}, {}, {2, 3}};
  all.names = {"a", "b"};
  all.point = {1, 2};
  all.by_name = {{"i.spin", 4}};
  all.settings = {{"erp", 0.2}, {"on", true}, {"body", std::string("rigid")}};
  all.inner.resize(2);
  const EveryField again = read_back(all);
  EXPECT_EQ(again.number, 0.1 + 0.2);
  EXPECT_EQ(again.count, 7u);
  EXPECT_EQ(again.some, 2u);
  EXPECT_TRUE(again.flag);
  EXPECT_EQ(again.colour, Colour::green);
  EXPECT_EQ(again.text, all.text);
  EXPECT_EQ(again.reason, "it ended");
  EXPECT_EQ(again.optional, 3);
  EXPECT_EQ(again.null, -2.5);
  EXPECT_EQ(again.limit, 1e300);
  EXPECT_EQ(again.numbers, all.numbers);
  EXPECT_EQ(again.rows, all.rows);
  EXPECT_EQ(again.names, all.names);
  EXPECT_EQ(again.point, all.point);
  EXPECT_EQ(again.by_name, all.by_name);
  EXPECT_EQ(again.settings, all.settings);
  ASSERT_EQ(again.inner.size(), 2u);
  EXPECT_EQ(again.inner[1].limit, kInfinity);
  EXPECT_FALSE(again.inner[1].null);
}

TEST(JsonFields, WhatIsNotFiniteComesBackToo) {
  for (const double odd : {kInfinity, -kInfinity, kNaN}) {
    const auto is_odd = [&](double value) {
      return std::isnan(odd) ? std::isnan(value) : value == odd;
    };
    EveryField all;
    all.number = odd;
    all.reason = "number is infinite; so it is";
    all.optional = odd;
    all.null = odd;
    all.numbers = {1, odd, 2};
    all.rows = {{1}, {2, odd}};
    all.by_name = {{"i.spin", odd}, {"j.spin", 1}};
    all.settings = {{"limit", odd}, {"on", true}};
    const EveryField again = read_back(all);
    EXPECT_TRUE(is_odd(again.number));
    EXPECT_EQ(again.reason, all.reason);  // though it sounds like that of a null
    EXPECT_TRUE(is_odd(again.optional.value()));
    EXPECT_TRUE(is_odd(again.null.value()));
    EXPECT_TRUE(is_odd(again.numbers.at(1)));
    EXPECT_TRUE(is_odd(again.rows.at(1).at(1)));
    EXPECT_TRUE(is_odd(again.by_name.at("i.spin")));
    EXPECT_EQ(again.by_name.size(), 2u);
    EXPECT_TRUE(is_odd(std::get<double>(again.settings.at("limit"))));
    EXPECT_EQ(again.settings.size(), 2u);
  }
}

TEST(JsonFields, OfAMessageAllNumbersButSettingsAreFinite) {
  const std::string file = "request";
  EveryField all;
  all.null = 1;
  nlohmann::json json = nlohmann::json::parse(written(all).dump());
  json["settings"]["limit"] = kInfinity;
  EveryField again;
  BasicFieldReader<true>::read(JsonNode(json, file), again);
  EXPECT_EQ(std::get<double>(again.settings.at("limit")), kInfinity);
  json["numbers"] = {1, nullptr};
  EXPECT_THROW(BasicFieldReader<true>::read(JsonNode(json, file), again), BadJson);
  json["numbers"] = {1, kInfinity};
  EXPECT_THROW(BasicFieldReader<true>::read(JsonNode(json, file), again), BadJson);
}

}  // namespace
}  // namespace testing
}  // namespace slipcheck
