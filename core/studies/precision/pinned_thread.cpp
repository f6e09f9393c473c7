#include "studies/precision/pinned_thread.h"

namespace slipcheck {

PinnedThread::PinnedThread() {
  if (sched_getaffinity(0, sizeof before_, &before_) != 0) return;
  int last = -1;
  for (int core = 0; core < CPU_SETSIZE; ++core)
    if (CPU_ISSET(core, &before_)) last = core;
  if (last < 0) return;
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(last, &one);
  if (sched_setaffinity(0, sizeof one, &one) == 0) core_ = last;
}

PinnedThread::~PinnedThread() {
  if (core_ >= 0) sched_setaffinity(0, sizeof before_, &before_);
}

}  // namespace slipcheck
