#include "engine/profile.h"

#include <gtest/gtest.h>

#include <fstream>

#include "../support/in_folder.h"
#include "../support/refusal.h"
#include "some_scene.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

const std::string kHead = "slipcheck-profile: 1\nengine: bullet\nname: mine\n";

std::vector<std::string> faults_of(const std::string& text) {
  std::vector<std::string> messages;
  for (const Fault& fault : test::faults_of([&] { parse_profile(text, "p.yaml"); }))
    messages.push_back(fault.message());
  return messages;
}

TEST(Profile, ValuesHaveTheTypeInWhichTheyAreWritten) {
  const Profile profile = parse_profile(kHead + R"(about: mine alone
settings:
  on: true
  off: false
  erp: 0.2
  tiny: -1e-12
  iterations: 10
  body: multibody
  quoted: "10"
  spoken: 'true'
  norwegian: no
provenance: {seed: 1, scenes: [a, b], seed: 2}
)",
                                        "p.yaml");
  EXPECT_EQ(profile.engine, "bullet");
  EXPECT_EQ(profile.name, "mine");
  EXPECT_EQ(profile.about, "mine alone");
  const Settings expected = {{"on", true},
                             {"off", false},
                             {"erp", 0.2},
                             {"tiny", -1e-12},
                             {"iterations", 10.0},
                             {"body", std::string("multibody")},
                             {"quoted", std::string("10")},
                             {"spoken", std::string("true")},
                             {"norwegian", std::string("no")}};
  EXPECT_EQ(profile.settings, expected);
  EXPECT_EQ(profile.locations.at("settings.erp").line, 8);
  EXPECT_TRUE(parse_profile(kHead, "p.yaml").settings.empty());
}

TEST(Profile, EveryFaultOfAFileIsToldWithItsPlace) {
  EXPECT_EQ(faults_of("slipcheck-profile: 2\nengine: Bullet\nname: a b\nsetings: {}\nabout: |\n"
                      "  two\n  lines\n"),
            (std::vector<std::string>{
                "p.yaml:4:1: setings: is not a key here (did you mean settings?)",
                "p.yaml:1:20: slipcheck-profile: must be 1, got 2",
                "p.yaml:2:9: engine: must be a name of a-z, 0-9 and -, up to 64, got Bullet",
                "p.yaml:3:7: name: must be a name of a-z, 0-9 and -, up to 64, got a b",
                "p.yaml:5:8: about: must be one line, got \"two\\nlines\\n\"",
            }));
  EXPECT_EQ(faults_of(kHead + "settings:\n  erp: 0.2\n  cfm: [1]\n  erp: 0.3\n  gap:\n"),
            (std::vector<std::string>{
                "p.yaml:6:8: settings.cfm: must be true, false, a number or a word, got [1]",
                "p.yaml:7:3: settings.erp: must stand here once, but stands in line 5 too",
                "p.yaml:8:3: settings.gap: must be true, false, a number or a word, got nothing",
            }));
  EXPECT_EQ(faults_of("engine: bullet"),
            (std::vector<std::string>{"p.yaml:1:1: needs the key slipcheck-profile",
                                      "p.yaml:1:1: needs the key name"}));
  EXPECT_EQ(faults_of(kHead + "settings: [a]\n"),
            std::vector<std::string>{
                "p.yaml:4:11: settings: must be a mapping {name: value, …}, got [a]"});
  EXPECT_EQ(faults_of("[1]").size(), 1u);
  EXPECT_EQ(faults_of(""), std::vector<std::string>{"p.yaml: must hold a profile, but is empty"});
  EXPECT_EQ(faults_of("# nothing\n"),
            std::vector<std::string>{"p.yaml: must hold a profile, but is empty"});
}

TEST(Profile, WhatTheEngineDoesNotTakeIsToldWithItsPlace) {
  const EngineInfo info{"bullet", "3.24", "double", some_settings()};
  const auto messages = [&](const std::string& text) {
    std::vector<std::string> result;
    for (const Fault& fault : check_profile(parse_profile(text, "p.yaml"), info))
      result.push_back(fault.message());
    return result;
  };
  EXPECT_TRUE(messages(kHead + "settings: {erp: 1, iterations: 3, body: rigid}\n").empty());
  EXPECT_EQ(messages("slipcheck-profile: 1\nengine: ode\nname: mine\nsettings:\n  erp: 2\n"
                     "  iteratoins: 3\n  zzz: 1\n"),
            (std::vector<std::string>{
                "p.yaml:2:1: engine: must be bullet, which is to run with it, got ode",
                "p.yaml:5:3: settings.erp: must be a number >= 0 and <= 1 1/step, got 2",
                "p.yaml:6:3: settings.iteratoins: is no setting of this engine (did you mean "
                "iterations?)",
                "p.yaml:7:3: settings.zzz: is no setting of this engine",
            }));
}

