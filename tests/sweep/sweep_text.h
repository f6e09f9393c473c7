#pragma once

#include <string>

namespace slipcheck::test {

/// A scene of two bodies, and a block of a sweep below it.
inline std::string with_sweep(const std::string& block, const std::string& engines = "[]") {
  return R"(slipcheck: 1
name: two
title: Two balls meet
units: cgs
gravity: 981
materials:
  steel: {density: 7.85}
contacts:
  - between: [steel, steel]
    normal: {model: hard, restitution: 0.9}
    tangential: {model: none}
  - between: [steel, substrate]
    friction: {static: 0.5, kinetic: 0.1}
substrate: {}
bodies:
  - {name: i, material: steel, sphere: {radius: 0.2}, position: [-0.95, 0], velocity: [15, 0], spin: rolling}
  - {name: j, material: steel, sphere: {radius: 0.2}, position: [0.95, 0], velocity: [-15, 0], spin: rolling}
run: {until: rolling, limit: 5}
compare:
  engines: )" +
         engines + "\n  tolerance: {sliding_time: 1 %}\nsweep:\n" + block;
}

}  // namespace slipcheck::test
