#include "harness/run/reference_keeper.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <thread>

#include "../support/text_of.h"
#include "harness/run/reference_run.h"
#include "reference/reference_solver.h"
#include "scenario/load.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

/// Balls that collide for some tenths of a second of CPU time.
Scenario balls(const std::string& tangential, const std::string& radius, const std::string& solver,
               const std::string& until) {
  return parse_scenario(
      fmt::format(R"(slipcheck: 1
name: balls
title: Balls that collide
gravity: 9.81
materials: {{m: {{density: 1000}}}}
contacts:
  - between: [m, m]
    normal: {{model: linear, restitution: 0.8, collision_time: 1e-3}}
    tangential: {}
  - {{between: [m, substrate], friction: 0.1}}
substrate: {{periodic: [1, 1]{}}}
fill: {{prefix: g, count: 60, material: m, radius: {}, area: [0, 0, 1, 1], speed: 1, seed: 3}}
run: {{until: {}}}
compare: {{reference: {}, engines: []}}
)",
                  tangential, radius == "0.02" ? ", confined: true" : "", radius, until, solver),
      "balls.yaml");
}

/// All that is told of a reference, but for how long it took.
std::string told(const ReferenceResult& result) {
  std::string text = fmt::format("{} {} {} {}\n", result.run.end_time, result.run.collisions,
                                 result.run.steps, result.first_contact);
  for (const auto& [name, value] : result.observables)
    text += fmt::format("{} {} {}\n", name, value.value, value.uncertainty);
  for (const std::string& warning : result.warnings) text += warning + "\n";
  if (result.assembly)
    for (std::size_t k = 0; k < result.assembly->time.size(); ++k) {
      const AssemblyState& state = result.assembly->states[k];
      text += fmt::format("{} {} {} {} {}\n", result.assembly->time[k], state.kinetic_energy,
                          state.elastic_energy, state.pressure(), state.sonine);
    }
  return text;
}

void put(const fs::path& path, std::string_view text) {
  const fs::path beside = path.string() + ".tmp";
  {
    std::ofstream file(beside, std::ios::binary);
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
  }
  fs::rename(beside, path);
}

/// A process that goes on with what is kept, and puts what it tells into a file in the end.
pid_t begin(const Scenario& scenario, const fs::path& kept, const fs::path& result) {
  const pid_t child = fork();
  if (child != 0) return child;
  ReferenceExtras extras;
  extras.samples = 20;
  extras.checkpoints = Checkpoints{.every = 0.003,
                                   .state = fs::exists(kept) ? test::text_of(kept) : "",
                                   .write = [&](std::string_view state) { put(kept, state); }};
  const ContactScene scene = make_contact_scene(scenario);
  const ReferenceSolver solver(scene, reference_settings(scenario));
  put(result, told(run_reference(solver, run_end(scenario), body_names(scenario), extras)));
  _exit(0);
}

#ifdef SLIPCHECK_SANITIZE  // to which a pile takes a quarter of an hour; kept_tests has it
constexpr int kUsualKills = 2;
constexpr const char* kKilled[] = {"grains", "unlike"};
#else
constexpr int kUsualKills = 3;
constexpr const char* kKilled[] = {"grains", "unlike", "pile"};
#endif

class KilledReference : public testing::TestWithParam<const char*> {};

