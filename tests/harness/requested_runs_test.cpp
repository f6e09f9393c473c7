#include "harness/run/requested_runs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

#include "../support/in_folder.h"
#include "../support/refusal.h"
#include "engine/engine_registry.h"
#include "engine/protocol.h"
#include "harness/run/engine_grid.h"
#include "scenario/fault.h"
#include "scenario/load.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

class RequestedRunsTest : public test::InFolder {
 protected:
  void SetUp() override {
    setenv("SLIPCHECK_ENGINE_PATH", SLIPCHECK_BINARY_DIR "/faulty", 1);
    fs::create_directories(folder_ / "scenes");
  }

  void put(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }

  /// A ball at rest that is held against these engines, one in each line from line 12 on.
  Scenario scenario(const std::string& engines) const {
    return parse_scenario(R"(slipcheck: 1
name: ball
title: A ball
materials: {steel: {density: 7850}}
contacts: [{between: [steel, substrate], friction: 0.1}]
substrate: {}
bodies:
  - {name: i, material: steel, sphere: {radius: 0.002}, position: [0, 0]}
run: {until: 1}
compare:
  engines:
)" + engines,
                          (folder_ / "scenes/ball.yaml").string());
  }

  std::vector<EngineRecord> runs(const std::string& engines) const {
    return requested_runs({scenario(engines)}).at(0);
  }

  std::vector<std::string> faults(const std::vector<Scenario>& scenarios,
                                  const Settings& settings = {}) const {
    std::vector<std::string> messages;
    for (const Fault& fault :
         test::faults_of([&] { requested_runs(scenarios, {}, nullptr, settings); })) {
      std::string message = fault.message();
      for (std::size_t at; (at = message.find(folder_.string() + "/")) != std::string::npos;)
        message.erase(at, folder_.string().size() + 1);
      messages.push_back(message);
    }
    return messages;
  }
};

TEST_F(RequestedRunsTest, EachEngineHasARunAtEachOfItsRates) {
  const auto found = runs(
      "    - {engine: faulty, rate: [60, 240], profile: slow}\n"
      "    - {engine: bullet, precision: single, rate: 1000, expect: {status: skipped}}\n");
  ASSERT_EQ(found.size(), 3u);
  for (std::size_t k : {0u, 1u}) {
    EXPECT_EQ(found[k].engine, "faulty");
    EXPECT_EQ(found[k].precision, "double");
    EXPECT_EQ(found[k].profile, "slow");
    EXPECT_EQ(found[k].rate, k == 0 ? 60 : 240);
    EXPECT_EQ(found[k].settings, (Settings{{"fault", std::string("slow")}}));
    EXPECT_FALSE(found[k].expect);
    EXPECT_EQ(found[k].reason, "");
  }
  EXPECT_EQ(found[2].precision, "single");
  EXPECT_TRUE(found[2].expect);
}

TEST_F(RequestedRunsTest, ANameThatIsNotShippedIsAFaultWithTheNearest) {
  EXPECT_EQ(
      faults({scenario("    - {engine: faulty, rate: 60, profile: hnag}\n")}),
      (std::vector<std::string>{
          "scenes/ball.yaml:12:34: compare.engines[0].profile: must be one of the profiles of "
          "faulty, eat-memory, hang, kill-at-step-10, nan, ok, slow, default, or a path (did "
          "you mean hang?), got hnag"}));
}

TEST_F(RequestedRunsTest, OfAGridTheEnginesThatHaveTheProfileRun) {
  Scenario scene = scenario("    - {engine: bullet, rate: 60}\n");
  const std::vector<double> rates = {60};
  ask_for(scene, {{"faulty", "bullet"}, {"double"}, {"hang", "default"}}, rates);
  const auto found = requested_runs({scene}).at(0);
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[0].reason, "");
  EXPECT_EQ(found[2].reason, "bullet has no profile 'hang'");
  EXPECT_EQ(found[3].reason, "");
  ask_for(scene, {{"faulty", "bullet"}, {"double"}, {"hnag"}}, rates);
  EXPECT_EQ(faults({scene}),
            (std::vector<std::string>{
                "scenes/ball.yaml: --profiles: must be profiles of the engines, default, "
                "eat-memory, fast, hang, kill-at-step-10, naive, nan, ok, physical, slow, tuned, "
                "or paths (did you mean hang?), got hnag"}));
}

TEST_F(RequestedRunsTest, TheDefaultNeedsNoFile) {
  const auto found = runs("    - {engine: faulty, rate: 60}\n");
  EXPECT_EQ(found[0].profile, "default");
  EXPECT_EQ(found[0].reason, "");
  EXPECT_TRUE(found[0].settings.empty());
}

TEST_F(RequestedRunsTest, APathIsTakenFromTheScenesFolder) {
  put("mine.yaml", "slipcheck-profile: 1\nengine: faulty\nname: mine\nsettings: {pause: 7}\n");
  const Settings mine = {{"pause", 7.0}};
  EXPECT_EQ(runs("    - {engine: faulty, rate: 60, profile: ../mine.yaml}\n")[0].settings, mine);
  EXPECT_EQ(runs("    - {engine: faulty, rate: 60, profile: " + (folder_ / "mine.yaml").string() +
                 "}\n")[0]
                .settings,
            mine);
}

