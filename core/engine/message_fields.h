#pragma once

#include <nlohmann/json.hpp>

#include "base/json_fields.h"

namespace slipcheck {

/// A record as it goes over to a worker, or comes back: numbers as they are.
template <class Record>
nlohmann::json message_json(const Record& record) {
  return FieldWriter<nlohmann::json, NotFinite::as_it_is>::json_of_value(record);
}

/// Such a record, in which all numbers but settings must be finite.
template <class Record>
Record read_finite(const JsonNode& node) {
  Record record{};
  BasicFieldReader<true>::read(node, record);
  return record;
}

}  // namespace slipcheck
