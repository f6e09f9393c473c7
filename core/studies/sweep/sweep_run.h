#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>

#include "engine/worker_process.h"
#include "studies/sweep/sweep_setup.h"
#include "studies/sweep/sweep_store.h"

namespace slipcheck {

struct SweepOptions {
  std::size_t workers = 0;  ///< at once; 0: one for each core
  double time_limit = 60;   ///< of wall time for one phase of an engine, and for a reference [s]
  WorkerLimits limits;
  const std::atomic<bool>* stop = nullptr;  ///< once set, what is at work ends and is not kept
};

/// Makes the runs that `next` gives, by one thread at a time, until it has no more, and hands each
/// to `keep`, from any thread. Throws on what `next` or `keep` throws.
void run_sweep(const SweepSetup& setup, const SweepOptions& options,
               const std::function<std::optional<std::uint64_t>()>& next,
               const std::function<void(const FinishedRun&)>& keep);

/// The runs of shard `shard` of `shards`, from the first of the pair to before the second: of n
/// shards together all, each once. 1 <= shard <= shards.
std::pair<std::uint64_t, std::uint64_t> shard_of(std::uint64_t runs, std::uint64_t shard,
                                                 std::uint64_t shards);

}  // namespace slipcheck
