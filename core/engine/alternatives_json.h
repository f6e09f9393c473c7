#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <string>
#include <variant>

#include "base/json_fields.h"

/// One of several records in messages, with the word that tells which.
namespace slipcheck {

/// The words for the alternatives of a variant, in its order.
template <class Variant>
inline constexpr std::array<const char*, 0> kWordsOf{};

/// The word as the member `key`, and beside it the fields of the alternative.
template <class Fields, class... Alternatives>
void describe_alternative(Fields& f, const char* key, std::variant<Alternatives...>& one) {
  constexpr auto& words = kWordsOf<std::variant<Alternatives...>>;
  static_assert(words.size() == sizeof...(Alternatives));
  std::string word = words[one.index()];
  f(key, word);
  if constexpr (Fields::kReads) {
    std::size_t k = 0;
    const bool known = ((words[k++] == word && (one = Alternatives{}, true)) || ...);
    if (!known) f[key].fault(fmt::format("must be one of {}", fmt::join(words, ", ")));
  }
  std::visit([&](auto& each) { describe(f, each); }, one);
}

}  // namespace slipcheck
