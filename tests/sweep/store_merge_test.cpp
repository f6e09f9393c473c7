#include "studies/sweep/store_merge.h"

#include <gtest/gtest.h>

#include "../support/in_folder.h"
#include "../support/refusal.h"
#include "some_store.h"
#include "studies/sweep/store_query.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;
using test::fill;
using test::refusal_of;
using test::some_head;

class Merge : public test::InFolder {
 protected:
  fs::path at(const char* name) const { return folder_ / name; }

  static std::vector<std::vector<SqliteValue>> rows_of(const fs::path& path) {
    StoreQuery query;
    query.rows = StoreQuery::Rows::observables;
    return query_store(*open_store(path), query).rows;
  }
};

TEST_F(Merge, ShardsMakeTheStoreOfASingleSweep) {
  fill(at("all.db"), {0, 1, 2, 3, 4});
  fill(at("a.db"), {3, 4});
  fill(at("b.db"), {2, 0, 1});
  const MergedStores merged = merge_stores(at("m.db"), {at("a.db"), at("b.db")});
  EXPECT_EQ(merged.taken, 5u);
  EXPECT_EQ(merged.runs, 5u);
  EXPECT_EQ(merged.total, 10u);
  EXPECT_EQ(rows_of(at("m.db")).size(), 10u);
  EXPECT_EQ(rows_of(at("m.db")), rows_of(at("all.db")));
}

TEST_F(Merge, OnceMoreChangesNothing) {
  fill(at("a.db"), {3, 4});
  merge_stores(at("m.db"), {at("a.db")});
  const auto before = rows_of(at("m.db"));
  EXPECT_EQ(merge_stores(at("m.db"), {at("a.db"), at("a.db")}).taken, 0u);
  EXPECT_EQ(rows_of(at("m.db")), before);
}

TEST_F(Merge, WhatCameOffWellCountsBeforeWhatFailed) {
  fill(at("failed.db"), {3}, RunStatus::timed_out);
  fill(at("well.db"), {3});
  for (const bool failed_first : {true, false}) {
    const fs::path into = at(failed_first ? "x.db" : "y.db");
    merge_stores(into, failed_first ? std::vector{at("failed.db"), at("well.db")}
                                    : std::vector{at("well.db"), at("failed.db")});
    EXPECT_EQ(open_store(into)->integer_of("SELECT count(*) FROM runs WHERE status = 'ok'"), 1);
    EXPECT_EQ(rows_of(into), rows_of(at("well.db")));
  }
}

TEST_F(Merge, StoresOfDifferentSweepsAreRefusedAndNothingIsWritten) {
  fill(at("a.db"), {3});
  StoreHead other = some_head();
  other.digest = "other";
  { SweepStore store(at("b.db"), other); }
  EXPECT_EQ(refusal_of<BadStore>([&] {
              merge_stores(at("m.db"), {at("a.db"), at("b.db")});
            }),
            at("b.db").string() + ": must be a store of the same sweep as " + at("a.db").string() +
                ", two of 10 runs, got that of another, two of 10 runs");
  EXPECT_FALSE(fs::exists(at("m.db")));
  EXPECT_EQ(refusal_of<BadStore>([&] { merge_stores(at("a.db"), {at("a.db")}); }),
            at("a.db").string() + ": must not be among the stores that are put into it");
}

}  // namespace
}  // namespace slipcheck
