#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace slipcheck {

struct MergedStores {
  std::size_t taken = 0;    ///< runs that the store did not have, or had without success
  std::size_t runs = 0;     ///< that it has now
  std::uint64_t total = 0;  ///< of the sweep
};

/// Puts the runs of these stores of one sweep into one, which is made where it is not there. Of a
/// run that several have that counts which is ok, before unstable, before others; else the first.
/// Once more with the same stores changes nothing. Throws BadStore, before anything is written,
/// where one is no store or that of another sweep or program.
MergedStores merge_stores(const std::filesystem::path& into,
                          const std::vector<std::filesystem::path>& from);

}  // namespace slipcheck
