#include "studies/baseline/update.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "../support/in_folder.h"
#include "../support/refusal.h"
#include "baselines.h"
#include "studies/baseline/baseline_json.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

using testing::meeting;
using testing::meeting_baseline;

const fs::path kFolder = "baselines";

TEST(Update, WhatDiffersInTimesAndSlipchecksVersionAloneStays) {
  SceneRecord scene = meeting();
  scene.reference.cpu_seconds *= 2;
  scene.runs[0].cpu_seconds *= 3;
  const BaselineUpdate update =
      update_of(kFolder, {{"meeting", meeting_baseline()}}, {baseline_of(scene, 4, "0.2.0")}, true);
  EXPECT_TRUE(update.empty());
  EXPECT_EQ(update.unchanged, 1u);
}

TEST(Update, TheLastBitMakesANewBaseline) {
  SceneRecord scene = meeting();
  scene.reference.observables["i.sliding_time"].value = 0.020000000000000004;
  const SceneBaseline now = baseline_of(scene, 4, "0.2.0");
  const BaselineUpdate update = update_of(kFolder, {{"meeting", meeting_baseline()}}, {now}, true);
  EXPECT_EQ(update.changed, std::vector<std::string>{"meeting"});
  ASSERT_EQ(update.files.size(), 1u);
  EXPECT_EQ(update.files.begin()->first, kFolder / "meeting.json");
  EXPECT_EQ(update.files.begin()->second, baseline_text(now));
}

TEST(Update, ScenesComeAndGoOnlyWhereAllAreThere) {
  SceneBaseline now = meeting_baseline();
  now.scene = "other";
  const std::map<std::string, SceneBaseline> old = {{"meeting", meeting_baseline()}};
  const BaselineUpdate all = update_of(kFolder, old, {now}, true);
  EXPECT_EQ(all.added, std::vector<std::string>{"other"});
  EXPECT_EQ(all.removed, std::vector<std::string>{"meeting"});
  EXPECT_EQ(all.left_over, std::vector<fs::path>{kFolder / "meeting.json"});
  EXPECT_TRUE(update_of(kFolder, old, {now}, false).left_over.empty());
}

using LoadBaselines = test::InFolder;

TEST_F(LoadBaselines, ByScene) {
  EXPECT_TRUE(load_baselines(folder_ / "none").empty());
  std::ofstream(folder_ / "meeting.json") << baseline_text(meeting_baseline());
  EXPECT_EQ(load_baselines(folder_).size(), 1u);
  EXPECT_EQ(load_baselines(folder_, {"meeting", "none"}).size(), 1u);
  std::ofstream(folder_ / "broken.json") << "{";
  EXPECT_EQ(load_baselines(folder_, {"meeting"}).size(), 1u);
  EXPECT_THROW(load_baselines(folder_), BadJson);
}

TEST_F(LoadBaselines, DoesNotWaitForAPipe) {
  const fs::path file = folder_ / "meeting.json";
  ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
  EXPECT_EQ(test::refusal_of<BadJson>([&] { load_baselines(folder_, {"meeting"}); }),
            file.string() + ": must be a regular file");
}

}  // namespace
}  // namespace slipcheck
