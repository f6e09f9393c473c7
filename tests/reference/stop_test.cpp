// Every solver gives up where a StopScope says so, whatever it is at.
#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <string>

#include "../scenario/scenes.h"
#include "../support/cpu_time.h"
#include "../support/refusal.h"
#include "base/stop_scope.h"
#include "reference/reference_solver.h"

namespace slipcheck {
namespace {

using testing::with;

/// No computer comes so far.
constexpr double kForever = 1e10;  // [s]

struct Case {
  const char* name;
  const char* solver;
  std::string text;
};

void PrintTo(const Case& each, std::ostream* out) { *out << each.name; }

const std::string kScene = R"(slipcheck: 1
name: endless
title: Goes on for ever
gravity: 9.81
materials: {m: {density: 1000}}
contacts:
  - {between: [m, m], normal: @normal}
  - {between: [m, @ground]}
@surroundings
fill: {prefix: g, count: @count, material: m, radius: 0.01, area: [0.05, 0.05, 0.95, 0.95], speed: 1, spin: rolling}
run: {until: 1e10}
compare: {reference: @solver, engines: []}
)";

const std::string kHardNormal = "{model: hard, restitution: 1}";
const std::string kSoftNormal = "{model: linear, restitution: 1, collision_time: 1e-3}";
const std::string kPeriodic = "substrate: {periodic: [1, 1]}";
const std::string kShaken =
    "substrate: {motion: {kind: oscillate, amplitude: [0.01, 0], frequency: 5}}";

std::string scene(const std::string& solver, const std::string& normal, int count,
                  const std::string& surroundings) {
  std::string text = with(with(kScene, "@normal", normal), "@count", std::to_string(count));
  text = with(with(text, "@surroundings", surroundings), "@solver", solver);
  // What is shaken is carried along; a gas that is to go on has no friction.
  return with(text, "@ground]",
              surroundings == kShaken ? "substrate], friction: 0.5" : "substrate]");
}
std::string box(const std::string& solver, const std::string& normal) {
  const std::string surroundings =
      "container: {width: 1, height: 1, floor: {amplitude: 0.01, frequency: 10}}";
  std::string text = with(scene(solver, normal, 20, surroundings), ", spin: rolling", "");
  return with(text, "  - {between: [m, substrate]}",
              "  - {between: [m, floor], normal: " + normal +
                  "}\n  - {between: [m, wall], normal: " + normal +
                  "}\n  - {between: [m, lid], normal: " + normal + "}");
}

std::vector<Case> cases() {
  return {{"events", "event", scene("event", kHardNormal, 20, kPeriodic)},
          {"integrated", "contact", scene("contact", kSoftNormal, 1, kShaken)},
          {"steps", "steps", scene("steps", kSoftNormal, 2, kShaken)},
          {"grains", "steps", scene("steps", kSoftNormal, 100, kPeriodic)},
          {"box_of_events", "event", box("event", kHardNormal)},
          {"box_of_contacts", "contact", box("contact", kSoftNormal)}};
}

/// The run that does not end.
std::function<void()> endless(const ContactScene& contacts, const Case& each) {
  const RunEnd end = until_time(kForever);
  ReferenceSettings settings;
  settings.asked = each.solver == std::string("event")     ? Compare::Reference::event
                   : each.solver == std::string("contact") ? Compare::Reference::contact
                                                           : Compare::Reference::steps;
  return [&contacts, end, settings] { ReferenceSolver(contacts, settings).run(end, nullptr); };
}

class Stopped : public ::testing::TestWithParam<Case> {};

TEST_P(Stopped, ByAFlag) {
  const ContactScene contacts = make_contact_scene(parse_scenario(GetParam().text, "s.yaml"));
  const std::atomic<bool> stop = true;
  const StopScope scope(&stop);
  EXPECT_THROW(endless(contacts, GetParam())(), Interrupted);
}

TEST_P(Stopped, ByATimeLimitAndSoon) {
  const ContactScene contacts = make_contact_scene(parse_scenario(GetParam().text, "s.yaml"));
  const test::CpuTime took;
  const StopScope scope(0.05);
  EXPECT_EQ(test::refusal_of<OutOfTime>([&] { endless(contacts, GetParam())(); }),
            "took longer than the time limit of 0.05 s (--time-limit)");
  EXPECT_LT(took(), 1 * test::kSlower);
}

INSTANTIATE_TEST_SUITE_P(Solvers, Stopped, ::testing::ValuesIn(cases()),
                         [](const auto& each) { return std::string(each.param.name); });

TEST(Stopped, InTheSearchForACollisionTooSeldomToBeSeen) {
  // A ball that a shaken plate carries along never meets anything, however far one looks.
  const std::string text = with(scene("contact", kSoftNormal, 1, kShaken), "speed: 1", "speed: 0");
  const ContactScene contacts = make_contact_scene(parse_scenario(text, "s.yaml"));
  const ReferenceSolver solver(contacts, Compare::Reference::automatic);
  const StopScope scope(0.05);
  EXPECT_THROW(solver.next_collision(contacts.hard.initial, 0, kForever, 0), OutOfTime);
}

TEST(StopScope, NestsAndEndsWithItsScope) {
  const std::atomic<bool> stop = true, go_on = false;
  {
    const StopScope outer(&stop);
    EXPECT_THROW(heed_stop(), Interrupted);
    {
      const StopScope limit(1e-9);  // what comes first is told: the flag
      EXPECT_THROW(heed_stop(), Interrupted);
    }
    const StopScope inner(&go_on);  // in place of the outer flag
    EXPECT_NO_THROW(heed_stop());
  }
  for (int k = 0; k < 1000; ++k) EXPECT_NO_THROW(heed_stop());
  const StopScope short_one(1e-9);
  const StopScope longer(3600);
  EXPECT_THROW(
      {
        for (int k = 0; k < 64; ++k) heed_stop();
      },
      OutOfTime);
}

}  // namespace
}  // namespace slipcheck
