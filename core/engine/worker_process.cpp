#include "engine/worker_process.h"

#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <new>
#include <optional>
#include <span>
#include <system_error>
#include <thread>
#include <utility>

#include "base/running_clock.h"
#include "engine/engine_text.h"
#include "engine/protocol.h"
#include "engine/spawn.h"
#include "engine/worker_guard.h"

namespace slipcheck {

using protocol::Bytes;
using std::chrono::milliseconds;
using Status = WorkerFailure::Status;

namespace {

// How long to wait at most before looking at the clock, the memory and the stop flag again.
constexpr milliseconds kSlice{20};
// Nobody comes to look for so long because this program was stopped.
constexpr std::chrono::seconds kStopped{1};
// How long a worker that closed its output has to exit, and how long one that is idle.
constexpr milliseconds kPatience{1000};
constexpr std::size_t kErrorTail = 4096;
constexpr double kForever = 1e8;  // [s]; an infinite limit has no Clock::duration

#ifdef SLIPCHECK_SANITIZE
constexpr bool kLimitsData = false;  // the shadow memory of a sanitizer counts
#else
constexpr bool kLimitsData = true;
#endif

/// Resident memory [bytes]; 0 where it cannot be read.
std::size_t resident(pid_t pid) {
  std::FILE* file = std::fopen(fmt::format("/proc/{}/statm", pid).c_str(), "re");
  if (file == nullptr) return 0;
  unsigned long total = 0, pages = 0;
  const int read = std::fscanf(file, "%lu %lu", &total, &pages);
  std::fclose(file);
  return read == 2 ? pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) : 0;
}

/// How long a process could have run and had no processor, since it started; 0 where Linux does not
/// say.
std::chrono::nanoseconds starved(pid_t pid) {
  std::FILE* file = std::fopen(fmt::format("/proc/{}/schedstat", pid).c_str(), "re");
  if (file == nullptr) return {};
  unsigned long long ran = 0, waited = 0;
  const int read = std::fscanf(file, "%llu %llu", &ran, &waited);
  std::fclose(file);
  return std::chrono::nanoseconds(read == 2 ? waited : 0);
}

std::string how_it_ended(int status) {
  if (WIFSIGNALED(status)) {
    const int number = WTERMSIG(status);
    return fmt::format("killed by signal {} ({})", number, strsignal(number));
  }
  return fmt::format("exited with code {}", WEXITSTATUS(status));
}

std::string with_words(const std::string& reason, const std::string& words) {
  return words.empty() ? reason : fmt::format("{}: {}", reason, words);
}

}  // namespace

/// One request on its way out and its reply on its way in.
struct WorkerProcess::Exchange {
  const Bytes& message;
  std::size_t longest_reply;
  std::size_t sent = 0;
  Bytes received;

  bool all_sent() const { return sent == message.size(); }

  /// The length of the whole reply, once its prefix is here. Throws Rubbish.
  std::size_t expected() const {
    if (received.size() < protocol::kPrefix) return protocol::kPrefix;
    const std::span<const std::uint8_t, protocol::kPrefix> prefix(received.data(),
                                                                  protocol::kPrefix);
    return protocol::kPrefix + protocol::body_length(prefix, longest_reply);
  }
  bool complete() const {
    return received.size() >= protocol::kPrefix && received.size() >= expected();
  }
};

WorkerProcess::WorkerProcess(WorkerCommand command, const WorkerLimits& limits,
                             const std::atomic<bool>* stop)
    : command_(std::move(command)),
      limits_(limits),
      stop_(stop),
      longest_message_(protocol::kMaxMessage) {
  try {
    // The limit proper is on resident memory. This one only stops what grows by more than the
    // limit between two looks.
    const Child child = spawn(command_, kLimitsData ? 2 * limits_.memory : 0);
    pid_ = child.pid;
    in_ = child.in;
    out_ = child.out;
    err_ = child.err;
    guard_group(pid_);
  } catch (const std::bad_alloc&) {
    if (pid_ >= 0) kill_and_reap();
    throw;
  } catch (const std::system_error& error) {
    throw WorkerFailure(Status::crashed,
                        fmt::format("{}: {}", command_.program.string(), error.what()));
  }
}

