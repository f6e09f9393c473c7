#include "scenario/observable_key.h"

#include <gtest/gtest.h>

#include <ostream>

namespace slipcheck {
namespace {

struct Parts {
  std::string_view text, owner, observable;
  char component = '\0';
  bool is_known = true;
};
void PrintTo(const Parts& parts, std::ostream* out) { *out << parts.text; }

class ObservableKeys : public ::testing::TestWithParam<Parts> {};

TEST_P(ObservableKeys, AreTakenApartAndPutTogether) {
  const Parts& expected = GetParam();
  const ObservableKey key = observable_key(expected.text);
  EXPECT_EQ(key.owner, expected.owner);
  EXPECT_EQ(key.observable, expected.observable);
  EXPECT_EQ(key.component, expected.component);
  EXPECT_EQ(key.known() != nullptr, expected.is_known);
  EXPECT_EQ(key.text(), expected.text);
}

INSTANTIATE_TEST_SUITE_P(
    All, ObservableKeys,
    ::testing::Values(Parts{"i.sliding_time", "i", "sliding_time"},
                      Parts{"i.final_velocity", "i", "final_velocity"},
                      Parts{"i.final_velocity.x", "i", "final_velocity", 'x'},
                      Parts{"i-j.restitution", "i-j", "restitution"},
                      Parts{"ball-1-substrate.contact_time", "ball-1-substrate", "contact_time"},
                      Parts{"all.energy_drift", "all", "energy_drift"},
                      Parts{"b*.final_position.z", "b*", "final_position", 'z'},
                      // Of nobody.
                      Parts{"restitution", "", "restitution"},
                      Parts{"final_velocity.y", "", "final_velocity", 'y'},
                      // Bodies may be called as observables and components are.
                      Parts{"final_velocity.sliding_time", "final_velocity", "sliding_time"},
                      Parts{"final_velocity.final_velocity.y", "final_velocity", "final_velocity",
                            'y'},
                      Parts{"x.final_velocity.x", "x", "final_velocity", 'x'},
                      // What there is not.
                      Parts{"", "", "", '\0', false}, Parts{".", "", ".", '\0', false},
                      Parts{".restitution", "", ".restitution", '\0', false},
                      Parts{"i.", "i", "", '\0', false}, Parts{".x", "", ".x", '\0', false},
                      Parts{"trajectory", "", "trajectory", '\0', false},
                      Parts{"i.final_velocity.w", "i", "final_velocity.w", '\0', false},
                      Parts{"i.final_velocity.", "i", "final_velocity.", '\0', false},
                      Parts{"i.sliding_time.x", "i", "sliding_time.x", '\0', false},
                      Parts{"a.b.sliding_time", "a", "b.sliding_time", '\0', false}));

TEST(ObservableKeyTexts, NameTheirVectorsComponents) {
  const std::array<std::string, 3> all = {"i.final_velocity.x", "i.final_velocity.y",
                                          "i.final_velocity.z"};
  EXPECT_EQ(observable_key("i.final_velocity").components(), all);
  EXPECT_EQ(observable_key("i.final_velocity.z").components(), all);
  EXPECT_EQ(observable_key("i.final_velocity.z").whole().text(), "i.final_velocity");
}

TEST(ObservableKeyTexts, AreGivenAndLoseTheirOwners) {
  EXPECT_EQ(observable_key("i.final_velocity.z").bare(), "final_velocity.z");
  EXPECT_EQ(observable_key("final_velocity.z").of("j").text(), "j.final_velocity.z");
  EXPECT_EQ((ObservableKey{pair_owner("i", "substrate"), "restitution"}).text(),
            "i-substrate.restitution");
}

}  // namespace
}  // namespace slipcheck
