#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "../support/refusal.h"
#include "scenario/load.h"

namespace slipcheck::testing {

/// The scene of docs/scenario-format.md.
inline const std::string kExample = R"(slipcheck: 1
name: symmetric-steel
title: Two rolling steel spheres collide head-on
source: Kondic 1999, Sec. IV A     # optional
units: cgs
gravity: 981                       # along -z

materials:
  steel: {density: 7.85, young_modulus: 2.06e12, poisson_ratio: 0.28}

contacts:
  - between: [steel, steel]
    normal: {model: linear, restitution: 0.9, collision_time: 2.55e-5, ends_at: zero_overlap}
    tangential: {model: viscous, damping_ratio: 0.5, friction: 0.5}
  - between: [steel, substrate]
    friction: {static: 0.5, kinetic: 0.1}
    rolling: 0.001
    drilling: {model: uncoupled, contact_radius: 0.002}
    restitution: 0

substrate:
  # periodic: [2, 2]
  tilt: 5
  confined: false
  motion: {kind: oscillate, amplitude: [0.1, 0], frequency: 5, phase: 90}

bodies:
  - {name: i, material: steel, sphere: {radius: 0.2}, position: [ 0.3, 0], velocity: [-5, 0], spin: rolling}
  - {name: j, material: steel, sphere: {radius: 0.2}, position: [-0.3, 0], velocity: [ 5, 0], spin: rolling}

run:
  until: rolling
  limit: 1.0

compare:
  reference: auto
  engines:
    - {engine: bullet, precision: double, profile: default, rate: [60, 240, 1000]}
    - {engine: bullet, precision: single, profile: tuned, rate: 240}
  tolerance: {sliding_time: 1 %, sliding_distance: 1 %, effective_restitution: 0.005}
)";

/// Two hard spheres on a level plane, in SI; short keys on lines of their own.
inline const std::string kHard = R"(slipcheck: 1
name: hard
title: Two hard spheres
materials:
  steel: {density: 7850}
contacts:
  - between: [steel, steel]
    normal: {model: hard, restitution: 0.9}
    tangential: {model: hard, friction: 0.1, tangential_restitution: 0.5}
  - between: [steel, substrate]
    friction: 0.2
substrate: {}
bodies:
  - {name: a, material: steel, sphere: {radius: 0.1}, position: [0, 0]}
  - {name: b, material: steel, sphere: {radius: 0.1}, position: [1, 0], velocity: [-1, 0]}
run: {until: rolling}
)";

/// L's vibrated box.
inline const std::string kContainer = R"(slipcheck: 1
name: box
title: Vibrated box
materials:
  steel: {density: 7850}
contacts:
  - {between: [steel, steel], normal: {model: hard, restitution: 0.9}}
  - {between: [steel, floor], normal: {model: hard, restitution: 0.9}}
  - {between: [steel, wall], normal: {model: hard, restitution: 0.9}}
container: {width: "10 mm", floor: {amplitude: "0.5 mm", frequency: 100}, walls: fixed}
bodies:
  - {name: a, material: steel, sphere: {radius: "0.5 mm"}, position: ["2 mm", "3 mm"], spin: 2}
  - {name: b, material: steel, sphere: {radius: "0.5 mm"}, position: ["5 mm", "3 mm"], velocity: [0.1, 0.2]}
run: {periods: 2000, discard: 500, sample: phase_zero}
)";

/// The text with the first occurrence of `from` replaced; the test fails if there is none.
inline std::string with(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  if (at != std::string::npos) text.replace(at, from.size(), to);
  return text;
}

inline const std::vector<std::string> kNoFaults;

/// The messages of all faults, as the file "s.yaml"; none if the text is a scene.
inline std::vector<std::string> messages(std::string_view text) {
  std::vector<std::string> result;
  for (const Fault& fault : test::faults_of([&] { parse_scenario(text, "s.yaml"); }))
    result.push_back(fault.message());
  return result;
}

/// Expects one fault, of this message.
inline void expect_fault(std::string_view text, const std::string& message) {
  EXPECT_EQ(messages(text), std::vector<std::string>{message});
}

}  // namespace slipcheck::testing
