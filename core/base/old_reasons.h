#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace slipcheck {

// Files without "nulls", which were written before there was that, say only in words, under
// "reason", what a null stands for.

/// NaN or an infinity; nothing where the reason only says why there is no number.
std::optional<double> number_of_reason(const nlohmann::json& object, const std::string& key);

/// "reason" without what only tells of a null.
std::string reason_without_nulls(const nlohmann::json& object);

// Files without "not_represented_kinds" say only in words what an engine cannot express.

/// Texts of one kind read alike: without what stands in parentheses, and "…" for each number.
std::string kind_in_words(const std::string& text);

}  // namespace slipcheck
