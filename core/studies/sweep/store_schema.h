#pragma once

#include <string>

#include "studies/sweep/sweep_store.h"

namespace slipcheck {

/// By which SQLite files of ours are told from others: "SLIP".
inline constexpr int kStoreApplication = 0x534C4950;

/// The statements that make the tables of an empty store (docs/sweeps.md), without its head.
std::string store_tables(const StoreHead& head);

}  // namespace slipcheck
