// Engines that npm brings, with an npm and a Node.js of the test's own: nothing of it needs the
// network.

#include "engine/npm_engines.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>

#include "../support/in_folder.h"
#include "../support/refusal.h"
#include "../support/text_of.h"
#include "engine/npm_install.h"
#include "engine/remote_engine.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

/// A variable of the environment for as long as this lives.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    setenv(name, value.c_str(), 1);
  }
  ~Variable() {
    if (old_)
      setenv(name_, old_->c_str(), 1);
    else
      unsetenv(name_);
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> old_;
};

class NpmEnginesTest : public test::InFolder {
 protected:
  NpmEnginesTest()
      : path_("PATH", (folder_ / "bin").string() + ":" + std::getenv("PATH")),
        workers_("SLIPCHECK_ENGINE_PATH", (folder_ / "workers").string()),
        engines_("SLIPCHECK_ENGINES", (folder_ / "engines").string()) {
    write("workers/node/catalog.json", R"({"ball": {"package": "@balls/ball3d",
      "versions": ">=0.9.0 <2.0.0", "default": "1.0.0", "precision": "single",
      "also": {"cbor-x": "1.6.0"}, "node": 18, "about": "balls"}})");
    write("workers/node/profiles/ball/default.yaml",
          "slipcheck-profile: 1\nengine: ball\nname: default\n");
    // Speaks the protocol, whatever it is told to run.
    program("node", fmt::format("exec {}\n", (fs::read_symlink("/proc/self/exe").parent_path() /
                                              "faulty/slipcheck-engine-faulty-double")
                                                 .string()));
    // Knows versions 1.0.0 and 0.9.0, and writes down how it was called.
    program("npm", R"sh(echo "$@" >> npm-calls
[ "$1" != view ] || { echo '["0.9.0", "1.0.0", "2.0.0-rc.1"]'; exit; }
if ! grep -q '"@balls/ball3d": "\(1.0.0\|0.9.0\)"' package.json; then
  echo 'npm error code ETARGET' >&2
  echo 'npm error notarget No matching version found' >&2
  exit 1
fi
mkdir -p node_modules/@balls/ball3d
echo '{}' > package-lock.json
)sh");
  }

  void write(const fs::path& file, const std::string& text) {
    fs::create_directories((folder_ / file).parent_path());
    std::ofstream(folder_ / file) << text;
  }
  void program(const std::string& name, const std::string& script) {
    write("bin/" + name, "#!/bin/sh\n" + script);
    fs::permissions(folder_ / "bin" / name, fs::perms::owner_all);
  }
  std::string read(const fs::path& file) const { return test::text_of(folder_ / file); }
  /// All that there is where engines are installed, hidden or not.
  std::vector<std::string> installed() const {
    std::vector<std::string> names;
    if (!fs::exists(folder_ / "engines")) return names;
    for (const auto& entry : fs::directory_iterator(folder_ / "engines"))
      names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
  }
  static std::string refusal_of(const std::string& name) {
    try {
      install_engine(npm_choice(name));
    } catch (const NotInstalled& fault) {
      return fault.what();
    }
    return "installed";
  }

  Variable path_, workers_, engines_;
};

TEST_F(NpmEnginesTest, ACatalogueThatIsNoFileIsRefusedAndNotWaitedFor) {
  const fs::path file = folder_ / "workers/node/catalog.json";
  fs::remove(file);
  ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
  EXPECT_EQ(test::refusal_of<BadJson>([] { npm_engines(); }),
            file.string() + ": must be a regular file");
}

