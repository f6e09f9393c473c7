#include "report/json/read_folders.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>
#include <string>

#include "../support/as_nobody.h"
#include "../support/in_folder.h"
#include "../support/refusal.h"
#include "read_records.h"
#include "report/json/json_report.h"
#include "report/json/motion_json.h"
#include "report/json/precision_json.h"
#include "report/json/stability_json.h"
#include "report/rows/context.h"
#include "study_records.h"

namespace slipcheck::testing {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

class ReadFolders : public test::InFolder {
 protected:
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  fs::path write(const std::string& name, const Json& json) const {
    return write(name, json.dump());
  }

  /// What reading says, without the folder's path.
  std::string refusal(const std::vector<fs::path>& paths) const {
    return without_folder(test::refusal_of<BadJson>([&] { read_folders(paths); }));
  }
  std::string refusal() const { return refusal({folder_}); }

  std::string without_folder(std::string text) const {
    const std::string path = folder_.string() + "/";
    for (std::size_t at; (at = text.find(path)) != std::string::npos;) text.erase(at, path.size());
    return text;
  }
};

/// The lottery under another name.
SceneRecord record_named(const std::string& name) {
  SceneRecord scene = lottery_scene(3);
  std::string text = kLotteryText;
  text.replace(text.find("symmetric-steel"), 15, name);
  scene.scenario = parse_scenario(text, name + ".yaml");
  return scene;
}

PrecisionScene precision_named(const std::string& name) {
  PrecisionScene scene = precision_scene();
  scene.scenario = record_named(name).scenario;
  return scene;
}

std::vector<StabilityCase> cases_named(const std::string& name) {
  std::vector<StabilityCase> cases = {stability_cases()[0]};
  cases[0].scenario = record_named(name).scenario;
  return cases;
}

TEST_F(ReadFolders, TakesEverythingThatIsAResult) {
  write("b.json", json_of(record_named("bb")));
  write("a.json", json_of(std::vector{record_named("ac"), record_named("aa")}));
  write("p.json", json_of({precision_named("bb")}, PrecisionGrid{}));
  StabilityGrid grid;
  grid.criteria.energy = 0.07;
  write("s.json", json_of(cases_named("bb"), grid, limit_results()));
  write("t.json", Json{{"schema", "slipcheck-tuning/1"}});
  write("other.json", std::string("[1, 2]"));
  write("text.yaml", std::string("no JSON"));
  fs::create_directory(folder_ / "folder.json");
  const auto [content, ignored] = read_folders({folder_});

  ASSERT_EQ(content.scenes.size(), 3u);
  EXPECT_EQ(content.scenes[0].scenario.name, "ac");  // by file, then as in the file
  EXPECT_EQ(content.scenes[1].scenario.name, "aa");
  EXPECT_EQ(content.scenes[2].scenario.name, "bb");
  EXPECT_EQ(content.scenes[2].runs.size(), 2u);
  ASSERT_EQ(content.precision.size(), 1u);
  EXPECT_EQ(content.precision[0].curves.size(), 7u);
  EXPECT_EQ(content.cases.size(), 1u);
  EXPECT_EQ(content.limits.limits.size(), 4u);
  EXPECT_EQ(content.limits.maps.size(), 1u);
  EXPECT_EQ(content.criteria.energy, 0.07);
  EXPECT_TRUE(content.commands.empty());
  ASSERT_EQ(ignored.size(), 2u);
  EXPECT_EQ(without_folder(ignored[0]), "other.json: is no file of Slipcheck");
  EXPECT_EQ(without_folder(ignored[1]), "t.json: slipcheck-tuning/1 has no part in a report");
}

TEST_F(ReadFolders, TakesSingleFilesAndSeveralFolders) {
  const fs::path file = write("single", json_of(record_named("aa")));
  fs::create_directory(folder_ / "sub");
  write("sub/b.json", json_of(record_named("bb")));
  const ReadResults results = read_folders({folder_ / "sub", file});
  ASSERT_EQ(results.content.scenes.size(), 2u);
  EXPECT_EQ(results.content.scenes[0].scenario.name, "bb");
}

TEST_F(ReadFolders, TellsUnderWhatCircumstances) {
  const Context here = context();
  Json one = json_of(record_named("aa")), two = json_of(record_named("bb")), three = two;
  two["slipcheck"]["version"] = "0.0.1";
  two["machine"]["processor"] = "Z80";
  write("a.json", one);
  write("b.json", two);
  const Context context = read_folders({folder_}).content.context;
  EXPECT_EQ(context.version, here.version + ", 0.0.1");
  EXPECT_EQ(context.cpu, here.cpu + ", Z80");
  EXPECT_EQ(context.commit, here.commit);
  EXPECT_EQ(context.compiler, here.compiler);
  EXPECT_EQ(context.cores, here.cores);
  EXPECT_EQ(context.date, "");
}

TEST_F(ReadFolders, GivesMotionToItsScene) {
  SceneRecord scene = record_named("aa");
  MotionFrame frame;
  frame.bodies.resize(2);
  scene.reference.motion = RecordedMotion{"reference", 0, kNaN, {frame}};
  scene.runs[1].motions = {{"worst", 2, 1.5, {frame}}};
  write("a.motion.json", motion_json_of(scene));  // before its scene
  write("b.json", json_of(scene));
  write("c.motion.json", motion_json_of(record_named("cc")));
  const auto [content, ignored] = read_folders({folder_});
  ASSERT_TRUE(content.scenes[0].reference.motion);
  EXPECT_EQ(content.scenes[0].reference.motion->frames.size(), 1u);
  ASSERT_EQ(content.scenes[0].runs[1].motions.size(), 1u);
  EXPECT_EQ(content.scenes[0].runs[1].motions[0].phase, 2u);
  ASSERT_EQ(ignored.size(), 1u);
  EXPECT_EQ(without_folder(ignored[0]), "c.motion.json: there is no result of its scene");

  Json other = motion_json_of(scene);
  other["scenario"]["sha256"] = "9f2c";
  write("d.motion.json", other);
  EXPECT_TRUE(refusal().starts_with("d.motion.json: scenario.sha256: must be ")) << refusal();
}

TEST_F(ReadFolders, RefusesASceneThatOccursTwice) {
  write("a.json", json_of(record_named("aa")));
  const fs::path again =
      write("b.json", json_of(std::vector{record_named("bb"), record_named("aa")}));
  EXPECT_EQ(refusal(), "b.json: the scene aa is in a.json already");
  fs::remove(again);
  write("p.json", json_of({precision_named("aa"), precision_named("aa")}, PrecisionGrid{}));
  EXPECT_EQ(refusal(), "p.json: the scene aa is in p.json already");
}

TEST_F(ReadFolders, RefusesCasesThatDoNotCompare) {
  StabilityGrid grid;
  write("s.json", json_of(cases_named("aa"), grid, {}));
  const fs::path second = write("t.json", json_of(cases_named("bb"), grid, {}));
  EXPECT_EQ(read_folders({folder_}).content.cases.size(), 2u);
  grid.criteria.creep = 0.5;
  write("t.json", json_of(cases_named("bb"), grid, {}));
  EXPECT_EQ(refusal(),
            "t.json: criteria: must be the same in all files, else their cases do not compare, "
            "got an object");
}

TEST_F(ReadFolders, SaysWhatCannotBeRead) {
  EXPECT_EQ(refusal(), folder_.string() + " holds no result file");
  EXPECT_EQ(refusal({folder_ / "none"}), "none: there is no such file or folder");
  const fs::path tuning = write("t.json", Json{{"schema", "slipcheck-tuning/1"}});
  EXPECT_EQ(refusal(), folder_.string() + " holds no result file");
  EXPECT_EQ(refusal({tuning}), "t.json is no result file");
  Json newer = json_of(record_named("aa"));
  newer["schema"] = "slipcheck-result/2";
  const fs::path file = write("a.json", newer);
  EXPECT_EQ(refusal(),
            "a.json: schema: must be slipcheck-result/1 for this version, got "
            "\"slipcheck-result/2\"");
  newer["schema"] = "slipcheck-result/1";
  newer["machine"].erase("compiler");
  write("a.json", newer);
  EXPECT_EQ(refusal(), "a.json: machine.compiler: must be there");
  write("a.json", std::string("{\"schema\": 1,\n  oops}"));
  EXPECT_TRUE(refusal().starts_with("a.json: must be JSON: parse error at line 2, column 3: "))
      << refusal();
  write("a.json", std::string());
  EXPECT_TRUE(refusal().starts_with("a.json: must be JSON: ")) << refusal();
}

TEST_F(ReadFolders, RefusesWhatIsNoNumberOfAResult) {
  Json result = json_of(record_named("aa"));
  auto& observables = result["reference"]["observables"];
  ASSERT_FALSE(observables.empty());
  const std::string name = observables.begin().key();
  observables[name]["uncertainty"] = -1;
  write("a.json", result);
  EXPECT_EQ(refusal(),
            "a.json: reference.observables." + name + ".uncertainty: must be >= 0, got -1");
  write("a.json", std::string("{\"schema\": 1e400}"));
  EXPECT_EQ(refusal(), "a.json: must be JSON: number overflow parsing '1e400'");
}

TEST_F(ReadFolders, RefusesWhatIsTooLargeOrNoFileAtOnce) {
  const fs::path file = write("a.json", std::string("{}"));
  fs::resize_file(file, std::uintmax_t{20} << 30);  // of holes
  EXPECT_EQ(refusal(), "a.json: must have at most 536870912 bytes, the limit of result files");
  fs::remove(file);
  EXPECT_EQ(refusal({"/dev/zero"}), "/dev/zero: must be a regular file");
  ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
  EXPECT_EQ(refusal({file}), "a.json: must be a regular file");
}

TEST_F(ReadFolders, SaysThatAFileIsClosed) {
  const fs::path file = write("a.json", json_of(record_named("aa")));
  fs::permissions(file, fs::perms::none);
  const AsNobody nobody(folder_);
  if (nobody.is_still_root()) GTEST_SKIP() << "root may read everything";
  EXPECT_EQ(refusal({file}), "a.json: cannot be read");
  fs::permissions(folder_, fs::perms::none);
  EXPECT_EQ(refusal(), folder_.string() + ": cannot be read: Permission denied");
  fs::permissions(folder_, fs::perms::owner_all);
}

}  // namespace
}  // namespace slipcheck::testing
