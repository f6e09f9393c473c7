#include "studies/tuning/tuning_journal.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "../support/refusal.h"
#include "../support/text_of.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

const std::string kQuestion = R"({"scene":"a","rate":240.0})";
const TuningJournal::Answer kAnswer{
    {1.0 / 3, "i.sliding_time", 0.1, 1.0 / 16, 1e-300, 0.7, "crashed: \"signal 9\""}, 0.25};

struct Journal : testing::Test {
  fs::path file = fs::path(testing::TempDir()) /
                  (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) +
                   std::to_string(getpid()) + ".journal");
  ~Journal() override { fs::remove(file); }

  std::string refusal() const {
    return test::refusal_of<BadJournal>([&] { const TuningJournal journal(file); });
  }
};

TEST_F(Journal, ReadsBackWhatWasWritten) {
  {
    TuningJournal journal(file);
    EXPECT_EQ(journal.find(kQuestion), nullptr);
    journal.add({{kQuestion, kAnswer}});
    ASSERT_NE(journal.find(kQuestion), nullptr);
  }
  const TuningJournal again(file);
  ASSERT_NE(again.find(kQuestion), nullptr);
  EXPECT_EQ(*again.find(kQuestion), kAnswer);
  EXPECT_EQ(again.size(), 1u);
}

TEST_F(Journal, IsOneObjectALineWithItsFieldsInOrder) {
  const std::string text =
      "{\"slipcheck-tuning-journal\":1}\n"
      "{\"question\":{\"scene\":\"a\",\"rate\":240.0},\"answer\":{\"worst\":0.5,"
      "\"observable\":\"i.sliding_time\",\"deviation\":0.125,\"failed\":0.0625,"
      "\"cpu_seconds\":1e-300,\"simulated_seconds\":0.75,\"reason\":\"crashed: \\\"signal 9\\\"\","
      "\"seconds\":0.25}}\n";
  const TuningJournal::Answer answer{
      {0.5, "i.sliding_time", 0.125, 0.0625, 1e-300, 0.75, "crashed: \"signal 9\""}, 0.25};
  std::ofstream(file) << text;
  ASSERT_NE(TuningJournal(file).find(kQuestion), nullptr);
  EXPECT_EQ(*TuningJournal(file).find(kQuestion), answer);

  fs::remove(file);
  { TuningJournal(file).add({{kQuestion, answer}}); }
  EXPECT_EQ(test::text_of(file), text);
}

TEST_F(Journal, RefusesAFileThatIsNone) {
  std::ofstream(file) << "slipcheck: 1\nname: a\n";
  EXPECT_NE(refusal().find("must be a journal of slipcheck tune"), std::string::npos);
  // and leaves it as it was
  EXPECT_EQ(fs::file_size(file), 21u);
}

TEST_F(Journal, TellsTheLineThatIsNoEntry) {
  { TuningJournal(file).add({{kQuestion, kAnswer}}); }
  std::ofstream(file, std::ios::app) << "{\"question\":{}}\n";
  EXPECT_NE(refusal().find("line 3 is no entry"), std::string::npos);
  std::ofstream(file) << "{\"slipcheck-tuning-journal\":1}\n"
                         "{\"question\":{},\"answer\":{\"worst\":\"much\"}}\n";
  EXPECT_NE(refusal().find("line 2 is no entry of a journal: answer: worst: must be a number"),
            std::string::npos);
}

TEST_F(Journal, IsWrittenByOneProcessAtATime) {
  const TuningJournal journal(file);
  EXPECT_NE(refusal().find("another process writes it"), std::string::npos);
}

TEST_F(Journal, CannotBeMadeInADirectoryThatIsNotThere) {
  file = fs::path(testing::TempDir()) / "none" / "x.journal";
  EXPECT_NE(refusal().find("No such file"), std::string::npos);
}

}  // namespace
}  // namespace slipcheck
