// A cue in place of velocity and spin, the diameter in place of the radius, friction over the slip.

#include <cmath>

#include "scenes.h"

namespace slipcheck {
namespace {

using namespace testing;

/// kHard with its second ball struck.
std::string struck(const std::string& cue) {
  return with(kHard, "velocity: [-1, 0]", "cue: {" + cue + "}");
}

BodyState started(const std::string& cue) {
  return parse_scenario(struck(cue), "s.yaml").bodies[1].initial;
}

const double kMass = 7850 * 4.0 / 3 * M_PI * 1e-3;  // R = 0.1 m

TEST(Diameter, IsTwiceTheRadius) {
  EXPECT_EQ(parse_scenario(with(kHard, "radius: 0.1", "diameter: 20 cm"), "s.yaml")
                .bodies[0]
                .sphere.radius,
            0.1);
  expect_fault(with(kHard, "radius: 0.1", "radius: 0.1, diameter: 0.2"),
               "s.yaml:14:40: bodies[0].sphere: needs exactly one of radius or diameter");
  expect_fault(with(kHard, "radius: 0.1", "diameter: -1"),
               "s.yaml:14:51: bodies[0].sphere.diameter: must be > 0 m, got -1");
}

TEST(CueKeys, InTheCentreABallSlidesAlongTheHeading) {
  const BodyState state = started("impulse: 10, heading: 30");
  EXPECT_NEAR(state.velocity.x(), 10 / kMass * std::cos(M_PI / 6), 1e-15);
  EXPECT_NEAR(state.velocity.y(), 10 / kMass * std::sin(M_PI / 6), 1e-15);
  EXPECT_EQ(state.angular_velocity, Vector3::Zero());
}

TEST(CueKeys, BareOffsetsAreOfRadiiAndOthersLengths) {
  for (const char* offset : {"[0, 0.4]", "[0 mm, 4 cm]", "[0, 40 %]"}) {
    const BodyState state = started(std::string("impulse: 10, offset: ") + offset);
    EXPECT_NEAR(slip_velocity(state, 0.1).norm(), 0, 1e-15) << offset;  // 2/5 R: it rolls at once
  }
}

TEST(CueKeys, TheCuesSpeedAndMassGiveTheImpulse) {
  // J = (1 + e) V/(1/M + 1/m) in the centre.
  const Scenario scene =
      parse_scenario(struck("speed: 2, mass: 500 g, restitution: 0.7"), "s.yaml");
  EXPECT_NEAR(scene.bodies[1].stroke->impulse, 1.7 * 2 / (1 / 0.5 + 1 / kMass), 1e-13);
}

TEST(CueKeys, StandAloneAndWhole) {
  expect_fault(with(struck("impulse: 1"), "cue:", "velocity: [1, 0], cue:"),
               "s.yaml:15:5: bodies[1]: may have one of cue or velocity alone");
  expect_fault(with(struck("impulse: 1"), "cue:", "spin: rolling, cue:"),
               "s.yaml:15:5: bodies[1]: may have one of cue or spin alone");
  expect_fault(struck("speed: 1, impulse: 1"),
               "s.yaml:15:78: bodies[1].cue: needs exactly one of speed or impulse");
  expect_fault(struck("impulse: 1, mass: 1"),
               "s.yaml:15:78: bodies[1].cue: may have one of impulse or mass alone");
  expect_fault(struck("speed: 1"), "s.yaml:15:78: bodies[1].cue: needs the key mass with speed");
}

TEST(CueKeys, ATipThatSlipsOffIsRefused) {
  expect_fault(struck("impulse: 1, offset: [0.4, 0.4]"),
               "s.yaml:15:99: bodies[1].cue.offset: must be at most 0.5145 R from the centre, here "
               "0.5657 R: beyond that a tip of friction 0.6 slips off the ball, got [0.4, 0.4]");
  EXPECT_NO_THROW(started("impulse: 1, offset: [0.4, 0.4], tip_friction: 0.8"));
}

std::string rubbed(const std::string& friction) {
  return with(kHard, "friction: 0.1", "friction: " + friction);
}

double friction_of(const std::string& text, double slip) {
  const Scenario scene = parse_scenario(text, "s.yaml");
  return friction_at(std::get<HardTangential>(scene.contacts[0].tangential).friction, slip);
}

TEST(FrictionKeys, ALawOrATableOverTheSlip) {
  EXPECT_NEAR(friction_of(rubbed("{a: 0.01, b: 0.1, c: 2}"), 0.5), 0.01 + 0.1 * std::exp(-1),
              1e-16);
  EXPECT_NEAR(friction_of(rubbed("{a: 0.01, b: 0.1, c: 0.02 s/cm}"), 0.5),
              0.01 + 0.1 * std::exp(-1), 1e-15);
  EXPECT_NEAR(friction_of(rubbed("[[0, 0.2], [1, 0.1]]"), 0.5), 0.15, 1e-16);
}

TEST(FrictionKeys, ItsFaults) {
  expect_fault(rubbed("{a: 0.01, b: 0.1}"),
               "s.yaml:9:41: contacts[0].tangential.friction: needs the key c");
  expect_fault(rubbed("[[1, 0.2], [1, 0.1]]"),
               "s.yaml:9:53: contacts[0].tangential.friction[1][0]: must be more than the speed "
               "before it, got 1");
  expect_fault(with(rubbed("[[0, 0.2], [1, 0.1]]"), "{model: hard, restitution: 0.9}",
                    "{model: linear, restitution: 0.9, collision_time: 1e-3}"),
               "s.yaml:9:41: contacts[0].tangential.friction: must be a number unless the normal "
               "model is hard");
}

}  // namespace
}  // namespace slipcheck
