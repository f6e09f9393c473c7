#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <thread>

#include "base/thread_team.h"

namespace slipcheck {

/// Calls `work` with 0 … count − 1, each once, on `threads` threads (0: one for each core), and
/// returns when all have returned. What one of them throws is thrown on then, of several that of
/// the lowest number. What stops the calling thread stops them all.
inline void in_parallel(std::size_t count, std::size_t threads,
                        const std::function<void(std::size_t)>& work) {
  if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());
  ThreadTeam(std::clamp(threads, std::size_t{1}, std::max(count, std::size_t{1}))).run(count, work);
}

}  // namespace slipcheck