WorkerProcess::~WorkerProcess() {
  if (pid_ < 0) return;
  shutdown(in_, SHUT_WR);  // an idle worker exits by itself
  has_exited(kPatience);
  kill_and_reap();
}

WorkerProcess::Clock::time_point WorkerProcess::now() {
  const auto real = running_time();
  if (real - looked_ > kStopped) lost_ += real - looked_;
  looked_ = real;
  return real - lost_;
}

Bytes WorkerProcess::exchange(const Bytes& message, Clock::time_point deadline) {
  if (pid_ < 0) throw WorkerFailure(Status::crashed, "the worker is gone");
  const auto limit = std::chrono::duration_cast<Clock::duration>(
      std::chrono::duration<double>(std::min(limits_.reply, kForever)));
  const auto begin = now();
  const bool by_reply = deadline - begin > limit;
  std::optional<std::chrono::nanoseconds> starved_before;  // unknown while a reply may come at once
  const Clock::time_point run_deadline =
      std::exchange(deadline, by_reply ? begin + limit : deadline);

  Exchange exchange{message, longest_message_, 0, {}};
  // The worker waits for it. One that has gone may have left a text that says more.
  static_cast<void>(send_some(exchange));
  while (!exchange.complete()) {
    if (stop_ != nullptr && *stop_) {
      kill_and_reap();
      throw Interrupted();
    }
    const auto time = now();
    // A machine that is busy with something else is not the worker's fault.
    if (by_reply && starved_before && time >= deadline)
      deadline = std::min(run_deadline, begin + limit + (starved(pid_) - *starved_before));
    if (time >= deadline) {
      fail(Status::timed_out, by_reply ? fmt::format("no reply within {:g} s", limits_.reply)
                                       : "the run took longer than its time limit");
    }
    if (time - memory_checked_ >= kSlice) check_memory();

    const short writing = exchange.all_sent() ? short{0} : short{POLLOUT};
    std::array<pollfd, 3> fds = {{{in_, writing, 0}, {out_, POLLIN, 0}, {err_, POLLIN, 0}}};
    if (exchange.all_sent()) fds[0].fd = -1;  // it would only tell that the worker closed it
    const auto left = std::chrono::ceil<milliseconds>(deadline - time);
    const int ready =
        poll(fds.data(), fds.size(), static_cast<int>(std::min(left, kSlice).count()));
    if (ready == 0 && !starved_before) starved_before = starved(pid_);

    if (fds[2].revents != 0) drain_errors();
    if (fds[1].revents != 0) receive_some(exchange);
    if (fds[0].revents != 0 && !send_some(exchange)) fail_because_gone();
  }
  if (exchange.received.size() > exchange.expected()) {
    fail(Status::crashed, "spoke rubbish: more than one reply to a request");
  }
  exchange.received.erase(exchange.received.begin(), exchange.received.begin() + protocol::kPrefix);
  return std::move(exchange.received);
}

bool WorkerProcess::send_some(Exchange& exchange) const {
  const ssize_t n = send(in_, exchange.message.data() + exchange.sent,
                         exchange.message.size() - exchange.sent, MSG_NOSIGNAL);
  if (n > 0) exchange.sent += static_cast<std::size_t>(n);
  return n >= 0 || errno == EAGAIN || errno == EINTR;
}

void WorkerProcess::receive_some(Exchange& exchange) {
  std::array<std::uint8_t, 1 << 16> some;
  while (!exchange.complete()) {
    const ssize_t n = read(out_, some.data(), some.size());
    if (n == 0 || (n < 0 && errno != EAGAIN && errno != EINTR)) fail_because_gone();
    if (n < 0) return;
    exchange.received.insert(exchange.received.end(), some.begin(), some.begin() + n);
    try {
      exchange.received.reserve(exchange.expected());
    } catch (const protocol::Rubbish& rubbish) {
      fail(Status::crashed, fmt::format("spoke rubbish: {}", rubbish.what()));
    }
  }
}

