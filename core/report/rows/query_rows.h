#pragma once

#include <string>

#include "report/rows/text_table.h"
#include "studies/sweep/store_query.h"

namespace slipcheck {

/// For people: numbers of six digits under the name with its unit.
TextTable query_table(const QueryResult& result);
/// RFC 4180; a column's unit stands behind its name in brackets; numbers read back as the same.
std::string query_csv(const QueryResult& result);
/// {"schema": "slipcheck-query/1", "columns": [{"name", "unit"}], "rows": [[…], …]}, null where
/// there is nothing.
std::string query_json(const QueryResult& result);

}  // namespace slipcheck
