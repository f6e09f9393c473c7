#include "studies/sweep/store_query.h"

#include <gtest/gtest.h>

#include "../support/in_folder.h"
#include "../support/refusal.h"
#include "some_store.h"

namespace slipcheck {
namespace {

using test::fill;
using test::refusal_of;

class Query : public test::InFolder {
 protected:
  Query() {
    fill(folder_ / "s.db", {0, 1, 2, 3});
    fill(folder_ / "s.db", {4}, RunStatus::unstable);
  }

  QueryResult result(const StoreQuery& query) const {
    return query_store(*open_store(folder_ / "s.db"), query);
  }
  std::size_t count(std::vector<std::string> filters) const {
    StoreQuery query;
    query.filters = std::move(filters);
    return result(query).found;
  }
  std::string refusal(StoreQuery query) const {
    return refusal_of<BadQuery>([&] { result(query); });
  }
};

TEST_F(Query, FiltersHoldTogether) {
  EXPECT_EQ(count({}), 5u);
  EXPECT_EQ(count({"status=ok"}), 4u);
  EXPECT_EQ(count({"status!=ok"}), 1u);
  EXPECT_EQ(count({"status=ok,unstable"}), 5u);
  EXPECT_EQ(count({"rate>=120"}), 2u);
  EXPECT_EQ(count({"rate<120", "status=ok"}), 2u);
  EXPECT_EQ(count({"settings.erp=0.2", "engine=bullet"}), 5u);
  EXPECT_EQ(count({"i.sliding_time>0.515"}), 2u);
  EXPECT_EQ(count({"i.sliding_time.max<=0.61"}), 2u);
}

TEST_F(Query, ColumnsAreThoseOfRunsAndStatisticsOfObservables) {
  StoreQuery query;
  query.columns = {"run", "gravity", "i.sliding_time", "i.sliding_time.reference"};
  query.sort = "-i.sliding_time";
  query.limit = 1;
  const QueryResult found = result(query);
  EXPECT_EQ(found.found, 5u);
  ASSERT_EQ(found.rows.size(), 1u);
  EXPECT_EQ(found.rows[0][0], SqliteValue(std::int64_t{3}));
  EXPECT_EQ(found.rows[0][1], SqliteValue(9.81));
  EXPECT_EQ(found.rows[0][2], SqliteValue(0.53));
  EXPECT_EQ(found.rows[0][3], SqliteValue(0.5));
  EXPECT_EQ(found.columns[1].unit, "m/s2");
  EXPECT_EQ(found.columns[2].unit, "s");
}

TEST_F(Query, UnlessToldWhatVariesAndWhatIsJudged) {
  std::string names;
  for (const QueryColumn& column : result({}).columns) names += column.name + ' ';
  EXPECT_EQ(names,
            "run gravity rate settings.erp engine status i.sliding_time i.sliding_time.error ");
}

TEST_F(Query, LongRowsAreObservablesOrPhases) {
  StoreQuery query;
  query.rows = StoreQuery::Rows::observables;
  EXPECT_EQ(result(query).found, 8u);
  query.filters = {"observable=i.hops"};
  EXPECT_EQ(result(query).found, 4u);
  query.filters.clear();
  query.rows = StoreQuery::Rows::phases;
  const QueryResult phases = result(query);
  ASSERT_EQ(phases.found, 12u);
  const std::size_t last = phases.columns.size();
  EXPECT_EQ(phases.columns[last - 3].name, "value");
  EXPECT_EQ(phases.rows[1][last - 4], SqliteValue(std::int64_t{1}));
  EXPECT_EQ(phases.rows[1][last - 3], SqliteValue(0.4));
}

TEST_F(Query, WhatIsNotThereIsToldOf) {
  StoreQuery query;
  query.filters = {"rat>3"};
  EXPECT_EQ(refusal(query), "must be a column of the store (did you mean rate?), got rat");
  query.filters = {"rate"};
  EXPECT_EQ(refusal(query),
            "must be a column, one of = != < <= > >=, and a value, as in rate>=240, got rate");
  query.filters = {"rate<1,2"};
  EXPECT_EQ(refusal(query), "must compare with one value, got rate<1,2");
  query.filters = {};
  query.columns = {"i.sliding_time.median; DROP TABLE runs"};
  EXPECT_NE(refusal(query), "");
}

}  // namespace
}  // namespace slipcheck
