#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/stop_scope.h"

namespace slipcheck {

/// Threads that wait for work, so that giving them some costs microseconds: loops that come again
/// in every step share one team. One thread gives work; while it waits for the others it takes a
/// part of it.
class ThreadTeam {
 public:
  /// `threads`: with the one that gives the work, >= 1; 0: one for each core. Fewer where the
  /// system gives no more.
  explicit ThreadTeam(std::size_t threads);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  std::size_t size() const { return others_.size() + 1; }

  /// Calls `work` with 0 … count − 1, each once, and returns when all have returned. Where they are
  /// as many as the threads, each goes to the same thread every time. What one of them throws is
  /// thrown on then, of several that of the lowest number. What stops the calling thread stops them
  /// all. Nothing that `work` does may give work to the same team.
  template <class Work>
  void run(std::size_t count, Work&& work) {
    using Function = std::remove_reference_t<Work>;
    share(
        count, [](void* each, std::size_t k) { (*static_cast<Function*>(each))(k); },
        const_cast<void*>(static_cast<const void*>(&work)));
  }

  /// Calls work(k, first, last) for the shares of 0 … count − 1, one for each thread k: what lies
  /// side by side is the same thread's every time.
  template <class Work>
  void run_shares(std::size_t count, Work&& work) {
    run(size(), [&](std::size_t k) {
      const auto [first, last] = share_of(count, k);
      work(k, first, last);
    });
  }

  /// Calls work(own, k) for all k of 0 … count − 1, each thread `own` for those of its share, and
  /// then for what is left of others'.
  template <class Work>
  void run_own_first(std::size_t count, Work&& work) {
    for (std::size_t k = 0; k < size(); ++k) left_[k].first = share_of(count, k).first;
    run(size(), [&](std::size_t own) {
      for (std::size_t turn = 0; turn < size(); ++turn) {
        const std::size_t of = (own + turn) % size(), last = share_of(count, of).second;
        for (std::size_t k = left_[of].first++; k < last; k = left_[of].first++) work(own, k);
      }
    });
  }

  /// Of 0 … count − 1 those first … last − 1 that are thread k's.
  std::pair<std::size_t, std::size_t> share_of(std::size_t count, std::size_t k) const {
    return {count * k / size(), count * (k + 1) / size()};
  }

 private:
  using Call = void (*)(void*, std::size_t);

  void end();
  void share(std::size_t count, Call call, void* work);
  void take_part(std::size_t own);
  void take_turns();
  void take(std::size_t k);
  void wait_for_work(std::size_t own);

  Call call_ = nullptr;
  void* work_ = nullptr;
  std::size_t count_ = 0;
  StopScope::Terms terms_;
  std::exception_ptr failure_;
  std::size_t failed_ = 0;
  std::mutex failing_;
  bool ends_ = false;

  alignas(64) std::atomic<std::uint32_t> round_ = 0;  ///< of work, told to the others
  alignas(64) std::atomic<std::size_t> next_ = 0;
  alignas(64) std::atomic<std::uint32_t> busy_ = 0;  ///< others that are not done with the round
  /// Of a thread's share, what none has taken.
  struct alignas(64) Left {
    std::atomic<std::size_t> first = 0;
  };
  std::vector<Left> left_;  ///< by thread
  std::vector<std::jthread> others_;
};

/// As ThreadTeam::run; without a team one after the other.
template <class Work>
void run_each(ThreadTeam* team, std::size_t count, Work&& work) {
  if (team)
    team->run(count, work);
  else
    for (std::size_t k = 0; k < count; ++k) work(k);
}

}  // namespace slipcheck