TEST(Profile, WhatIsWrittenReadsBackAsTheSame) {
  Profile profile;
  profile.engine = "my-own";
  profile.name = "2";  // a number to YAML, but a name
  profile.about = "what: \"this\" # is, µ";
  profile.settings = {{"a", true},
                      {"b", 0.1},
                      {"c", -1.0 / 3},
                      {"d", 4e-320},
                      {"e", std::string("split-impulse")},
                      {"f", std::string("true")},
                      {"g", std::string("1e3")},
                      {"h", std::string("two words: \\ \"")},
                      {"i", std::string("inf")},
                      {"j", std::string("")},
                      {"k", std::string("null")},
                      {"l", 16384.0},
                      {"m", 1e22},
                      {"n", parse_profile(kHead + R"(about: "\_ \N")", "p.yaml").about}};
  const std::string text = profile_yaml(profile, {"seed: 7", "scenes:", "  - a"});
  const Profile read = parse_profile(text, "p.yaml");
  EXPECT_EQ(read.engine, profile.engine);
  EXPECT_EQ(read.name, profile.name);
  EXPECT_EQ(read.about, profile.about);
  EXPECT_EQ(read.settings, profile.settings) << text;
  EXPECT_TRUE(text.ends_with("provenance:\n  seed: 7\n  scenes:\n    - a\n")) << text;
  EXPECT_EQ(profile_yaml({"bullet", "default", "", {}, "", {}}),
            "slipcheck-profile: 1\nengine: bullet\nname: default\n");
}

class ProfileFilesTest : public test::InFolder {
 protected:
  void SetUp() override {
    fs::create_directories(folder_ / "profiles/bullet");
    fs::create_directories(folder_ / "profiles/ode");
  }
  void put(const std::string& name) { std::ofstream(folder_ / "profiles" / name) << kHead; }

  EngineExecutable executable() const {
    return {"bullet", "double", folder_ / "slipcheck-engine-bullet-double",
            folder_ / "profiles" / "bullet"};
  }
};

TEST_F(ProfileFilesTest, ShippedOnesAreFoundByName) {
  for (const char* name : {"bullet/naive.yaml", "bullet/default.yaml", "bullet/README.md",
                           "bullet/Draft.yaml", "ode/other.yaml"})
    put(name);
  EXPECT_EQ(profile_names(executable()), (std::vector<std::string>{"default", "naive"}));
  EXPECT_EQ(find_profile(executable(), "naive", "/scenes"), folder_ / "profiles/bullet/naive.yaml");
  for (const char* none : {"other", "tuned", "", "Draft", ".."})
    EXPECT_FALSE(find_profile(executable(), none, "/scenes")) << none;
  EXPECT_TRUE(profile_names({"none", "double", "/nowhere/x"}).empty());
}

TEST_F(ProfileFilesTest, PathsAreTakenFromTheirFolder) {
  EXPECT_EQ(find_profile(executable(), "mine.yaml", "/scenes"), "/scenes/mine.yaml");
  EXPECT_EQ(find_profile(executable(), "../mine.yml", "scenes"), "scenes/../mine.yml");
  EXPECT_EQ(find_profile(executable(), "/a/b", "/scenes"), "/a/b");
  EXPECT_EQ(find_profile(executable(), "b.yaml", ""), "b.yaml");
}

TEST_F(ProfileFilesTest, AFileIsLoadedOrRefused) {
  put("bullet/mine.yaml");
  EXPECT_EQ(load_profile(folder_ / "profiles/bullet/mine.yaml").name, "mine");
  EXPECT_THROW(load_profile(folder_ / "profiles/bullet/none.yaml"), BadScenario);
  EXPECT_THROW(load_profile(folder_), BadScenario);
}

}  // namespace
}  // namespace slipcheck
