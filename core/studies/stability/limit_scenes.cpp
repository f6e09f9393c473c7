#include "studies/stability/limit_scenes.h"

#include <fmt/format.h>

#include <string>

#include "scenario/load.h"

namespace slipcheck {
namespace {

/// A scene of two steel balls on the x axis; positions and velocities in mm and cm/s.
struct PairText {
  const char* name;
  const char* title;
  const char* normal = "{model: hard, restitution: 0.9}";
  double x = 9.5;           ///< of the second ball; the first is at −x
  double v_i = 0, v_j = 0;  ///< of the first and the second
  const char* friction = "{static: 0.5, kinetic: 0.1}";
  const char* spin = "rolling";
  const char* run = "{until: rolling, limit: 0.5}";
  const char* tolerance;
};

// The limits of the runs leave several times what the reference needs, and no more, as runs that
// never end cost all of it.
Scenario pair_of(const PairText& text) {
  const std::string yaml = fmt::format(
      R"(slipcheck: 1
name: {}
title: {}
source: Kondic 1999, Sec. IV
gravity: 9.81
materials: {{steel: {{density: 7850}}}}
contacts:
  - {{between: [steel, steel], normal: {}, tangential: {{model: none}}}}
  - {{between: [steel, substrate], friction: {}}}
substrate: {{}}
bodies:
  - {{name: i, material: steel, sphere: {{radius: 2 mm}}, position: [{} mm, 0], velocity: [{} cm/s, 0], spin: {}}}
  - {{name: j, material: steel, sphere: {{radius: 2 mm}}, position: [{} mm, 0], velocity: [{} cm/s, 0], spin: {}}}
run: {}
compare: {{tolerance: {}}}
)",
      text.name, text.title, text.normal, text.friction, -text.x, text.v_i, text.spin, text.x,
      text.v_j, text.spin, text.run, text.tolerance);
  return parse_scenario(yaml, text.name);
}

// Sliding times are left out: the heavier body's goes to zero.
constexpr const char* kRestitutions = "{restitution: 0.01, effective_restitution: 0.01}";

}  // namespace

Scenario limit_pair() {
  return pair_of({.name = "pair",
                  .title = "Two rolling balls meet",
                  .v_i = 15,
                  .v_j = -15,
                  .tolerance = "{restitution: 0.01, effective_restitution: 0.01, "
                               "sliding_time: 1 %, rolling_velocity: 1 %}"});
}

Scenario limit_collision() {
  return pair_of({.name = "collision",
                  .title = "Two balls meet on a smooth floor",
                  .v_i = 15,
                  .v_j = -15,
                  .friction = "0",
                  .spin = "none",
                  .run = "{until: 0.1, limit: 1}",
                  .tolerance = "{restitution: 0.01}"});
}

Scenario limit_strikes_heavier() {
  return pair_of({.name = "strikes-heavier",
                  .title = "A rolling ball strikes a heavier one at rest",
                  .v_i = 30,
                  .tolerance = kRestitutions});
}

Scenario limit_struck_by_heavier() {
  return pair_of({.name = "struck-by-heavier",
                  .title = "A ball at rest is struck by a heavier one",
                  .v_j = -30,
                  .tolerance = kRestitutions});
}

Scenario limit_bounce() {
  return parse_scenario(R"(slipcheck: 1
name: bounce
title: A ball falls and bounces
source: free fall, v' = -e v
gravity: 9.81
materials: {steel: {density: 7850}}
contacts:
  - {between: [steel, substrate], friction: 0.3, restitution: 0.8}
substrate: {}
bodies:
  - {name: ball, material: steel, sphere: {radius: 1 cm}, position: [0, 0, 0.06], velocity: [0, 0, 0], spin: none}
run: {until: 0.25, limit: 1}
compare: {tolerance: {restitution: 0.01, lift_off_speed: 1 %, jump_height: 2 %}}
)",
                        "bounce");
}

Scenario limit_roll() {
  return parse_scenario(R"(slipcheck: 1
name: roll
title: A ball rolls to rest
source: Kondic 1999, (16)
gravity: 9.81
materials: {steel: {density: 7850}}
contacts:
  - {between: [steel, substrate], friction: 0.3, rolling: 0.02}
substrate: {}
bodies:
  - {name: ball, material: steel, sphere: {radius: 1 cm}, position: [0, 0], velocity: [0.5, 0], spin: rolling}
run: {until: rest, limit: 3}
compare: {tolerance: {stopping_time: 1 %, stopping_distance: 1 %}}
)",
                        "roll");
}

Scenario limit_soft_pair() {
  return pair_of({.name = "soft-pair",
                  .title = "Two rolling balls meet in a contact that lasts",
                  .normal = "{model: linear, restitution: 0.9, stiffness: 1e6}",
                  .x = 2.075,
                  .v_i = 15,
                  .v_j = -15,
                  .run = "{until: 1.6 ms, limit: 1}",
                  .tolerance = "{restitution: 0.01, contact_time: 1 %}"});
}

}  // namespace slipcheck