TEST_F(NpmEnginesTest, AnEngineIsInstalledInAVersionIntoAFolderOfItsOwnAndFound) {
  const EngineExecutable ball = install_engine(npm_choice("ball@0.9.0"));
  EXPECT_EQ(ball.engine, "ball@0.9.0");
  EXPECT_EQ(ball.precision, "single");
  install_engine(npm_choice("ball"));
  EXPECT_EQ(installed(), (std::vector<std::string>{"ball@0.9.0", "ball@1.0.0"}));
  EXPECT_NE(read("engines/ball@0.9.0/package.json").find(R"("cbor-x": "1.6.0")"),
            std::string::npos);

  const std::string calls = read("engines/ball@0.9.0/npm-calls");
  EXPECT_TRUE(calls.starts_with("install --ignore-scripts")) << calls;

  const auto newest = find_engine("ball", "single");
  ASSERT_TRUE(newest);
  EXPECT_EQ(newest->engine, "ball@1.0.0");
  const auto older = find_engine("ball@0.9.0", "single");
  ASSERT_TRUE(older);
  EXPECT_EQ(older->profiles, folder_ / "workers/node/profiles/ball");
  EXPECT_EQ(older->command.program, "node");
  EXPECT_EQ(older->command.arguments,
            (std::vector<std::string>{(folder_ / "workers/node/main.mjs").string(), "ball",
                                      (folder_ / "engines/ball@0.9.0").string()}));
  EXPECT_FALSE(find_engine("ball@1.1.0", "single"));
}

TEST_F(NpmEnginesTest, WhatIsThereStaysAsItIs) {
  install_engine(npm_choice("ball"));
  write("engines/ball@1.0.0/mine", "");
  install_engine(npm_choice("ball"));
  EXPECT_TRUE(fs::exists(folder_ / "engines/ball@1.0.0/mine"));
}

TEST_F(NpmEnginesTest, ALockFileBesideTheWorkersIsKeptTo) {
  write("workers/node/locks/ball@1.0.0.json", "{\"lockfileVersion\": 3}");
  program("npm", "[ \"$1\" = install ] && cp package-lock.json seen && mkdir node_modules\n");
  install_engine(npm_choice("ball@1.0.0"));
  EXPECT_EQ(read("engines/ball@1.0.0/seen"), "{\"lockfileVersion\": 3}");
}

TEST_F(NpmEnginesTest, AVersionThatDoesNotExistNamesThoseThatDo) {
  EXPECT_EQ(refusal_of("ball@1.7.0"),
            "ball@1.7.0: there is no version 1.7.0 of @balls/ball3d; there are 0.9.0, 1.0.0");
  EXPECT_EQ(installed(), std::vector<std::string>());
}

TEST_F(NpmEnginesTest, WithoutNetworkItSaysSo) {
  program("npm", "echo 'npm error code EAI_AGAIN' >&2; exit 1\n");
  const std::string refusal = refusal_of("ball");
  EXPECT_NE(refusal.find("EAI_AGAIN"), std::string::npos) << refusal;
  EXPECT_NE(refusal.find("needs the network"), std::string::npos) << refusal;
  EXPECT_EQ(installed(), std::vector<std::string>());
}

TEST_F(NpmEnginesTest, WithoutNpmItSaysWhatToInstall) {
  fs::remove(folder_ / "bin/npm");
  const Variable path("PATH", (folder_ / "bin").string());
  const std::string refusal = refusal_of("ball");
  EXPECT_NE(refusal.find("install nodejs and npm"), std::string::npos) << refusal;
}

TEST_F(NpmEnginesTest, AWorkerThatDoesNotStartLeavesNothingBehind) {
  program("node", "echo 'SyntaxError: too old' >&2; exit 1\n");
  const std::string refusal = refusal_of("ball");
  EXPECT_NE(refusal.find("SyntaxError: too old"), std::string::npos) << refusal;
  EXPECT_NE(refusal.find("needs Node.js 18"), std::string::npos) << refusal;
  EXPECT_EQ(installed(), std::vector<std::string>());
}

TEST_F(NpmEnginesTest, NamesAreChecked) {
  EXPECT_EQ(refusal_of("bal"),
            "bal is none of the engines that npm brings, ball (did you mean ball?)");
  for (const char* name : {"ball@", "ball@1", "ball@latest", "ball@1.0.0/../../x", "ball@^1.0.0"})
    EXPECT_NE(refusal_of(name).find("a version must be three numbers as in ball@1.0.0"),
              std::string::npos)
        << name;
}

TEST_F(NpmEnginesTest, RemovedIsRemoved) {
  install_engine(npm_choice("ball"));
  remove_engine(npm_choice("ball@1.0.0"));
  EXPECT_EQ(installed(), std::vector<std::string>());
  EXPECT_THROW(remove_engine(npm_choice("ball@1.0.0")), NotInstalled);
}

}  // namespace
}  // namespace slipcheck
