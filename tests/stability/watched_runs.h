#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "scenario/load.h"
#include "studies/stability/outcome_watch.h"

namespace slipcheck::test {

/// g = 10 m/s²; bodies as the YAML list says, of 1 kg and R = 1 cm unless they say otherwise.
inline std::string plain_scene(const std::string& bodies, const std::string& on_substrate,
                               const std::string& run, const std::string& compare = "",
                               const std::string& substrate = "{}",
                               const std::string& pair = "{model: hard, restitution: 0.9}") {
  return fmt::format(R"(slipcheck: 1
name: plain
title: Plain
gravity: 10
materials: {{ball: {{}}}}
contacts:
  - {{between: [ball, ball], normal: {}}}
  - {{between: [ball, substrate], {}}}
substrate: {}
bodies:
{}
run: {}
compare: {{{}}}
)",
                     pair, on_substrate, substrate, bodies, run, compare);
}

inline std::string ball(const std::string& name, const std::string& position,
                        const std::string& velocity, double radius = 0.01) {
  return fmt::format(
      "  - {{name: {}, material: ball, sphere: {{radius: {}}}, mass: 1, position: {}, velocity: "
      "{}, spin: none}}\n",
      name, radius, position, velocity);
}

inline PreparedScene prepared(const std::string& text) {
  std::vector<PreparedScene> scenes = prepare_scenes({parse_scenario(text, "scene.yaml")});
  return std::move(scenes.front());
}

/// One ball that falls from 1 m over the plane, which it reaches after √0.2 s.
inline PreparedScene falling(double restitution, double until = 0.4) {
  return prepared(plain_scene(ball("a", "[0, 0, 1.01]", "[0, 0, 0]"),
                              fmt::format("friction: 0, restitution: {}", restitution),
                              fmt::format("{{until: {}}}", until)));
}

/// Two that slide without friction and meet at 2 m/s after 0.04 s.
inline PreparedScene meeting(const std::string& normal = "{model: hard, restitution: 0.9}",
                             double small = 0.01) {
  return prepared(
      plain_scene(ball("a", "[-0.05, 0]", "[1, 0, 0]") +
                      ball("b", fmt::format("[{}, 0]", 0.04 + small), "[-1, 0, 0]", small),
                  "friction: 0", "{until: 0.1}", "", "{}", normal));
}

inline Outcome outcome_of(const OutcomeWatch& watch) {
  return watch.phases().back().outcome.outcome;
}

inline Frame frame_of(std::vector<BodyState> bodies, std::vector<Touch> touches = {}) {
  Frame frame;
  frame.bodies = std::move(bodies);
  frame.touches = std::move(touches);
  return frame;
}

/// The pair after a collision in which its energy changes by this fraction.
inline OutcomeWatch parted(const ReferencePath& path, double gain, int first_frame = 1) {
  const double h = 0.005;
  OutcomeWatch watch(path, {}, h);
  std::vector<BodyState> s = path.states().front();
  watch.begin(0, s);
  for (int n = first_frame; n <= 20; ++n) {
    const double t = n * h, away = std::sqrt(1 + gain);
    s[0].position.x() = t < 0.04 ? -0.05 + t : -0.01 - away * (t - 0.04);
    s[1].position.x() = -s[0].position.x();
    s[0].velocity.x() = t < 0.04 ? 1 : -away;
    s[1].velocity.x() = -s[0].velocity.x();
    watch.take(t, frame_of(s));
  }
  return watch;
}

/// What the reference shows at this rate [Hz], as an engine without errors would.
inline WatchedPhase reference_watched(const ReferencePath& path, double rate, bool soft) {
  std::vector<double> times;
  for (int k = 1; k <= static_cast<int>(path.end() * rate); ++k) times.push_back(k / rate);
  const auto states = path.prepared().solver.states_along(times);
  const auto& bodies = path.scene().hard.bodies;
  OutcomeWatch watch(path, {}, 1 / rate, soft);
  watch.begin(0, path.states().front());
  for (std::size_t k = 0; k < states.size(); ++k) {
    Frame frame = frame_of(states[k]);
    for (std::size_t j = 0; j < bodies.size(); ++j)
      for (std::size_t i = 0; i < j; ++i)
        if ((states[k][j].position - states[k][i].position).norm() <
            bodies[i].radius + bodies[j].radius)
          frame.touches.push_back({static_cast<int>(i), static_cast<int>(j), 1});
    watch.take(times[k], frame);
  }
  return watch.phases().front();
}

}  // namespace slipcheck::test
