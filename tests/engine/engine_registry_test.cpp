#include "engine/engine_registry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "../support/in_folder.h"
#include "base/folder.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

class EngineRegistryTest : public test::InFolder {
 protected:
  void SetUp() override {
    fs::create_directories(folder_ / "a");
    fs::create_directories(folder_ / "b");
  }

  fs::path put(const fs::path& name, fs::perms perms = fs::perms::owner_all) {
    const fs::path path = folder_ / name;
    std::ofstream(path) << "#!/bin/sh\n";
    fs::permissions(path, perms);
    return path;
  }
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
  fs::create_directories(folder_ / "b" / "slipcheck-engine-folder-double");

  const auto engines = find_engines({folder_ / "a", folder_ / "missing", folder_ / "b"});
  ASSERT_EQ(engines.size(), 3u);
  EXPECT_EQ(engines[0].engine, "bullet");
  EXPECT_EQ(engines[0].precision, "single");
  EXPECT_EQ(engines[0].command.program, bullet);
  EXPECT_EQ(engines[1].engine, "my-own");
  EXPECT_EQ(engines[1].command.program, hyphens);
  EXPECT_EQ(engines[2].command.program, ode);
  EXPECT_TRUE(find_engine("ode", "double", find_engines({folder_ / "a"})).has_value());
  EXPECT_FALSE(find_engine("ode", "single", find_engines({folder_ / "a"})).has_value());
}

TEST_F(EngineRegistryTest, AFolderIsReadByNameOrSaysWhyNot) {
  fs::create_directories(folder_ / "d" / "below");
  const fs::path file = put("d/b", fs::perms::owner_read);
  put("d/.a", fs::perms::owner_read);
  std::error_code error = std::make_error_code(std::errc::io_error);
  EXPECT_EQ(entries_of(folder_ / "d", error),
            (std::vector{folder_ / "d" / ".a", file, folder_ / "d" / "below"}));
  EXPECT_FALSE(error);
  EXPECT_TRUE(entries_of(file, error).empty());
  EXPECT_EQ(error, std::errc::not_a_directory);
  EXPECT_TRUE(entries_of(folder_ / "missing", error).empty());
  EXPECT_EQ(error, std::errc::no_such_file_or_directory);
}

TEST_F(EngineRegistryTest, TheEnvironmentComesBeforeTheProgramsOwnFolder) {
  const std::string path = (folder_ / "b").string() + "::" + (folder_ / "a").string();
  setenv("SLIPCHECK_ENGINE_PATH", path.c_str(), 1);
  const auto directories = engine_directories();
  unsetenv("SLIPCHECK_ENGINE_PATH");
  ASSERT_EQ(directories.size(), 4u);
  EXPECT_EQ(directories[0], folder_ / "b");
  EXPECT_EQ(directories[1], folder_ / "a");
  EXPECT_TRUE(fs::exists(directories[2] / "engine_tests"));
  EXPECT_EQ(directories[3], directories[2].parent_path() / "libexec" / "slipcheck");
}

TEST(EngineRegistry, VersionsCompareNumberByNumber) {
  for (const auto& [older, newer] : {std::pair{"0.9.0", "0.11.0"},
                                     {"0.19.3", "0.21.0"},
                                     {"1.0", "1.0.1"},
                                     {"0.8.0-alpha.2", "0.8.0"},
                                     {"0.8.0-alpha.0", "0.8.0-alpha.2"}}) {
    EXPECT_TRUE(is_older_version(older, newer)) << older << ' ' << newer;
    EXPECT_FALSE(is_older_version(newer, older)) << older << ' ' << newer;
    EXPECT_FALSE(is_older_version(older, older)) << older;
  }
  EXPECT_EQ(engine_family("rapier@0.19.3"), "rapier");
  EXPECT_EQ(engine_version("rapier@0.19.3"), "0.19.3");
  EXPECT_EQ(engine_family("bullet"), "bullet");
  EXPECT_EQ(engine_version("bullet"), "");
}

TEST(EngineRegistry, AnEngineWithoutAVersionIsTheNewest) {
  const auto engine = [](const char* name) { return EngineExecutable{name, "single", {}, {}, {}}; };
  const std::vector<EngineExecutable> all = {engine("ode"), engine("rapier@0.9.0"),
                                             engine("rapier@0.11.0")};
  EXPECT_EQ(find_engine("rapier", "single", all).value().engine, "rapier@0.11.0");
  EXPECT_EQ(find_engine("rapier@0.9.0", "single", all).value().engine, "rapier@0.9.0");
  EXPECT_EQ(find_engine("ode", "single", all).value().engine, "ode");
  EXPECT_FALSE(find_engine("rapier", "double", all));
  EXPECT_FALSE(find_engine("rapier@0.10.0", "single", all));
}

TEST(EngineRegistry, KnownEnginesAreSortedAndTellWhatTheyTake) {
  const std::vector<KnownEngine> known = known_engines();
  EXPECT_TRUE(std::ranges::is_sorted(known, {}, &KnownEngine::name));
  const auto from = [&](const std::string& name) {
    const auto found = std::ranges::find(known, name, &KnownEngine::name);
    return found == known.end() ? "unknown" : found->from;
  };
  EXPECT_EQ(from("ode"), "Debian package libode-dev");
  EXPECT_EQ(from("bullet"), "Debian package libbullet-dev");
  EXPECT_EQ(from("rapier"), "slipcheck engines add rapier");
  // In the folder of the tests' own engine there is that one alone.
  setenv("SLIPCHECK_ENGINE_PATH", SLIPCHECK_BINARY_DIR "/faulty", 1);
  EXPECT_EQ(not_installed_text("faulty", "single"),
            "faulty (single) is not installed, but double precision is");
  EXPECT_EQ(not_installed_text("ode", "double"),
            "ode (double) is not installed: Debian package libode-dev");
  EXPECT_EQ(
      not_installed_text("rapier@0.19.3", "single"),
      "rapier@0.19.3 (single) is not installed: slipcheck engines add rapier@0.19.3 may have it");
}

}  // namespace
}  // namespace slipcheck
