#include "report/rows/quantity.h"

#include <gtest/gtest.h>

#include "records.h"

namespace slipcheck::testing {
namespace {

TEST(Quantity, ChoosesSensiblePrefixes) {
  EXPECT_EQ(quantity(0.083007, kTime), "83.01 ms");
  EXPECT_EQ(quantity(0.0078262, kLength), "7.826 mm");
  EXPECT_EQ(quantity(0.053571, kVelocity), "53.57 mm/s");
  EXPECT_EQ(quantity(-1.2345, kVelocity), "-1.234 m/s");
  EXPECT_EQ(quantity(2.1e-6, kTime, 2), "2.1 µs");
  EXPECT_EQ(quantity(5.0 / 14, kPureNumber), "0.3571");
  EXPECT_EQ(quantity(1e-3, kLength), "1.000 mm");
  EXPECT_EQ(quantity(75, kAngularVelocity), "75.00 rad/s");
}

TEST(Quantity, HasWordsForWhatIsNoOrdinaryNumber) {
  EXPECT_EQ(quantity(0, kLength), "0 m");
  EXPECT_EQ(quantity(kNaN, kLength), "–");
  EXPECT_EQ(quantity(kInfinity, kLength), "∞ m");
  EXPECT_EQ(quantity(2.5e-13, kLength), "0.00025 nm");
  EXPECT_EQ(quantity(3e-17, kPureNumber), "3e-17");
  EXPECT_EQ(quantity(1e9, kLength), "1e+09 m");
}

TEST(Quantity, ShowsARowInOneUnit) {
  const QuantityFormat format(0.0830, kTime);
  EXPECT_EQ(format.unit(), "ms");
  EXPECT_EQ(format.number(0.0872), "87.20");
  EXPECT_EQ(format.number(0.8208), "820.80");
  EXPECT_EQ(format.number(0), "0");
  EXPECT_EQ(format.number(1e-9), "1e-06");  // not "0.00", which it is not
  EXPECT_EQ(format.number(1e6), "1e+09");
}

TEST(Quantity, RoundsUpWithoutAnExtraDigit) {
  EXPECT_EQ(quantity(0.99999999, kPureNumber), "1.000");
  EXPECT_EQ(quantity(0.00099999999, kTime), "1.000 ms");
}

TEST(Quantity, GivesPercentWithThreeDigits) {
  EXPECT_EQ(percent(0.1412), "14.1 %");
  EXPECT_EQ(percent(0.005034), "0.503 %");
  EXPECT_EQ(percent(49.23), "4923 %");
  EXPECT_EQ(percent(1), "100 %");
  EXPECT_EQ(percent(0), "0 %");
  EXPECT_EQ(percent(3e-12), "3.0e-10 %");
  EXPECT_EQ(percent(kNaN), "–");
}

}  // namespace
}  // namespace slipcheck::testing