/// Killed at moments by chance, as many as SLIPCHECK_KILLS says, the reference ends with the same
/// bytes as one that was left alone.
TEST_P(KilledReference, EndsWithTheSameBytes) {
  const std::string kind = GetParam();
  const char* viscous = "{model: viscous, damping_ratio: 0.5, friction: 0.3}";
  const Scenario scenario = kind == "grains" ? balls(viscous, "0.02", "steps", "0.15")
                            : kind == "unlike"
                                ? balls(viscous, "{uniform: [0.01, 0.02]}", "steps", "0.1")
                                : balls("{model: spring, stiffness_ratio: 0.286, friction: 0.3}",
                                        "{uniform: [0.015, 0.02]}", "contact", "0.04");
  ReferenceExtras extras;
  extras.samples = 20;
  const ContactScene scene = make_contact_scene(scenario);
  const ReferenceSolver solver(scene, reference_settings(scenario));
  ASSERT_TRUE(solver.keeps_state());
  const auto start = std::chrono::steady_clock::now();
  const ReferenceResult whole =
      run_reference(solver, run_end(scenario), body_names(scenario), extras);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  ASSERT_TRUE(whole.run.reached) << whole.run.reason;
  ASSERT_GT(whole.run.collisions, 0u);
  ASSERT_EQ(whole.assembly->time.size(), 20u);

  const fs::path folder =
      fs::path(testing::TempDir()) / fmt::format("slipcheck-kept-{}-{}", kind, getpid());
  fs::create_directories(folder);
  const fs::path kept = folder / "kept", result = folder / "result";
  const char* wanted = std::getenv("SLIPCHECK_KILLS");
  const int kills = wanted ? std::atoi(wanted) : kUsualKills;
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> moment(0.1 / kills, 1.2 / kills);
  int done = 0, went_on = 0;
  for (int k = 0; k < 20 * kills && done < kills; ++k) {
    went_on += fs::exists(kept);
    const pid_t child = begin(scenario, kept, result);
    // Of every second piece not before there is something to go on from: a busy machine may start
    // none for long.
    for (int looks = 0; k % 2 == 0 && looks < 60000 && !fs::exists(kept); ++looks)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::this_thread::sleep_for(moment(random) * took);
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    if (WIFSIGNALED(status)) {
      ++done;
      continue;
    }
    // It came to its end before: once more from the start.
    EXPECT_EQ(test::text_of(result), told(whole)) << "piece " << k;
    fs::remove(kept);
    fs::remove(result);
  }
  EXPECT_EQ(done, kills);
  EXPECT_GT(went_on, 0);
  int status = 0;
  waitpid(begin(scenario, kept, result), &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(test::text_of(result), told(whole));
  fs::remove_all(folder);
}

INSTANTIATE_TEST_SUITE_P(All, KilledReference, testing::ValuesIn(kKilled),
                         [](const auto& each) { return std::string(each.param); });

/// The run goes on where its state cannot be written, and says so.
TEST(ReferenceKeeper, TellsWhatCannotBeWritten) {
  const Scenario scenario =
      balls("{model: viscous, damping_ratio: 0.5, friction: 0.3}", "0.02", "steps", "0.01");
  const ContactScene scene = make_contact_scene(scenario);
  const ReferenceSolver solver(scene, reference_settings(scenario));
  ReferenceExtras extras;
  extras.checkpoints = Checkpoints{.every = 0, .state = {}, .write = [](std::string_view) {
                                     throw std::runtime_error("the disk is full");
                                   }};
  const ReferenceResult result =
      run_reference(solver, run_end(scenario), body_names(scenario), extras);
  EXPECT_TRUE(result.run.reached);
  ASSERT_FALSE(result.warnings.empty());
  EXPECT_NE(result.warnings.front().find("could not be kept on the way: the disk is full"),
            std::string::npos);
}

/// What cannot be had is said: hard contacts go by events.
TEST(ReferenceKeeper, SaysWhatGoesByEvents) {
  const Scenario scenario = parse_scenario(R"(slipcheck: 1
name: hard
title: A ball
gravity: 9.81
materials: {m: {density: 1000}}
contacts:
  - {between: [m, m], normal: {model: hard, restitution: 0.8}}
  - {between: [m, substrate], friction: 0.1}
substrate: {}
bodies:
  - {name: i, material: m, sphere: {radius: 0.02}, position: [0, 0], velocity: [1, 0]}
run: {until: 0.1}
compare: {engines: []}
)",
                                           "hard.yaml");
  const ContactScene scene = make_contact_scene(scenario);
  const ReferenceSolver solver(scene, reference_settings(scenario));
  ReferenceExtras extras;
  extras.samples = 5;
  extras.checkpoints = Checkpoints{.every = 0, .state = {}, .write = [](std::string_view) {
                                     ADD_FAILURE() << "there is no state";
                                   }};
  const ReferenceResult result =
      run_reference(solver, run_end(scenario), body_names(scenario), extras);
  EXPECT_FALSE(result.assembly);
  ASSERT_EQ(result.warnings.size(), 2u);
  EXPECT_NE(result.warnings[0].find("no samples of the whole"), std::string::npos);
  EXPECT_NE(result.warnings[1].find("no state was kept on the way"), std::string::npos);
}

}  // namespace
}  // namespace slipcheck
