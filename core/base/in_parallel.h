#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "base/stop_scope.h"

namespace slipcheck {

/// Calls `work` with 0 … count − 1, each once, on `threads` threads (0: one for each core), and
/// returns when all have returned. What one of them throws is thrown on then, of several that of
/// the lowest number. What stops the calling thread stops them all.
inline void in_parallel(std::size_t count, std::size_t threads,
                        const std::function<void(std::size_t)>& work) {
  if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());
  std::atomic<std::size_t> next = 0;
  std::exception_ptr failure;
  std::size_t failed = count;
  std::mutex failing;
  const auto take_turns = [&] {
    for (std::size_t k = next++; k < count; k = next++) try {
        work(k);
      } catch (...) {
        const std::scoped_lock lock(failing);
        if (k >= failed) continue;
        failed = k;
        failure = std::current_exception();
      }
  };
  {
    std::vector<std::jthread> others;
    for (std::size_t t = 1; t < std::min(threads, count); ++t)
      others.emplace_back([&, terms = StopScope::terms()] {
        const StopScope scope(terms);
        take_turns();
      });
    take_turns();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace slipcheck
