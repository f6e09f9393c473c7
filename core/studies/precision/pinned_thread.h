#pragma once

#include <sched.h>

namespace slipcheck {

/// Keeps this thread, and processes that it starts meanwhile, on one core: nothing is moved to cold
/// caches in the middle of a timing. What it was allowed before comes back on leaving.
class PinnedThread {
 public:
  /// The last core that the thread may use: the first ones serve most interrupts. Where the system
  /// does not let it, nothing happens.
  PinnedThread();
  ~PinnedThread();
  PinnedThread(const PinnedThread&) = delete;
  PinnedThread& operator=(const PinnedThread&) = delete;

  int core() const { return core_; }  ///< -1: it is not pinned

 private:
  cpu_set_t before_{};
  int core_ = -1;
};

}  // namespace slipcheck
