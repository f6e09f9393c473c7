#include "engine/engine_registry.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

class EngineRegistryTest : public ::testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::temp_directory_path() / ("slipcheck-registry-" + std::to_string(getpid()));
    fs::create_directories(root_ / "a");
    fs::create_directories(root_ / "b");
  }
  void TearDown() override { fs::remove_all(root_); }

  fs::path put(const fs::path& name, fs::perms perms = fs::perms::owner_all) {
    const fs::path path = root_ / name;
    std::ofstream(path) << "#!/bin/sh\n";
    fs::permissions(path, perms);
    return path;
  }

  fs::path root_;
};

TEST_F(EngineRegistryTest, FindsWhatIsNamedLikeAnEngineSortedAndFirstDirectoryFirst) {
  const fs::path ode = put("a/slipcheck-engine-ode-double");
  const fs::path bullet = put("a/slipcheck-engine-bullet-single");
  put("b/slipcheck-engine-bullet-single");
  const fs::path hyphens = put("b/slipcheck-engine-my-own-double");
  put("b/slipcheck-engine-ode-half");
  put("b/slipcheck-engine--double");
  put("b/slipcheck-engine-double");
  put("b/slipcheck");
  put("b/slipcheck-engine-plain-double", fs::perms::owner_read);
  fs::create_directories(root_ / "b" / "slipcheck-engine-folder-double");

  const auto engines = find_engines({root_ / "a", root_ / "missing", root_ / "b"});
  ASSERT_EQ(engines.size(), 3u);
  EXPECT_EQ(engines[0].engine, "bullet");
  EXPECT_EQ(engines[0].precision, "single");
  EXPECT_EQ(engines[0].path, bullet);
  EXPECT_EQ(engines[1].engine, "my-own");
  EXPECT_EQ(engines[1].path, hyphens);
  EXPECT_EQ(engines[2].path, ode);
  EXPECT_TRUE(find_engine("ode", "double", {root_ / "a"}).has_value());
  EXPECT_FALSE(find_engine("ode", "single", {root_ / "a"}).has_value());
}

TEST_F(EngineRegistryTest, TheEnvironmentComesBeforeTheProgramsOwnFolder) {
  const std::string path = (root_ / "b").string() + "::" + (root_ / "a").string();
  setenv("SLIPCHECK_ENGINE_PATH", path.c_str(), 1);
  const auto directories = engine_directories();
  unsetenv("SLIPCHECK_ENGINE_PATH");
  ASSERT_EQ(directories.size(), 4u);
  EXPECT_EQ(directories[0], root_ / "b");
  EXPECT_EQ(directories[1], root_ / "a");
  EXPECT_TRUE(fs::exists(directories[2] / "test_engine"));
  EXPECT_EQ(directories[3], directories[2].parent_path() / "libexec" / "slipcheck");
}

TEST(EngineRegistry, KnownEnginesAreSorted) {
  EXPECT_TRUE(std::is_sorted(known_engines().begin(), known_engines().end()));
  EXPECT_NE(std::find(known_engines().begin(), known_engines().end(), "bullet"),
            known_engines().end());
}

}  // namespace
}  // namespace slipcheck