TEST_F(RequestedRunsTest, SettingsByHandStandOverThoseOfEveryProfile) {
  put("mine.yaml", "slipcheck-profile: 1\nengine: faulty\nname: mine\nsettings: {pause: 7}\n");
  const auto found = requested_runs({scenario("    - {engine: faulty, rate: 60, profile: slow}\n"
                                              "    - {engine: faulty, rate: 60}\n"
                                              "    - {engine: faulty, rate: 60, profile: "
                                              "../mine.yaml}\n")},
                                    {}, nullptr, {{"pause", 9.0}})
                         .at(0);
  EXPECT_EQ(found[0].settings, (Settings{{"fault", std::string("slow")}, {"pause", 9.0}}));
  EXPECT_EQ(found[1].settings, (Settings{{"pause", 9.0}}));
  EXPECT_EQ(found[2].settings, (Settings{{"pause", 9.0}}));
}

TEST_F(RequestedRunsTest, SettingsByHandAreCheckedAsThoseOfAProfile) {
  const std::vector<std::string> expected = {
      "--set: faul: is no setting of this engine (did you mean fault?)",
      "--set: pause: must be a whole number >= 0 and <= 1000 ms, got -1"};
  EXPECT_EQ(faults({scenario("    - {engine: faulty, rate: [60, 240]}\n")},
                   {{"faul", std::string("ok")}, {"pause", -1.0}}),
            expected);
}

TEST_F(RequestedRunsTest, EverythingThatIsWrongIsToldAtOnceAndOnce) {
  put("scenes/typo.yaml", "slipcheck-profile: 1\nengine: faulty\nnam: typo\n");
  put("scenes/far.yaml",
      "slipcheck-profile: 1\nengine: faulty\nname: far\nsettings: {pause: -1, faul: ok}\n");
  put("scenes/other.yaml", "slipcheck-profile: 1\nengine: ode\nname: other\n");
  const Scenario scene = scenario(
      "    - {engine: bulet, rate: 60}\n"
      "    - {engine: faulty, rate: 60, profile: none.yaml}\n"
      "    - {engine: faulty, rate: 60, profile: typo.yaml}\n"
      "    - {engine: faulty, rate: [60, 240], profile: far.yaml}\n"
      "    - {engine: faulty, rate: 60, profile: ./other.yaml}\n"
      // Not installed here, but what it names is looked at all the same.
      "    - {engine: faulty, precision: single, rate: 60, profile: none.yaml}\n");
  std::set<std::string> engines = {"faulty"};
  for (const KnownEngine& known : known_engines()) engines.insert(known.name);
  const std::vector<std::string> expected = {
      fmt::format("scenes/ball.yaml:12:8: compare.engines[0].engine: must be one of the engines {} "
                  "(did you mean bullet?), got bulet",
                  fmt::join(engines, ", ")),
      "scenes/ball.yaml:13:34: compare.engines[1].profile: scenes/none.yaml must be a readable "
      "file: No such file or directory, got none.yaml",
      "scenes/typo.yaml:3:1: nam: is not a key here (did you mean name?)",
      "scenes/typo.yaml:1:1: needs the key name",
      "scenes/far.yaml:4:23: settings.faul: is no setting of this engine (did you mean fault?)",
      "scenes/far.yaml:4:12: settings.pause: must be a whole number >= 0 and <= 1000 ms, got -1",
      "scenes/./other.yaml:2:1: engine: must be faulty, which is to run with it, got ode",
      "scenes/ball.yaml:17:53: compare.engines[5].profile: scenes/none.yaml must be a readable "
      "file: No such file or directory, got none.yaml",
  };
  EXPECT_EQ(faults({scene}), expected);
  EXPECT_EQ(faults({scene, scene}), expected);
}

TEST_F(RequestedRunsTest, MoreBodiesThanAMessageHoldsAreRefused) {
  // What each further body adds to the longest message, of 64 MiB at most.
  const auto bytes = [](std::size_t bodies) {
    Scene scene;
    scene.bodies.assign(bodies, {0.1, 1.0 / 3, 0.4});
    scene.material.assign(bodies, 0);
    scene.initial.resize(bodies);
    scene.substrate.resize(1);
    scene.pairs.resize(1);
    return protocol::encode(protocol::Configure{scene, {}, 0.01}).size();
  };
  EXPECT_LT((bytes(2000) - bytes(1000)) * 400, protocol::kMaxMessage);

  Scenario scenario;
  scenario.file = "s.yaml";
  scenario.bodies.resize(400'001);
  scenario.locations["compare.engines"] = {7, 12};
  EXPECT_NO_THROW(requested_runs({scenario}));  // the reference alone
  scenario.compare.engines.resize(1);
  scenario.compare.engines[0].engine = "bullet";
  scenario.compare.engines[0].rates = {240};
  EXPECT_EQ(test::refusal_of<BadScenario>([&] { requested_runs({scenario}); }),
            "s.yaml:7:12: compare.engines: must be [] with more than 400000 bodies, the "
            "reference alone: no message to an engine holds more, got 400001 bodies");

  // Of 400 sizes, whose springs depend on the mass.
  scenario.bodies.resize(400);
  for (std::size_t i = 0; i < 400; ++i) {
    scenario.bodies[i].material = "steel";
    scenario.bodies[i].sphere.radius = 1e-3 + 1e-6 * static_cast<double>(i);
  }
  scenario.contacts.resize(1);
  scenario.contacts[0].first = scenario.contacts[0].second = "steel";
  EXPECT_NO_THROW(requested_runs({scenario}));
  LinearNormal linear;
  linear.restitution = 0.9;
  linear.collision_time = 1e-3;
  scenario.contacts[0].normal = linear;
  EXPECT_EQ(test::refusal_of<BadScenario>([&] { requested_runs({scenario}); }),
            "s.yaml:7:12: compare.engines: must be [] with more than 300 sizes of bodies whose "
            "contacts depend on them, the reference alone: engines are told of each two of them, "
            "got 400 bodies");
  scenario.compare.engines.clear();
  EXPECT_NO_THROW(requested_runs({scenario}));
}

}  // namespace
}  // namespace slipcheck
