#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "base/enum_names.h"

namespace slipcheck {

// JSON has no word for what is not finite: such a number is null. For what each null of an object
// stands is said under "nulls", why for people under "reason".

enum class NullMeaning { nan, infinite, minus_infinite, absent };
template <>
inline constexpr std::array kNamesOf<NullMeaning> = {"nan", "infinite", "minus_infinite", "absent"};

/// A number under a key, with a reason where it is null: the one given, else that it is not a
/// number or infinite.
void put_number(nlohmann::ordered_json& object, const std::string& key, double value,
                const std::string& reason = {});

/// null where there is no number, with the reason.
void put_nothing(nlohmann::ordered_json& object, const std::string& key, const std::string& reason);

/// Says for what a null stands, which is written already: a member, or an entry "values[3]" of one.
void note_null(nlohmann::ordered_json& object, const std::string& key, double value);

/// Adds to what stands under "reason"; nothing for an empty text and for what stands there already.
void add_reason(nlohmann::ordered_json& object, const std::string& reason);

/// "max is not a number", "max is infinite", "max is minus infinite"; empty of a finite number.
std::string if_not_finite(const std::string& what, double value);

/// What the null under this key stands for: NaN or an infinity; nothing where it is absent.
std::optional<double> number_of_null(const nlohmann::json& object, const std::string& key);

/// Why the record itself is as it is: "own_reason" where it has nulls, of which "reason" tells too,
/// else "reason". Empty where there is none.
std::string own_reason(const nlohmann::json& object);

}  // namespace slipcheck
