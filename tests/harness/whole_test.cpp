#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "../support/bundled.h"
#include "../support/refusal.h"
#include "base/stop_scope.h"
#include "harness/compare/assembly_comparison.h"
#include "harness/observe/energy_budget.h"
#include "harness/run/prepared_scene.h"

namespace slipcheck {
namespace {

/// `samples` looks at times from 0 to `end`, with the height h(t) and nothing else.
template <class Height>
Assembly assembly_of(std::size_t samples, double end, const Height& height) {
  Assembly assembly;
  for (std::size_t k = 0; k < samples; ++k) {
    assembly.time.push_back(end * static_cast<double>(k) / static_cast<double>(samples - 1));
    assembly.states.emplace_back().height = height(assembly.time.back());
  }
  return assembly;
}

AssemblyDifference height_of(const std::vector<AssemblyDifference>& all) {
  for (const AssemblyDifference& each : all)
    if (each.quantity->name == std::string("height")) return each;
  ADD_FAILURE() << "no height";
  return {};
}

/// Over the second half of t from 0 to 2 the mean of t is 1.5; what is added throughout is the
/// difference, and has no scatter but that of rounding, however both of them rise.
TEST(AssemblyComparison, ComparesAtTheSameTimes) {
  const Assembly reference = assembly_of(401, 2, [](double t) { return t; });
  const Assembly engine = assembly_of(201, 2, [](double t) { return t + 0.25; });
  const AssemblyDifference height = height_of(assembly_differences(reference, engine));
  EXPECT_NEAR(height.reference.value, 1.5, 1e-12);
  EXPECT_NEAR(height.engine.value, 1.75, 1e-12);
  EXPECT_NEAR(height.difference.value, 0.25, 1e-12);
  EXPECT_LT(height.difference.error, 1e-12);
  EXPECT_GT(height.engine.error, 0.01);
}

TEST(AssemblyComparison, KnowsWhatItCannotCompare) {
  const auto flat = [](double) { return 1.0; };
  const Assembly engine = assembly_of(21, 2, flat);
  EXPECT_TRUE(assembly_differences({}, engine).empty());
  EXPECT_TRUE(assembly_differences(assembly_of(21, 0.5, flat), engine).empty());  // it ended early
  // Eleven samples tell no error.
  EXPECT_TRUE(std::isnan(height_of(assembly_differences(engine, engine)).difference.error));
}

/// Energy turns from one kind into another, and 1 J of 10 J comes from nowhere.
TEST(EnergyBudget, FindsWhatRises) {
  Assembly assembly;
  const auto add = [&](double kinetic, double weight) {
    AssemblyState& state = assembly.states.emplace_back();
    state.kinetic_energy = kinetic;
    state.weight_energy = weight;
    assembly.time.push_back(static_cast<double>(assembly.time.size()));
  };
  add(0, 10), add(9, 1), add(4, 4), add(5, 4), add(2, 2);
  const EnergyBudget budget = energy_budget(assembly);
  EXPECT_EQ(budget.first, 10);
  EXPECT_EQ(budget.last, 4);
  EXPECT_EQ(budget.rise, 1);
  EXPECT_EQ(budget.scale, 9 + 9);
}

// --- the reference -------------------------------------------------------------------------------

ReferenceResult sampled(const std::string& name, const ReferenceExtras& extras) {
  const std::map<std::string, ReferenceExtras> wanted = {{name, extras}};
  Scenario scenario = test::bundled(name);
  scenario.run.time = 0.01;
  std::vector<PreparedScene> scenes =
      prepare_scenes({std::move(scenario)}, false, 1, 600, 1, &wanted);
  return std::move(scenes.front().reference);
}

/// Nobody else looks, so that steps are taken many at a time and sums come in another order:
/// rounding, 1e-16 in each of 5000 steps, which a collision makes some ten times larger.
TEST(WholeReference, HasTheSamplesOfOneThatIsWatched) {
  ReferenceExtras extras;
  extras.samples = 7;
  const ReferenceResult watched = sampled("gas-soft", extras);
  extras.whole = true;
  const ReferenceResult whole = sampled("gas-soft", extras);
  ASSERT_TRUE(watched.assembly && whole.assembly);
  EXPECT_TRUE(whole.run.reached);
  EXPECT_EQ(whole.run.steps, watched.run.steps);
  EXPECT_TRUE(whole.observables.empty());
  EXPECT_EQ(whole.assembly->time, watched.assembly->time);
  ASSERT_EQ(whole.assembly->states.size(), 7u);
  for (const AssemblyQuantity& quantity : assembly_quantities()) {
    double largest = 0;
    for (const AssemblyState& state : watched.assembly->states)
      largest = std::max(largest, std::abs(quantity.of(state)));
    for (std::size_t k = 0; k < 7; ++k)
      EXPECT_NEAR(quantity.of(whole.assembly->states[k]), quantity.of(watched.assembly->states[k]),
                  1e-9 * largest)
          << quantity.name << " at " << k;
  }
}

/// Grains on a periodic plane; `more` stands under `substrate`, `law` under the normal one.
std::string grains(std::size_t count, const std::string& more, const std::string& law) {
  const double side = std::sqrt(static_cast<double>(count) * 3.1e-5);
  return fmt::format(R"(
slipcheck: 1
name: many
title: Many grains
materials:
  steel: {{density: 7850}}
contacts:
  - between: [steel, steel]
    normal: {{model: linear, restitution: 0.9, collision_time: 1e-3}}
    tangential: {{{2}}}
  - between: [steel, substrate]
    friction: 0.1
substrate: {{periodic: [{0}, {0}], {1}}}
fill: {{prefix: g, count: {3}, material: steel, radius: "2 mm", area: [0, 0, {0}, {0}], speed: 0.2, seed: 7}}
run: {{until: 0.0002}}
compare: {{reference: steps, engines: []}}
)",
                     side, more, law, count);
}

constexpr const char* kViscous = "model: viscous, damping_ratio: 0.5, friction: 0.3";

ReferenceExtras three_samples() {
  ReferenceExtras extras;
  extras.samples = 3;
  extras.whole = true;
  return extras;
}

void expect_same_bits(const ReferenceResult& a, const ReferenceResult& b) {
  ASSERT_TRUE(a.assembly && b.assembly);
  EXPECT_EQ(a.assembly->time, b.assembly->time);
  EXPECT_EQ(a.assembly->pairs.counts, b.assembly->pairs.counts);
  ASSERT_EQ(a.assembly->states.size(), b.assembly->states.size());
  for (const AssemblyQuantity& quantity : assembly_quantities())
    for (std::size_t k = 0; k < a.assembly->states.size(); ++k)
      EXPECT_EQ(std::bit_cast<std::uint64_t>(quantity.of(a.assembly->states[k])),
                std::bit_cast<std::uint64_t>(quantity.of(b.assembly->states[k])))
          << quantity.name << " at " << k;
}

/// The loops of unlike bodies and of like ones, and that of contacts that remember.
TEST(WholeReference, DoesNotLookAtTheStartAgain) {
  const std::pair<const char*, const char*> scenes[] = {
      {"confined: true, motion: {kind: oscillate, amplitude: [5 mm, 0], frequency: 5}", kViscous},
      {"confined: true", kViscous},
      {"tilt: 0", "model: spring, stiffness_ratio: 0.3, friction: 0.3"}};
  for (const auto& [more, law] : scenes) {
    const Scenario scenario = parse_scenario(grains(300, more, law), "many.yaml");
    ContactScene scene = make_contact_scene(scenario);
    const ReferenceSolver solver(scene, reference_settings(scenario));
    ReferenceExtras extras = three_samples();
    const ReferenceResult kept = run_reference_whole(solver, run_end(scenario), extras);
    extras.started = [&] { scene.hard.initial = {}; };
    const ReferenceResult let_go = run_reference_whole(solver, run_end(scenario), extras);
    EXPECT_TRUE(scene.hard.initial.empty());
    expect_same_bits(kept, let_go);
  }
}

/// What the file says of many bodies is dropped while they move, and there again afterwards.
TEST(WholeReference, TellsManyBodiesAgain) {
  const std::string text = grains(10000, "confined: true", kViscous);
  const Scenario scenario = parse_scenario(text, "many.yaml");
  const ContactScene scene = make_contact_scene(scenario);
  const ReferenceResult alone = run_reference_whole(
      ReferenceSolver(scene, reference_settings(scenario)), run_end(scenario), three_samples());
  const std::map<std::string, ReferenceExtras> wanted = {{"many", three_samples()}};
  const std::vector<PreparedScene> prepared =
      prepare_scenes({parse_scenario(text, "many.yaml")}, false, 1, 600, 1, &wanted);
  const PreparedScene& whole = prepared.front();
  expect_same_bits(alone, whole.reference);
  ASSERT_EQ(whole.scenario.bodies.size(), 10000u);
  ASSERT_EQ(whole.contact->hard.initial.size(), 10000u);
  for (std::size_t i = 0; i < 10000; ++i) {
    EXPECT_EQ(whole.scenario.bodies[i].name, scenario.bodies[i].name);
    EXPECT_EQ(whole.scenario.bodies[i].initial.position, scenario.bodies[i].initial.position);
    EXPECT_EQ(whole.contact->hard.initial[i].position, scene.hard.initial[i].position);
    EXPECT_EQ(whole.contact->hard.initial[i].velocity, scene.hard.initial[i].velocity);
  }
}

TEST(WholeReference, TellsThemAgainWhereTheUserHasHadEnough) {
  std::atomic<bool> stop = false;
  ReferenceExtras extras = three_samples();
  extras.states = [&](double, const std::vector<BodyState>&) { stop = true; };
  const std::map<std::string, ReferenceExtras> wanted = {{"many", extras}};
  Scenario scenario = parse_scenario(grains(10000, "confined: true", kViscous), "many.yaml");
  const StopScope scope(&stop);
  const std::vector<PreparedScene> prepared =
      prepare_scenes({std::move(scenario)}, false, 1, 600, 1, &wanted);
  EXPECT_TRUE(stop);
  EXPECT_TRUE(prepared.front().reference.run.failed);
  EXPECT_EQ(prepared.front().reference.run.reason, "interrupted");
  EXPECT_EQ(prepared.front().scenario.bodies.size(), 10000u);
  EXPECT_EQ(prepared.front().contact->hard.initial.size(), 10000u);
}

TEST(WholeReference, CanBeLeftOut) {
  ReferenceExtras extras;
  extras.samples = 7;
  extras.whole = extras.left_out = true;
  const ReferenceResult none = sampled("gas-soft", extras);
  EXPECT_TRUE(none.left_out);
  EXPECT_FALSE(none.assembly);
  EXPECT_EQ(none.run.steps, 0u);
}

TEST(WholeReference, RefusesWhatHasNoForces) {
  ReferenceExtras extras;
  extras.samples = 7;
  extras.whole = true;
  EXPECT_EQ(
      test::refusal_of<Unsupported>([&] { sampled("symmetric-30cms", extras); }),
      "symmetric-30cms: --whole needs soft contacts between all bodies, whose states tell the "
      "forces");
}

}  // namespace
}  // namespace slipcheck
