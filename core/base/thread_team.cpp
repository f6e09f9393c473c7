#include "base/thread_team.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace slipcheck {
namespace {

/// Some microseconds: shorter than it takes to wake a thread that sleeps.
constexpr int kLooks = 2000;

/// Looks for a while before it sleeps.
void wait_while(const std::atomic<std::uint32_t>& value, std::uint32_t old) {
  for (int k = 0; k < kLooks; ++k) {
    if (value.load(std::memory_order_acquire) != old) return;
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
  }
  value.wait(old, std::memory_order_acquire);
}

}  // namespace

ThreadTeam::ThreadTeam(std::size_t threads)
    : left_(threads > 0 ? threads : std::max(1u, std::thread::hardware_concurrency())) {
  threads = left_.size();
  others_.reserve(threads - 1);
  try {
    while (others_.size() + 1 < threads)
      others_.emplace_back([this, own = others_.size() + 1] { wait_for_work(own); });
  } catch (const std::system_error&) {  // the system gives no more; fewer do the same work
  } catch (...) {
    end();  // those that there are wait for work, and are waited for
    throw;
  }
}

ThreadTeam::~ThreadTeam() { end(); }

void ThreadTeam::end() {
  ends_ = true;
  round_.fetch_add(1, std::memory_order_release);
  round_.notify_all();
}

void ThreadTeam::share(std::size_t count, Call call, void* work) {
  if (others_.empty() || count <= 1) {
    call_ = call;
    work_ = work;
    count_ = failed_ = count;
    next_.store(0, std::memory_order_relaxed);
    take_turns();
  } else {
    call_ = call;
    work_ = work;
    count_ = failed_ = count;
    terms_ = StopScope::terms();
    next_.store(0, std::memory_order_relaxed);
    busy_.store(static_cast<std::uint32_t>(others_.size()), std::memory_order_relaxed);
    round_.fetch_add(1, std::memory_order_release);
    round_.notify_all();
    take_part(0);
    for (std::uint32_t busy = busy_.load(std::memory_order_acquire); busy != 0;
         busy = busy_.load(std::memory_order_acquire))
      wait_while(busy_, busy);
  }
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void ThreadTeam::take_part(std::size_t own) {
  if (count_ == size())
    take(own);
  else
    take_turns();
}

void ThreadTeam::take_turns() {
  for (std::size_t k = next_++; k < count_; k = next_++) take(k);
}

void ThreadTeam::take(std::size_t k) {
  try {
    call_(work_, k);
  } catch (...) {
    const std::scoped_lock lock(failing_);
    if (k >= failed_) return;
    failed_ = k;
    failure_ = std::current_exception();
  }
}

void ThreadTeam::wait_for_work(std::size_t own) {
  for (std::uint32_t seen = 0;; ++seen) {
    wait_while(round_, seen);
    if (ends_) return;
    {
      const StopScope scope(terms_);
      take_part(own);
    }
    if (busy_.fetch_sub(1, std::memory_order_acq_rel) == 1) busy_.notify_all();
  }
}

}  // namespace slipcheck
