#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "engine/engine.h"

namespace slipcheck {

inline std::vector<std::string> texts_of(const std::vector<Lack>& lacks) {
  std::vector<std::string> texts;
  for (const Lack& lack : lacks) texts.push_back(lack.text);
  return texts;
}

/// Lacks in a message or a file: texts, and a second list of as many kinds, which there may not be.
template <class Fields>
void describe_lacks(Fields& f, std::vector<Lack>& lacks) {
  std::vector<std::string> texts = texts_of(lacks), kinds;
  if (!std::ranges::all_of(lacks, &std::string::empty, &Lack::kind))
    for (const Lack& lack : lacks) kinds.push_back(lack.kind);
  f("not_represented", texts);
  f.if_any("not_represented_kinds", kinds);
  if constexpr (Fields::kReads) {
    if (f.has("not_represented_kinds")) f["not_represented_kinds"].items(texts.size());
    lacks.clear();
    for (std::size_t k = 0; k < texts.size(); ++k)
      lacks.push_back({texts[k], kinds.empty() ? "" : kinds[k]});
  }
}

}  // namespace slipcheck
