#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace slipcheck {

// JSON has no word for what is not finite: such a number is null, and a "reason" stands beside it.

/// A number under a key, with a reason where it is null: the one given, else that it is not a
/// number or infinite.
void put_number(nlohmann::ordered_json& object, const std::string& key, double value,
                const std::string& reason = {});

/// Adds to what stands under "reason"; nothing for an empty text and for what stands there already.
void add_reason(nlohmann::ordered_json& object, const std::string& reason);

/// "max is not a number", "max is infinite", "max is minus infinite"; empty of a finite number.
std::string if_not_finite(const std::string& what, double value);

/// What the null under this key stands for: NaN or an infinity; nothing where a reason only says
/// why there is no number.
std::optional<double> number_of_null(const nlohmann::json& object, const std::string& key);

/// "reason" without what only tells of a null. Empty where there is none.
std::string own_reason(const nlohmann::json& object);

}  // namespace slipcheck
