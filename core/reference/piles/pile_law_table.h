#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <unordered_map>
#include <vector>

#include "reference/piles/pile_law.h"

namespace slipcheck {

/// The laws of those that are near each other, each once: a soft one for each two materials, a hard
/// one, and where each two bodies have their own, for each two kinds of body.
class PileLawTable {
 public:
  /// Both must outlive the table.
  PileLawTable(const PileLaws& laws, const ContactScene& scene);

  /// Takes what nobody needs out where there are many; all numbers are new then. Returns whether.
  bool renew(std::size_t needed);
  /// The number of the law of a body and what Touch::second names.
  std::uint32_t number(std::size_t body, int second);
  std::size_t size() const { return table_.size(); }
  const PileLaw& operator[](std::uint32_t number) const { return table_[number]; }

 private:
  std::uint32_t known(std::uint64_t key, std::size_t body, int second);
  std::uint32_t add(std::size_t body, int second);

  const PileLaws* laws_;
  const ContactScene* scene_;
  std::vector<std::uint32_t> kind_;  ///< of each body: material, radius, mass and shape
  std::vector<std::uint32_t> soft_;  ///< by row × row of the scene's table
  std::unordered_map<std::uint64_t, std::uint32_t> numbers_;  ///< of the others
  std::deque<PileLaw> table_;
};

}  // namespace slipcheck
