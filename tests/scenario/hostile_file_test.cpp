#include <fmt/format.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "../support/as_nobody.h"
#include "../support/cpu_time.h"
#include "../support/in_folder.h"
#include "scenario/file_text.h"
#include "scenes.h"

// Files that are no scenes: each is refused with one clear sentence, at once.

namespace slipcheck {
namespace {

namespace fs = std::filesystem;
using namespace testing;

class HostileFile : public test::InFolder {
 protected:
  ~HostileFile() override { EXPECT_LT(took_(), 5 * test::kSlower); }

  fs::path path(const std::string& name) const { return folder_ / name; }
  fs::path write(const std::string& text) const {
    std::ofstream(path("s.yaml"), std::ios::binary) << text;
    return path("s.yaml");
  }
  /// The rules that the file breaks.
  static std::string refusal(const fs::path& file) {
    const auto faults = test::faults_of([&] { load_scenario(file); });
    if (faults.empty()) return "";
    EXPECT_EQ(faults.size(), 1u);
    EXPECT_EQ(faults[0].file, file.string());
    return faults[0].rule;
  }

 private:
  test::CpuTime took_;
};

TEST_F(HostileFile, NotThere) {
  EXPECT_EQ(refusal(path("none.yaml")), "must be a readable file: No such file or directory");
}
TEST_F(HostileFile, Directory) {
  EXPECT_EQ(refusal(path(".")), "must be a file, but is a directory");
}
TEST_F(HostileFile, Fifo) {
  ASSERT_EQ(mkfifo(path("fifo").c_str(), 0600), 0);
  EXPECT_EQ(refusal(path("fifo")), "must be a regular file");
}
TEST_F(HostileFile, Device) { EXPECT_EQ(refusal("/dev/zero"), "must be a regular file"); }
TEST_F(HostileFile, Unreadable) {
  chmod(write(kHard).c_str(), 0);
  const testing::AsNobody nobody(path("."));
  if (nobody.is_still_root()) GTEST_SKIP() << "root may read everything, and cannot be left";
  EXPECT_EQ(refusal(path("s.yaml")), "must be a readable file: Permission denied");
}
TEST_F(HostileFile, Huge) {
  fs::resize_file(write("slipcheck: 1"), 100'000'000);
  EXPECT_EQ(refusal(path("s.yaml")), "must have at most 1048576 bytes");
}
TEST_F(HostileFile, Empty) {
  EXPECT_EQ(refusal(write("")), "must hold a scene, but is empty");
  EXPECT_EQ(refusal(write("# nothing\n\n")), "must hold a scene, but is empty");
  EXPECT_EQ(refusal(write("---\n")), "must hold a scene, but is empty");
}
TEST_F(HostileFile, Binary) {
  EXPECT_EQ(refusal(write(std::string("slip\0check", 10))),
            "must be text, got control character 0x00");
  EXPECT_EQ(refusal(write("\x7f\x45LF")), "must be text, got control character 0x7f");
  EXPECT_EQ(refusal(write("a: \xff\xfe")), "must be UTF-8 text, got byte 0xff");
  EXPECT_EQ(refusal(write("a: \xc0\x80")), "must be UTF-8 text, got byte 0xc0");
  EXPECT_EQ(refusal(write("a: \xed\xa0\x80")), "must be UTF-8 text, got byte 0xed");
  EXPECT_EQ(refusal(write("a: \xe2\x82")), "must be UTF-8 text, got byte 0xe2");
}
TEST_F(HostileFile, NoYaml) {
  const auto fault = messages("a: [1, 2\nb: 3\n");
  ASSERT_EQ(fault.size(), 1u);
  EXPECT_EQ(fault[0].substr(0, 24), "s.yaml:2:2: must be YAML");
}
TEST_F(HostileFile, SeveralDocuments) {
  EXPECT_EQ(refusal(write(kHard + "---\n" + kHard)), "a file holds one scene, one YAML document");
}
TEST_F(HostileFile, Tags) {
  EXPECT_EQ(refusal(write(with(kHard, "title: ", "title: !!python/object:os.system "))),
            "YAML tags have no meaning here, got tag:yaml.org,2002:python/object:os.system");
}
TEST_F(HostileFile, AliasBomb) {
  std::string text = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 60; ++i) {
    text += fmt::format("a{0}: &a{0} [", i);
    for (int j = 0; j < 10; ++j) text += fmt::format("{}*a{}", j > 0 ? ", " : "", i - 1);
    text += "]\n";
  }
  EXPECT_EQ(refusal(write(text)),
            "a scene must have at most 300000 YAML nodes with its aliases written out");
}
TEST_F(HostileFile, AliasOfItself) {
  EXPECT_EQ(refusal(write("a: &a [1, *a]\n")), "an alias must not stand inside of what it names");
}
TEST_F(HostileFile, ChainOfAliases) {
  std::string text = "a0: &a0 [x]\n";
  for (int i = 1; i < 5000; ++i) {
    text += fmt::format("a{0}: &a{0} [*a{1}]\n", i, i - 1);
  }
  EXPECT_EQ(refusal(write(text)), "a scene must be nested at most 64 levels deep");
}
TEST_F(HostileFile, DeepNesting) {
  const std::string rule = "a scene must be nested at most 64 levels deep";
  EXPECT_EQ(refusal(write(std::string(500'000, '['))), rule);
  EXPECT_EQ(refusal(write("{a: " + std::string(500'000, '{'))), rule);
  std::string dashes;
  for (int i = 0; i < 100'000; ++i) dashes += "- ";
  EXPECT_EQ(refusal(write(dashes)), rule);
}
TEST_F(HostileFile, ManyFaultsAreCutShort) {
  std::string text = kHard;
  for (int i = 0; i < 20'000; ++i) text += fmt::format("k{}: 1\n", i);
  const auto faults = test::faults_of([&] { load_scenario(write(text)); });
  ASSERT_EQ(faults.size(), 1001u);
  EXPECT_EQ(faults.back().rule, "has more faults, which are not listed");
}
TEST_F(HostileFile, ManyBodies) {
  // As many as fit: within the limits, and quick.
  std::string text = kHard.substr(0, kHard.find("  - {name: a"));
  for (int i = 0; i < 9'000; ++i) {
    text += fmt::format(
        "  - {{name: n{}, material: steel, sphere: {{radius: 0.1}}, position: [{}, {}]}}\n", i,
        i % 100, i / 100);
  }
  text += "run: {until: rest}\n";
  EXPECT_EQ(load_scenario(write(text)).bodies.size(), 9'000u);
}

}  // namespace
}  // namespace slipcheck
