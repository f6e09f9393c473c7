#include "scenario/units.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>

#include "../support/refusal.h"

namespace slipcheck {
namespace {

double si(std::string_view text, const Dimension& dimension) {
  const Quantity quantity = parse_quantity(text, dimension);
  EXPECT_TRUE(quantity.has_unit) << text;
  return quantity.value;
}

std::string refusal(std::string_view text, const Dimension& dimension) {
  return test::refusal_of<BadQuantity>([&] { parse_quantity(text, dimension); });
}

TEST(Units, ReadsUnits) {
  EXPECT_EQ(si("2 mm", kLength), 0.002);  // the very double, as 2/1000 is rounded once
  EXPECT_EQ(si("2mm", kLength), 0.002);
  EXPECT_EQ(si("7 um", kLength), 7e-6);
  EXPECT_EQ(si("7 µm", kLength), 7e-6);
  EXPECT_EQ(si("10 cm/s", kVelocity), 0.1);
  EXPECT_EQ(si("1 %", kPureNumber), 0.01);
  EXPECT_EQ(si("5 Hz", kFrequency), 5);
  EXPECT_EQ(si("2 kHz", kFrequency), 2000);
  EXPECT_EQ(si("0.1 rad", kAngle), 0.1);
  EXPECT_DOUBLE_EQ(si("5 deg", kAngle), 5 * std::numbers::pi / 180);
  EXPECT_DOUBLE_EQ(si("60 rpm", kAngularVelocity), 2 * std::numbers::pi);
  EXPECT_EQ(si("50 rad/s", kAngularVelocity), 50);
  EXPECT_EQ(si("50 1/s", kAngularVelocity), 50);
  EXPECT_EQ(si("50 s-1", kRate), 50);
  EXPECT_EQ(si("50 /s", kRate), 50);
  EXPECT_DOUBLE_EQ(si("206 GPa", kPressure), 206e9);
  EXPECT_DOUBLE_EQ(si("7.85 g/cm3", kDensity), 7850);
  EXPECT_DOUBLE_EQ(si("1 dyn/cm", kStiffness), 1e-3);
  constexpr Dimension kDamping{"damping", 1, 0, -1, 0, "kg/s", "g/s", "1 kg/s"};
  EXPECT_DOUBLE_EQ(si("1.2e-3 dyn s/cm", kDamping), 1.2e-6);
}

TEST(Units, ReadsBrokenPowers) {
  EXPECT_DOUBLE_EQ(si("1 cm^-0.5", kPerRootLength), 10);
  constexpr Dimension kModulus{"modulus", 1, -0.5, -2, 0, "", "", "1 N/m^1.5"};
  EXPECT_DOUBLE_EQ(si("3 N/m^1.5", kModulus), 3);
  EXPECT_DOUBLE_EQ(si("3 dyn / cm^1.5", kModulus), 3e-2);
  EXPECT_EQ(refusal("3 N/m^1.4", kModulus), "must be a modulus, as in \"1 N/m^1.5\"");
  EXPECT_NE(refusal("3 N/m^1.5/", kModulus), "");
  EXPECT_NE(refusal("3 N/^1.5", kModulus), "");
}

TEST(Units, LeavesBareNumbersToTheFile) {
  const Quantity quantity = parse_quantity("-1.5e3", kLength);
  EXPECT_FALSE(quantity.has_unit);
  EXPECT_EQ(quantity.value, -1500);
  EXPECT_EQ(to_si(2, kLength, UnitSystem::si), 2);
  EXPECT_EQ(to_si(0.2, kLength, UnitSystem::cgs), 0.002);
  EXPECT_EQ(to_si(5, kFrequency, UnitSystem::cgs), 5);
  EXPECT_DOUBLE_EQ(to_si(90, kAngle, UnitSystem::cgs), std::numbers::pi / 2);
  EXPECT_EQ(to_si(3, kAngularVelocity, UnitSystem::cgs), 3);
}

TEST(Units, RefusesTheWrongDimension) {
  EXPECT_EQ(refusal("5 s", kLength), "must be a length, as in \"2 mm\"");
  EXPECT_EQ(refusal("31 rad/s", kFrequency), "must be a frequency, as in \"5 Hz\"");
  EXPECT_EQ(refusal("60 rpm", kFrequency), "must be a frequency, as in \"5 Hz\"");
  EXPECT_EQ(refusal("5 deg", kPureNumber), "must be a number, as in \"1 %\"");
  EXPECT_EQ(refusal("0.1 rad", kPureNumber), "must be a number, as in \"1 %\"");
  EXPECT_EQ(refusal("31 Hz", kAngularVelocity), "must be an angular velocity, as in \"50 rad/s\"");
  EXPECT_EQ(refusal("1 %", kAngle), "must be an angle, as in \"0.1 rad\"");
  EXPECT_EQ(refusal("5 K", kLength), "must be in units of mass, length, time and angle");
}

TEST(Units, RefusesWhatIsNoMultiple) {
  EXPECT_EQ(refusal("5 degC", kLength), "must have a unit without an offset");
  EXPECT_EQ(refusal("5 lg(re 1 m)", kLength), "must not have a logarithmic unit");
  EXPECT_EQ(refusal("5 seconds since 2000-01-01", kTime), "must not be a date");
  EXPECT_EQ(refusal("5 furlongz", kLength),
            "must be a length, as in \"2 mm\"; the unit \"furlongz\" is not known");
  EXPECT_NE(refusal("5 3 m", kLength), "");
  EXPECT_NE(refusal("0x10", kLength), "");
  EXPECT_NE(refusal("1,5 m", kLength), "");
  EXPECT_NE(refusal("1 000 m", kLength), "");
}

TEST(Units, ALineBreakIsInNoneAndIsNotPrinted) {
  ::testing::internal::CaptureStdout();
  EXPECT_NE(refusal("2 m\n", kLength), "");
  EXPECT_NE(refusal("2 m\ns^-1", kVelocity), "");
  EXPECT_NE(refusal("2 \n\n", kLength), "");
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
}

TEST(UnitsDeathTest, AMissingDataBaseIsAFault) {
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";  // a process that has not loaded it yet
  EXPECT_EXIT(
      {
        setenv("UDUNITS2_XML_PATH", "/nonexistent", 1);
        const bool bare = !parse_quantity("2", kLength).has_unit;  // needs no data base
        std::fprintf(stderr, "%d %s", bare, refusal("2 mm", kLength).c_str());
        std::exit(0);
      },
      ::testing::ExitedWithCode(0), "1 needs the UDUNITS-2 data base to read a unit");
}

TEST(Numbers, AreDecimalFiniteAndWhole) {
  EXPECT_EQ(parse_number("+.5e1"), 5);
  EXPECT_EQ(parse_number("5."), 5);
  for (const char* text : {"", " ", "x", "1x", "0x10", "--1", "+-1", "1 ", " 1", "1_000", ".inf"}) {
    EXPECT_THROW(parse_number(text), BadQuantity) << text;
  }
  for (const char* text : {"nan", "inf", "-inf", "infinity"}) {
    EXPECT_EQ(test::refusal_of<BadQuantity>([&] { parse_number(text); }),
              "must be a finite number");
  }
  EXPECT_THROW(parse_number("1e999"), BadQuantity);
}

}  // namespace
}  // namespace slipcheck
