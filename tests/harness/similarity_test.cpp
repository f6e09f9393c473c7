#include "scene/similarity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "../support/bundled.h"
#include "harness/run/prepared_scene.h"
#include "scenario/load.h"
#include "scenario/observable_key.h"
#include "scenario/scaled_lengths.h"

// A turned scene has the turned result, a scaled one the scaled result: what is computed once holds
// for all headings and scales.

namespace slipcheck {
namespace {

using test::bundled;

ReferenceResult reference_of(const Scenario& scenario) {
  return prepare_scenes({scenario}).front().reference;
}

double value(const ReferenceResult& reference, const std::string& name) {
  return reference.observables.at(name).value;
}

/// What the scaled scene's reference should show, by the dimension of each observable that these
/// scenes have; every one is compared.
void expect_similar(const Scenario& scenario, double lambda, double tolerance) {
  const ReferenceResult before = reference_of(scenario);
  const ReferenceResult after = reference_of(scaled_lengths(scenario, lambda));
  const double time = std::sqrt(lambda);
  ASSERT_EQ(before.observables.size(), after.observables.size());
  std::size_t compared = 0;
  const auto expect = [&](const std::string& name, double factor) {
    for (const auto& [full, seen] : before.observables) {
      if (observable_key(full).observable != name) continue;
      ++compared;
      const double scaled = seen.value * factor;
      // What is zero but for rounding is so on the scale of what happens.
      EXPECT_NEAR(value(after, std::string(full)), scaled,
                  tolerance * std::max(std::abs(scaled), factor))
          << full << " at " << lambda;
    }
  };
  for (const char* name : {"restitution", "tangential_restitution", "effective_restitution"})
    expect(name, 1);
  for (const char* name : {"sliding_time", "stopping_time", "spin_stopping_time", "contact_time",
                           "flight_time", "sliding_onset"})
    expect(name, time);
  for (const char* name : {"sliding_distance", "stopping_distance", "final_position", "jump_height",
                           "max_overlap", "energy_change_sliding"})
    expect(name, lambda);
  for (const char* name : {"velocity_after_collision", "slip_after_collision", "rolling_velocity",
                           "final_velocity", "lift_off_speed", "momentum_change_sliding"})
    expect(name, lambda / time);
  for (const char* name : {"angular_velocity_after_collision", "final_angular_velocity"})
    expect(name, 1 / time);
  EXPECT_EQ(compared, before.observables.size()) << scenario.name;
}

TEST(ScaledLengths, ScaledScenesAreSimilarInTheReference) {
  // Exact phases: rounding alone, and what it moves a root by.
  for (const char* name :
       {"symmetric-30cms", "rolling-friction-table", "bouncing-ball", "oblique", "spin-to-rest",
        "bounce-on-belt", "restitution-over-height", "heading-ring", "ice-bridges", "belt-starts",
        "marble-run", "three-cushion-shot"})
    for (const double lambda : {1e-6, 7.3, 1e3}) expect_similar(bundled(name), lambda, 1e-9);
}

TEST(ScaledLengths, ScaledForcesAreSimilarInTheReference) {
  // Integrated at a relative tolerance of 1e-13 in metres; the worst scene asks for ten digits.
  for (const char* name : {"jump-resolved", "power-law", "ice-viscoelastic", "asperities-passive"})
    expect_similar(bundled(name), 3.7, 1e-7);
}

TEST(ScaledLengths, WhatHasAUnitScalesToo) {
  Scenario scenario = bundled("symmetric-30cms");
  scenario.compare.tolerance["sliding_time"] = {0.002, true};
  scenario.compare.tolerance["sliding_distance"] = {0.003, true};
  scenario.compare.tolerance["effective_restitution"] = {0.004, false};
  scenario.compare.engines[0].expect.emplace();
  const Scenario scaled = scaled_lengths(scenario, 4);
  EXPECT_DOUBLE_EQ(scaled.compare.tolerance.at("sliding_time").value, 0.004);
  EXPECT_DOUBLE_EQ(scaled.compare.tolerance.at("sliding_distance").value, 0.012);
  EXPECT_DOUBLE_EQ(scaled.compare.tolerance.at("effective_restitution").value, 0.004);
  EXPECT_DOUBLE_EQ(scaled.run.limit, 10);
  EXPECT_DOUBLE_EQ(scaled.compare.engines[0].rates.at(1), 120);
  EXPECT_FALSE(scaled.compare.engines[0].expect);
  EXPECT_DOUBLE_EQ(scaled.gravity.z(), scenario.gravity.z());
  EXPECT_DOUBLE_EQ(scaled.bodies[0].sphere.mass, 64 * scenario.bodies[0].sphere.mass);
}

// --- headings ------------------------------------------------------------------------------------

TEST(Similarity, EvenHeadingsHaveExactQuarters) {
  EXPECT_EQ(even_heading(0, 1), Vector2(1, 0));
  EXPECT_EQ(even_heading(2, 8), Vector2(0, 1));
  EXPECT_EQ(even_heading(4, 8), Vector2(-1, 0));
  EXPECT_EQ(even_heading(6, 8), Vector2(0, -1));
  for (std::size_t k = 0; k < 12; ++k) {
    const Vector2 heading = even_heading(k, 12);
    EXPECT_NEAR(heading.x(), std::cos(M_PI * static_cast<double>(k) / 6), 1e-15);
    EXPECT_NEAR(heading.y(), std::sin(M_PI * static_cast<double>(k) / 6), 1e-15);
  }
}

TEST(Similarity, FramesComeBackAsTheyWent) {
  // At λ = 4, turned by 90°: lengths times 4, speeds times 2, spins over 2, impulses times 4³·2.
  const Similarity similarity{4, even_heading(1, 4)};
  const BodyState state{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  const BodyState there = similarity.of(state);
  EXPECT_EQ(there.position, Vector3(-8, 4, 12));
  EXPECT_EQ(there.velocity, Vector3(-10, 8, 12));
  EXPECT_EQ(there.angular_velocity, Vector3(-4, 3.5, 4.5));
  Frame frame;
  frame.bodies = {there};
  frame.touches = {{0, kSubstrate, 128}};
  similarity.take_back(frame);
  EXPECT_EQ(frame.bodies[0].position, state.position);
  EXPECT_EQ(frame.bodies[0].velocity, state.velocity);
  EXPECT_EQ(frame.bodies[0].angular_velocity, state.angular_velocity);
  EXPECT_EQ(frame.touches[0].normal_impulse, 1);
}

/// The observables of the scene turned to this heading, vectors turned back.
std::map<std::string, double> turned_back(const PreparedScene& scene, const Vector2& heading) {
  ContactScene contacts = *scene.contact;
  contacts.hard = turned(contacts.hard, heading);
  const ReferenceSolver solver(contacts, reference_settings(scene.scenario));
  const ReferenceResult result =
      run_reference(solver, run_end(scene.scenario), body_names(scene.scenario));
  std::map<std::string, double> values;
  for (const auto& [text, seen] : result.observables) {
    const ObservableKey key = observable_key(text);
    const auto [x, y, z] = key.components();
    const std::string name(text);
    if (key.component == 'x')
      values[name] = heading.x() * value(result, x) + heading.y() * value(result, y);
    else if (key.component == 'y')
      values[name] = heading.x() * value(result, y) - heading.y() * value(result, x);
    else
      values[name] = seen.value;
  }
  return values;
}

TEST(Similarity, TheReferenceKnowsNoDirection) {
  // Rounding of places, speeds and times, and of a time what it moves a root by.
  for (const char* name :
       {"oblique", "roll-to-rest", "slope-slides-across", "belt-starts", "shaker-slips",
        "bounce-on-belt", "spin-before-oblique-hit", "friction-in-collision", "heading-ring",
        "marble-run", "three-cushion-shot"}) {
    const PreparedScene scene = std::move(prepare_scenes({bundled(name)}).front());
    for (const std::size_t k : {1u, 2u, 5u}) {
      const auto seen = turned_back(scene, even_heading(k, 8));
      ASSERT_EQ(seen.size(), scene.reference.observables.size()) << name;
      for (const auto& [observable, expected] : scene.reference.observables) {
        const double scale = std::max(std::abs(expected.value), 1.0);
        EXPECT_NEAR(seen.at(std::string(observable)), expected.value, 1e-8 * scale)
            << name << ": " << observable << " in heading " << k;
      }
    }
  }
}

}  // namespace
}  // namespace slipcheck