void WorkerProcess::drain_errors() {
  std::array<char, 4096> some;
  for (int times = 0; times < 16; ++times) {  // one that never stops must not hold us
    const ssize_t n = read(err_, some.data(), some.size());
    if (n < 0) return;
    if (n == 0) {
      close(err_);
      err_ = -1;  // poll passes over it
      return;
    }
    try {
      errors_.append(some.data(), static_cast<std::size_t>(n));
    } catch (const std::bad_alloc&) {  // destructors read it to its end too
      errors_.clear();
    }
    if (errors_.size() > kErrorTail) errors_.erase(0, errors_.size() - kErrorTail);
  }
}

void WorkerProcess::check_memory() {
  memory_checked_ = now();
  if (resident(pid_) <= limits_.memory) return;
  memory_exceeded_ = true;
  fail_because_gone();
}

bool WorkerProcess::has_exited(milliseconds patience) {
  const auto until = now() + patience;
  while (true) {
    siginfo_t info{};
    // WNOWAIT: as long as it is not reaped, its number and its group's belong to nobody else.
    waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT);
    if (info.si_pid == pid_) return true;
    if (now() >= until) return false;
    std::this_thread::sleep_for(milliseconds(1));
  }
}

int WorkerProcess::kill_and_reap() {
  kill(-pid_, SIGKILL);
  release_group(pid_);
  int status = 0;
  rusage usage{};
  while (wait4(pid_, &status, 0, &usage) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  memory_exceeded_ |= static_cast<std::size_t>(usage.ru_maxrss) * 1024 > limits_.memory;
  if (err_ >= 0) drain_errors();
  for (int* fd : {&in_, &out_, &err_}) {
    if (*fd >= 0) close(*fd);
    *fd = -1;
  }
  return status;
}

void WorkerProcess::fail(Status status, const std::string& reason) {
  if (pid_ >= 0) kill_and_reap();
  throw WorkerFailure(status, reason);
}

void WorkerProcess::fail_because_gone() {
  const bool exited = !memory_exceeded_ && has_exited(kPatience);
  const int status = kill_and_reap();
  std::string reason = "closed its pipe";
  if (memory_exceeded_) {
    reason = fmt::format("exceeded the memory limit of {} MiB", limits_.memory >> 20);
  } else if (exited) {
    reason = with_words(how_it_ended(status), last_words());
  }
  throw WorkerFailure(Status::crashed, reason);
}

std::size_t WorkerProcess::unread() const {
  int waiting = 0;
  return out_ >= 0 && ioctl(out_, FIONREAD, &waiting) == 0 ? static_cast<std::size_t>(waiting) : 0;
}

WorkerEnd WorkerProcess::finish(const Bytes& last, bool end_of_input, double patience) {
  if (pid_ < 0) throw WorkerFailure(Status::crashed, "the worker is gone");
  // A few bytes: they fit into the socket whatever the worker does.
  if (!last.empty()) static_cast<void>(send(in_, last.data(), last.size(), MSG_NOSIGNAL));
  if (end_of_input) shutdown(in_, SHUT_WR);
  WorkerEnd end;
  end.exited = has_exited(milliseconds(std::llround(1e3 * std::min(patience, kForever))));
  end.left_over = unread();
  const int status = kill_and_reap();
  end.how = end.exited ? how_it_ended(status) : "went on";
  end.well = end.exited && WIFEXITED(status) && WEXITSTATUS(status) == 0;
  return end;
}

bool WorkerProcess::alive() {
  if (pid_ >= 0 && has_exited(milliseconds(0))) kill_and_reap();
  return pid_ >= 0;
}

std::string WorkerProcess::last_words() const {
  const std::size_t end = errors_.find_last_not_of(" \r\n\t");
  if (end == std::string::npos) return {};
  const std::size_t newline = errors_.find_last_of('\n', end);
  const std::size_t begin = newline == std::string::npos ? 0 : newline + 1;
  std::string words = errors_.substr(begin, std::min<std::size_t>(end + 1 - begin, 300));
  // Whatever it was, it goes to terminals and into JSON.
  for (char& c : words) {
    if (c < ' ' || c > '~') c = '?';
  }
  return harmless(words);
}

}  // namespace slipcheck
