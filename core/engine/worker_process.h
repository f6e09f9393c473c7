#pragma once

#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "base/stop_scope.h"
#include "engine/cbor.h"
#include "engine/worker_command.h"

namespace slipcheck {

/// The worker is of no more use; what() is the reason, for the user.
class WorkerFailure : public std::runtime_error {
 public:
  enum class Status { crashed, timed_out };  ///< as in the result file

  WorkerFailure(Status status, const std::string& reason)
      : std::runtime_error(reason), status_(status) {}
  Status status() const { return status_; }

 private:
  Status status_;
};

struct WorkerLimits {
  std::size_t memory = std::size_t{2} << 30;  ///< resident [bytes], > 0
  double reply = 10;  ///< for each reply, without the time for which it has no processor [s], > 0
};

/// How a worker ended that was let go.
struct WorkerEnd {
  bool exited = false;        ///< by itself, in time
  std::string how;            ///< "exited with code 0", "killed by signal 11 (…)", "went on"
  bool well = false;          ///< exited with code 0
  std::size_t left_over = 0;  ///< what it still wrote and nobody asked for [bytes]
};

/// A worker seen from the harness: a child process in a process group of its own, with pipes to its
/// standard streams. Every way in which it can fail ends in WorkerFailure with a reason; the
/// child is always killed with its group and reaped, by a guard where this program is killed
/// itself. Not for use by two threads at once, and the worker lives no longer than the thread that
/// made it (PR_SET_PDEATHSIG is by thread).
class WorkerProcess {
 public:
  using Clock = std::chrono::steady_clock;

  /// Throws WorkerFailure if it cannot be started. `stop`, where given, is looked at while waiting.
  WorkerProcess(WorkerCommand command, const WorkerLimits& limits,
                const std::atomic<bool>* stop = nullptr);
  ~WorkerProcess();
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;

  /// The time, which stands still while this program itself is stopped (SIGSTOP) or does not come
  /// to look for longer than a second: a worker is not to blame for that. Deadlines are by it.
  Clock::time_point now();

  /// Sends a message (prefix included) and returns the body of the reply, at the latest after
  /// limits.reply seconds or at `deadline`, whichever comes first. Throws WorkerFailure and
  /// Interrupted, and then the worker is gone.
  protocol::Bytes exchange(const protocol::Bytes& message,
                           Clock::time_point deadline = Clock::time_point::max());

  /// Of a message's body either way [bytes]; protocol::kMaxMessage unless set.
  void allow_messages(std::size_t longest) { longest_message_ = longest; }
  std::size_t longest_message() const { return longest_message_; }

  /// Ends the worker because of something in its reply: throws WorkerFailure with that reason.
  [[noreturn]] void fail(WorkerFailure::Status status, const std::string& reason);

  /// What the worker has written that nobody asked for, so far [bytes].
  std::size_t unread() const;

  /// Sends a last message, which may be empty or a part of one, ends the input where
  /// `end_of_input`, and waits up to `patience` [s] for the worker to exit. Then it is gone in any
  /// case. Throws WorkerFailure where it is gone already.
  WorkerEnd finish(const protocol::Bytes& last, bool end_of_input, double patience);

  /// Whether another exchange has a chance. A worker that died meanwhile is noticed.
  bool alive();

  pid_t pid() const { return pid_; }

 private:
  struct Exchange;

  [[noreturn]] void fail_because_gone();
  void check_memory();
  void drain_errors();
  /// Whether the worker still takes anything.
  [[nodiscard]] bool send_some(Exchange& exchange) const;
  void receive_some(Exchange& exchange);
  bool has_exited(std::chrono::milliseconds patience);
  int kill_and_reap();
  std::string last_words() const;

  WorkerCommand command_;
  WorkerLimits limits_;
  const std::atomic<bool>* stop_;
  pid_t pid_ = -1;  // -1: gone and reaped
  int in_ = -1;     // the child's standard input, a socket: writing to it raises no SIGPIPE
  int out_ = -1;
  int err_ = -1;
  std::string errors_;  // the last of what the child wrote to its standard error
  Clock::time_point memory_checked_;
  Clock::time_point looked_ = Clock::now();   // at the real time, when now() was asked last
  Clock::duration lost_ = Clock::duration{};  // while nobody looked
  bool memory_exceeded_ = false;
  std::size_t longest_message_;
};

}  // namespace slipcheck
