#include "studies/sweep/sweep_store.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "../support/in_folder.h"
#include "../support/refusal.h"
#include "some_store.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;
using test::fill;
using test::refusal_of;
using test::some_head;
using test::SomeRun;

class Store : public test::InFolder {
 protected:
  fs::path path() const { return folder_ / "s.db"; }

  std::string refusal(const StoreHead& head) const {
    return refusal_of<BadStore>([&] { SweepStore(path(), head); });
  }

  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
};

TEST_F(Store, WhatIsAddedIsThereWhenItOpensAgain) {
  fill(path(), {0, 3, 7});
  EXPECT_EQ(files(), 1u) << "a log is left beside the store";
  SweepStore store(path(), some_head());
  const std::vector<bool> done = store.done(false);
  ASSERT_EQ(done.size(), 10u);
  for (std::size_t run = 0; run < 10; ++run) EXPECT_EQ(done[run], run == 0 || run == 3 || run == 7);
  EXPECT_EQ(store.file().integer_of("SELECT count(*) FROM runs"), 3);
  EXPECT_EQ(store.file().integer_of("SELECT count(*) FROM observables"), 6);
  EXPECT_EQ(store.file().integer_of("SELECT count(*) FROM scenes"), 3);
  SqliteStatement rows(
      store.file(),
      "SELECT engine, rate, \"settings.erp\", median, reference, observable_verdict "
      "FROM results WHERE run = 3 AND observable = 'i.sliding_time'");
  ASSERT_TRUE(rows.step());
  EXPECT_EQ(rows.text(0), "bullet");
  EXPECT_EQ(rows.number(1), 120);
  EXPECT_EQ(rows.number(2), 0.2);
  EXPECT_EQ(rows.number(3), 0.53);
  EXPECT_EQ(rows.number(4), 0.5);
  EXPECT_EQ(rows.text(5), "deviates");
}

TEST_F(Store, OnlyWhatIsJudgedKeepsItsPhases) {
  fill(path(), {1});
  const auto file = open_store(path());
  SqliteStatement rows(*file,
                       "SELECT name, per_phase FROM observables JOIN names ON id = observable "
                       "ORDER BY name");
  ASSERT_TRUE(rows.step());
  EXPECT_EQ(rows.text(0), "i.hops");
  EXPECT_TRUE(rows.numbers(1).empty());
  ASSERT_TRUE(rows.step());
  EXPECT_EQ(rows.numbers(1), (std::vector<double>{0.51, 0.51 - 0.1, 0.51 + 0.1}));
}

TEST_F(Store, FailuresAreDoneUnlessTheyAreTriedAgain) {
  fill(path(), {0});
  fill(path(), {1}, RunStatus::crashed);
  fill(path(), {2}, RunStatus::unstable);
  SweepStore store(path(), some_head());
  EXPECT_TRUE(store.done(false)[1]);
  EXPECT_FALSE(store.done(true)[1]);
  EXPECT_TRUE(store.done(true)[2]) << "an unstable run is unstable again";
  store.add(SomeRun(1).get());
  EXPECT_EQ(store.file().integer_of("SELECT count(*) FROM runs WHERE run = 1 AND status = 'ok'"),
            1);
  EXPECT_EQ(store.statuses(), (std::map<std::string, std::size_t>{{"ok", 2}, {"unstable", 1}}));
}

TEST_F(Store, AnotherSweepProgramOrSchemaIsRefused) {
  fill(path(), {0});
  StoreHead other = some_head();
  other.digest = "abd";
  EXPECT_EQ(refusal(other), path().string() +
                                ": must be the store of this sweep, two of 10 runs, got that of "
                                "another, two of 10 runs");
  other = some_head();
  other.program = "slipcheck 2 (d)";
  EXPECT_EQ(refusal(other), path().string() +
                                ": must be a store of this slipcheck 2 (d), got one of slipcheck 1 "
                                "(c)");
  SqliteFile(path(), SqliteFile::Access::write).execute("PRAGMA user_version = 2");
  EXPECT_EQ(refusal(some_head()), path().string() + ": must be a store of schema 1, got 2");
}

TEST_F(Store, AFileOfSomebodyElseStaysAsItIs) {
  std::ofstream(path()) << "slipcheck: 1\n";
  EXPECT_EQ(refusal(some_head()), path().string() + ": must be a store of slipcheck sweep");
  EXPECT_EQ(fs::file_size(path()), 13u);
  fs::remove(path());
  std::ofstream(path()).close();
  SqliteFile(path(), SqliteFile::Access::write).execute("CREATE TABLE mine(x)");
  EXPECT_EQ(refusal(some_head()), path().string() + ": must be a store of slipcheck sweep");
  EXPECT_EQ(refusal_of<BadStore>([&] { open_store(folder_ / "none.db"); }),
            (folder_ / "none.db").string() + ": must be a readable file");
}

TEST_F(Store, TwoWritersAreOneTooMany) {
  const SweepStore store(path(), some_head());
  EXPECT_EQ(
      refusal(some_head()),
      path().string() + ": must be written by one process at a time, and another one writes it");
}

TEST_F(Store, OthersReadWhileItIsWritten) {
  SweepStore store(path(), some_head());
  store.add(SomeRun(0).get());
  const auto reader = open_store(path());
  EXPECT_EQ(reader->integer_of("SELECT count(*) FROM runs"), 1);
  store.add(SomeRun(1).get());
  EXPECT_EQ(reader->integer_of("SELECT count(*) FROM runs"), 2);
}

TEST_F(Store, AProcessThatIsKilledLosesNothingThatWasAdded) {
  const pid_t child = ::fork();
  if (child == 0) {
    SweepStore store(path(), some_head());
    for (std::uint64_t run = 0; run < 5; ++run) store.add(SomeRun(run).get());
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  SweepStore store(path(), some_head());
  EXPECT_EQ(store.file().integer_of("SELECT count(*) FROM runs"), 5);
  EXPECT_EQ(store.file().integer_of("SELECT count(*) FROM pragma_integrity_check "
                                    "WHERE integrity_check = 'ok'"),
            1);
}

TEST_F(Store, AFullDiskLosesTheRunAtHandAlone) {
  const pid_t child = ::fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    SweepStore store(path(), some_head());
    store.add(SomeRun(0).get());
    const rlimit limit{40'000, 40'000};  // of a file; the log holds a run or two in that
    ::setrlimit(RLIMIT_FSIZE, &limit);
    std::uint64_t run = 1;
    try {
      for (; run < 10; ++run) store.add(SomeRun(run).get());
    } catch (const SqliteFailure&) {
      ::_exit(static_cast<int>(run));
    }
    ::_exit(100);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  const int added = WEXITSTATUS(status);
  ASSERT_LT(added, 10);
  SweepStore store(path(), some_head());
  EXPECT_EQ(store.file().integer_of("SELECT count(*) FROM runs"), added);
  store.add(SomeRun(9).get());
  EXPECT_EQ(store.file().integer_of("SELECT count(*) FROM observables"), 2 * (added + 1));
}

}  // namespace
}  // namespace slipcheck
