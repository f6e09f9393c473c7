#include "engine/spawn.h"

#include <fcntl.h>
#include <linux/close_range.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <iterator>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace slipcheck {
namespace {

[[noreturn]] void fail(int code, const char* what) {
  throw std::system_error(code, std::generic_category(), what);
}

/// A file descriptor with an owner.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) close(fd_);
  }
  int get() const { return fd_; }
  int release() { return std::exchange(fd_, -1); }

 private:
  int fd_;
};

struct Ends {
  Descriptor ours;
  Descriptor theirs;
};

/// Takes two new descriptors over, above the standard ones even where those are closed: the
/// child's are copied down to 0, 1 and 2 one after the other.
Ends own(int ours, int theirs) {
  const Descriptor first(ours), second(theirs);
  Ends ends{Descriptor(fcntl(ours, F_DUPFD_CLOEXEC, 3)),
            Descriptor(fcntl(theirs, F_DUPFD_CLOEXEC, 3))};
  if (ends.ours.get() < 0 || ends.theirs.get() < 0) fail(errno, "fcntl");
  fcntl(ends.ours.get(), F_SETFL, fcntl(ends.ours.get(), F_GETFL) | O_NONBLOCK);
  return ends;
}

Ends make_input() {
  int fds[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, fds) != 0) fail(errno, "socketpair");
  return own(fds[0], fds[1]);
}

Ends make_output() {
  int fds[2];
  if (pipe2(fds, O_CLOEXEC) != 0) fail(errno, "pipe");
  return own(fds[0], fds[1]);
}

/// What a worker may know of this one's surroundings: where it finds programs and files, its
/// language, and what is meant for engines.
bool is_for_workers(std::string_view variable) {
  constexpr std::string_view kNames[] = {"PATH", "HOME", "LANG", "TMPDIR"};
  constexpr std::string_view kPrefixes[] = {"LC_",   "SLIPCHECK_", "NODE_", "OMP_",  "XDG_",
                                            "GCOV_",
#ifdef SLIPCHECK_SANITIZE
                                            "ASAN_", "LSAN_",      "TSAN_", "UBSAN_"
#endif
  };
  const std::string_view name = variable.substr(0, variable.find('='));
  return std::ranges::find(kNames, name) != std::end(kNames) ||
         std::ranges::any_of(kPrefixes,
                             [&](std::string_view prefix) { return name.starts_with(prefix); });
}

std::vector<char*> environment_of_workers() {
  std::vector<char*> variables;
  for (char** each = environ; *each != nullptr; ++each)
    if (is_for_workers(*each)) variables.push_back(*each);
  variables.push_back(nullptr);
  return variables;
}

/// While it lives no handler runs in this thread, nor in what it forks.
class SignalsBlocked {
 public:
  SignalsBlocked() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~SignalsBlocked() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsBlocked(const SignalsBlocked&) = delete;
  SignalsBlocked& operator=(const SignalsBlocked&) = delete;

 private:
  sigset_t before_;
};

/// All that a child needs to become a worker, made before the fork: after it, other threads' locks
/// stay locked for ever, so that only async-signal-safe functions may be called.
struct Start {
  std::array<int, 3> streams;
  int failure;  // where an errno is written to
  pid_t parent;
  char* const* arguments;
  char* const* environment;
};

[[noreturn]] void give_up(const Start& start) {
  const int error = errno;
  static_cast<void>(!write(start.failure, &error, sizeof error));
  _exit(127);
}

/// No descriptor but the standard ones outlives exec.
void close_the_rest_on_exec() {
  if (close_range(3, ~0U, CLOSE_RANGE_CLOEXEC) == 0) return;
  const long count = sysconf(_SC_OPEN_MAX);  // of a kernel before 5.11
  for (int fd = 3; fd < count; ++fd) fcntl(fd, F_SETFD, FD_CLOEXEC);
}

[[noreturn]] void become_worker(const Start& start) {
  // Ends with this program, even if that is killed and the worker never looks at its input.
  if (prctl(PR_SET_PDEATHSIG, SIGKILL) != 0) give_up(start);
  if (getppid() != start.parent) _exit(127);  // it has ended before that
  if (setpgid(0, 0) != 0) give_up(start);
  for (int number = 1; number < NSIG; ++number) signal(number, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  for (int k = 0; k < 3; ++k)
    if (dup2(start.streams[static_cast<std::size_t>(k)], k) < 0) give_up(start);
  close_the_rest_on_exec();
  execvpe(start.arguments[0], start.arguments, start.environment);
  give_up(start);
}

/// The errno that the child has written; 0 once its end is closed by exec.
int failure_from(int fd) {
  int error = 0;
  ssize_t count = 0;
  do {
    count = read(fd, &error, sizeof error);
  } while (count < 0 && errno == EINTR);
  return count == sizeof error ? error : 0;
}

/// Its process id. Throws std::system_error.
pid_t start_worker(Start start) {
  Ends outcome = make_output();
  fcntl(outcome.ours.get(), F_SETFL, 0);  // it is waited for
  start.failure = outcome.theirs.get();
  start.parent = getpid();
  pid_t pid = -1;
  {
    const SignalsBlocked blocked;
    pid = fork();
    if (pid == 0) become_worker(start);
  }
  if (pid < 0) fail(errno, "cannot start");
  close(outcome.theirs.release());
  const int error = failure_from(outcome.ours.get());
  if (error == 0) return pid;
  while (waitpid(pid, nullptr, 0) < 0 && errno == EINTR) {
  }
  fail(error, "cannot start");
}

}  // namespace

Child spawn(const WorkerCommand& command, std::size_t memory) {
  Ends in = make_input(), out = make_output(), err = make_output();
  fcntl(out.ours.get(), F_SETPIPE_SZ, 1 << 20);  // fewer switches on long replies; may be denied

  std::vector<std::string> words = {command.program.string()};
  words.insert(words.end(), command.arguments.begin(), command.arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const std::vector<char*> environment = environment_of_workers();
  Child child;
  child.pid = start_worker({{in.theirs.get(), out.theirs.get(), err.theirs.get()},
                            -1,
                            -1,
                            argv.data(),
                            environment.data()});

  if (memory > 0) {
    // Not the address space, of which WebAssembly reserves gigabytes for a page.
    const rlimit limit = {memory, memory};
    prlimit(child.pid, RLIMIT_DATA, &limit, nullptr);
  }
  child.in = in.ours.release();
  child.out = out.ours.release();
  child.err = err.ours.release();
  return child;
}

}  // namespace slipcheck
