#include "scenes.h"

// What `run`, `compare` and `contacts` say about many bodies: the box and the periodic plane.

namespace slipcheck {
namespace {

using namespace testing;

const std::string kWritten = "{periods: 2000, discard: 500, sample: phase_zero}";

slipcheck::Run run_of(const std::string& run) {
  return parse_scenario(with(kContainer, kWritten, run), "s.yaml").run;
}
/// Expects one fault in line 14, whose text goes on like this.
void expect_run_fault(const std::string& run, const std::string& rest) {
  expect_fault(with(kContainer, kWritten, run), "s.yaml:14:" + rest);
}

TEST(RunRules, CollapseModels) {
  EXPECT_TRUE(std::holds_alternative<SlowestRebound>(run_of("{until: 1}").collapse));
  for (const char* text : {"slowest_rebound", "{model: slowest_rebound}"}) {
    EXPECT_TRUE(std::holds_alternative<SlowestRebound>(
        run_of(std::string("{until: 1, collapse: ") + text + "}").collapse));
  }
  const auto tc = run_of("{until: 1, collapse: {model: contact_time, contact_time: 2 us}}");
  EXPECT_EQ(std::get<ContactTimeModel>(tc.collapse).contact_time, 2e-6);
  const auto largest = run_of("{until: 1, collapse: {model: largest_velocity, contact_time: 3}}");
  EXPECT_EQ(std::get<LargestVelocityModel>(largest.collapse).contact_time, 3);
  // Not only in a box.
  EXPECT_EQ(messages(with(kHard, "{until: rolling}",
                          "{until: rolling, collapse: {model: contact_time, contact_time: 1}}")),
            kNoFaults);
}

TEST(RunRules, CollapseFaults) {
  expect_run_fault("{until: 1, collapse: {model: contact_time}}",
                   "27: run.collapse: needs the key contact_time");
  expect_run_fault("{until: 1, collapse: {model: largest_velocity}}",
                   "27: run.collapse: needs the key contact_time");
  expect_run_fault("{until: 1, collapse: {model: slowest_rebound, contact_time: 1}}",
                   "52: run.collapse.contact_time: is not a key here (there are: model)");
  expect_run_fault("{until: 1, collapse: {model: contact_time, contact_time: 0}}",
                   "63: run.collapse.contact_time: must be > 0 s, got 0");
  expect_run_fault("{until: 1, collapse: {model: largest_speed, contact_time: 1}}",
                   "35: run.collapse.model: must be slowest_rebound, contact_time or "
                   "largest_velocity, got largest_speed");
  expect_run_fault("{until: 1, collapse: contact_time}",
                   "27: run.collapse: must be a mapping with its parameters, {model: contact_time, "
                   "…}, got contact_time");
}

TEST(RunRules, MostEvents) {
  EXPECT_EQ(run_of("{until: 1}").most_events, 1e7);
  EXPECT_EQ(run_of("{until: 1, most_events: 2.5e5}").most_events, 2.5e5);
  EXPECT_EQ(run_of("{until: 1, most_events: 3 1/ms}").most_events, 3000);
  expect_run_fault("{until: 1, most_events: 0}", "30: run.most_events: must be > 0 1/s, got 0");
  expect_run_fault("{until: 1, most_events: 5 s}",
                   "30: run.most_events: must be a rate, as in \"8 1/s\", got 5 s");
}

TEST(RunRules, DiscardByNumberOrUntilSteady) {
  EXPECT_EQ(run_of("{periods: 9, discard: 8}").discard, 8);
  EXPECT_FALSE(run_of("{periods: 9, discard: 8}").discard_until_steady);
  const auto steady = run_of("{periods: 9, discard: auto, sample: phase_zero}");
  EXPECT_TRUE(steady.discard_until_steady);
  EXPECT_TRUE(steady.sample_phase_zero);
  EXPECT_EQ(steady.discard, 0);
  expect_run_fault("{periods: 9, discard: [1]}",
                   "28: run.discard: must be a number of periods or auto, got [1]");
  expect_run_fault("{periods: 9, discard: -1}",
                   "28: run.discard: must be a whole number from 0 to 1000000000, got -1");
  // 100 Hz for 50 ms are 5 periods.
  EXPECT_EQ(run_of("{until: 50 ms, discard: 4}").discard, 4);
  expect_run_fault("{until: 50 ms, discard: 5}",
                   "30: run.discard: must be fewer periods than fit into until, got 5");
  expect_fault(with(kHard, "{until: rolling}", "{until: 1, discard: auto}"),
               "s.yaml:16:26: run.discard: is only for a container, got auto");
}

TEST(RunRules, AFloorAtRestHasNoPeriods) {
  const std::string still = with(kContainer, "frequency: 100", "frequency: 0");
  EXPECT_EQ(messages(with(still, kWritten, "{periods: 9, discard: auto, sample: phase_zero}")),
            (std::vector<std::string>{
                "s.yaml:14:16: run.periods: needs a floor that vibrates, got 9",
                "s.yaml:14:28: run.discard: needs a floor that vibrates, got auto",
                "s.yaml:14:42: run.sample: needs a floor that vibrates, got phase_zero"}));
  expect_fault(with(still, kWritten, "{limit: 5}"),
               "s.yaml:14:6: run: needs exactly one of until or periods");
  EXPECT_EQ(messages(with(still, kWritten, "{until: 5}")), kNoFaults);
  EXPECT_EQ(parse_scenario(with(still, kWritten, "{until: 5}"), "s.yaml").run.time, 5);
}

TEST(RunRules, ContactsOfAContainer) {
  const std::string wall =
      "  - {between: [steel, wall], normal: {model: hard, restitution: 0.9}}\n";
  const auto missing = [](const std::string& surface) {
    return "s.yaml:7:3: contacts: needs a contact between steel and " + surface +
           ", which can meet";
  };
  expect_fault(with(kContainer, wall, ""), missing("wall"));
  expect_fault(with(kContainer, "width:", "height: 9 mm, width:"), missing("lid"));
  expect_fault(with(kContainer, "[steel, floor]", "[steel, lid]"),
               "s.yaml:8:23: contacts[1].between[1]: is not part of this scene's surroundings, got "
               "lid");
  std::string glass = with(kContainer, "steel: {density: 7850}",
                           "steel: {density: 7850}\n  glass: {density: 2500}");
  glass = with(glass, "name: b, material: steel", "name: b, material: glass");
  const auto faults = messages(glass);
  ASSERT_EQ(faults.size(), 3u);
  EXPECT_EQ(faults[0],
            "s.yaml:8:3: contacts: needs a contact between glass and floor, which can meet");
  EXPECT_EQ(faults[1],
            "s.yaml:8:3: contacts: needs a contact between glass and wall, which can meet");
  EXPECT_EQ(faults[2],
            "s.yaml:8:3: contacts: needs a contact between glass and steel, which can meet");
}

TEST(RunRules, PeriodicCellsAreFourDiametersWide) {
  const auto periodic = [](const std::string& text) {
    return messages(with(kHard, "substrate: {}", "substrate: {periodic: " + text + "}"));
  };
  EXPECT_EQ(periodic("[1.6, 0.8]"), kNoFaults);
  EXPECT_EQ(periodic("[1.6, 80 cm]"), kNoFaults);
  const std::string rule = "must be at least 4 times the largest diameter, 0.8 m, got ";
  EXPECT_EQ(periodic("[0.79, 50 cm]"), (std::vector<std::string>{
                                           "s.yaml:12:24: substrate.periodic[0]: " + rule + "0.79",
                                           "s.yaml:12:30: substrate.periodic[1]: " + rule + "50 cm",
                                       }));
  // The largest may be one of a fill; lengths are told in the file's units.
  const std::string cgs = with(
      with(kHard, "materials:", "units: cgs\nmaterials:"), "run:",
      "fill: {prefix: g, count: 1, material: steel, radius: {uniform: [1, 2]}, area: [0, 7, 9, "
      "9]}\nrun:");
  expect_fault(
      with(cgs, "substrate: {}", "substrate: {periodic: [16, 15.9]}"),
      "s.yaml:13:28: substrate.periodic[1]: must be at least 4 times the largest diameter, "
      "16 cm, got 15.9");
}

TEST(RunRules, ImagesFarAwayMustNotOverlap) {
  // 7 cells to the left and 3 up of a at the origin, 0.15 m beside its image.
  const std::string periodic = with(kHard, "substrate: {}", "substrate: {periodic: [2, 3]}");
  expect_fault(with(periodic, "position: [1, 0]", "position: [-13.85, 9]"),
               "s.yaml:15:65: bodies[1].position: must not overlap a, but does by 0.05 m, got "
               "[-13.85, 9]");
  EXPECT_EQ(messages(with(periodic, "position: [1, 0]", "position: [-13.8, 9]")), kNoFaults);
}

TEST(RunRules, TolerancesOfWholeScenes) {
  const auto scenario = parse_scenario(
      kContainer +
          "compare: {tolerance: {height: 5 %, kinetic_energy: 0.1, rotational_energy: "
          "1 uJ, collision_rate: 100 1/s, energy_drift: 1e-9, momentum_drift: 1 %}}\n",
      "s.yaml");
  const auto& tolerance = scenario.compare.tolerance;
  EXPECT_EQ(tolerance.at("height").value, 0.05);
  EXPECT_FALSE(tolerance.at("height").absolute);
  EXPECT_EQ(tolerance.at("kinetic_energy").value, 0.1);
  EXPECT_TRUE(tolerance.at("rotational_energy").absolute);
  EXPECT_DOUBLE_EQ(tolerance.at("rotational_energy").value, 1e-6);
  EXPECT_TRUE(tolerance.at("collision_rate").absolute);
  EXPECT_EQ(tolerance.size(), 6u);
}

}  // namespace
}  // namespace slipcheck
