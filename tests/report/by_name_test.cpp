#include "base/by_name.h"

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace slipcheck {
namespace {

/// Longer than what a string holds without memory of its own.
const std::string kFirst = "i.angular_velocity_after_collision.x";
const std::string kSecond = "i.angular_velocity_after_collision.y";
const std::string kThird = "j.sliding_time";

std::vector<std::string> names_in(const ByName<int>& values) {
  std::vector<std::string> names;
  for (const auto& [name, value] : values) names.emplace_back(name);
  return names;
}

TEST(ByName, KeepsTheOrderOfNamesHoweverTheyCome) {
  ByName<int> values;
  values[kThird] = 3;
  values[kFirst] = 1;
  EXPECT_EQ(values.emplace(kSecond, 2), 2);
  EXPECT_EQ(values.emplace(kSecond, 7), 2);  // it is there
  EXPECT_EQ(names_in(values), (std::vector{kFirst, kSecond, kThird}));
  ByName<int> appended;
  appended.append(kFirst, 1);
  appended.append(kSecond, 2);
  appended.append(kThird, 3);
  EXPECT_EQ(values, appended);
}

TEST(ByName, FindsWhatIsThere) {
  ByName<int> values{{kThird, 3}, {kFirst, 1}};
  EXPECT_EQ(values.at(kThird), 3);
  EXPECT_EQ(*find_in(values, kFirst), 1);
  EXPECT_EQ(find_in(values, kSecond), nullptr);
  EXPECT_FALSE(values.contains("j.sliding_tim"));
  EXPECT_FALSE(values.contains("k"));  // after all
  EXPECT_THROW(values.at(kSecond), std::out_of_range);
  values.at(kFirst) = 5;
  EXPECT_EQ(values.at(kFirst), 5);
  values.erase(kSecond);
  values.erase(kFirst);
  EXPECT_EQ(names_in(values), std::vector{kThird});
}

TEST(ByName, OwnsItsNames) {
  auto values = std::make_unique<ByName<int>>();
  std::string name = kFirst;
  (*values)[name] = 1;
  name.assign(name.size(), '?');
  (*values)[kSecond] = 2;
  const ByName<int> copied = *values;
  ByName<int> moved = std::move(*values);
  values.reset();
  EXPECT_EQ(names_in(copied), (std::vector{kFirst, kSecond}));
  EXPECT_EQ(names_in(moved), (std::vector{kFirst, kSecond}));
  ByName<int> assigned{{kThird, 3}};
  assigned = copied;
  moved.clear();
  EXPECT_TRUE(moved.empty());
  moved[kThird] = 3;
  EXPECT_EQ(names_in(moved), std::vector{kThird});
  EXPECT_EQ(assigned, copied);
}

}  // namespace
}  // namespace slipcheck
