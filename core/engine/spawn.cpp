#include "engine/spawn.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <string>
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

class Attributes {
 public:
  Attributes() {
    posix_spawnattr_init(&attributes_);
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setsigdefault(&attributes_, &all);
    posix_spawnattr_setpgroup(&attributes_, 0);
    posix_spawnattr_setflags(
        &attributes_, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  }
  ~Attributes() { posix_spawnattr_destroy(&attributes_); }
  Attributes(const Attributes&) = delete;
  Attributes& operator=(const Attributes&) = delete;
  const posix_spawnattr_t* get() const { return &attributes_; }

 private:
  posix_spawnattr_t attributes_;
};

class StandardStreams {
 public:
  StandardStreams(int in, int out, int err) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_adddup2(&actions_, in, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, out, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, err, STDERR_FILENO);
  }
  ~StandardStreams() { posix_spawn_file_actions_destroy(&actions_); }
  StandardStreams(const StandardStreams&) = delete;
  StandardStreams& operator=(const StandardStreams&) = delete;
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_;
};

}  // namespace

Child spawn(const WorkerCommand& command, std::size_t memory) {
  Ends in = make_input(), out = make_output(), err = make_output();
  fcntl(out.ours.get(), F_SETPIPE_SZ, 1 << 20);  // fewer switches on long replies; may be denied

  const Attributes attributes;
  const StandardStreams streams(in.theirs.get(), out.theirs.get(), err.theirs.get());
  std::vector<std::string> words = {command.program.string()};
  words.insert(words.end(), command.arguments.begin(), command.arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  Child child;
  const int error =
      posix_spawnp(&child.pid, argv[0], streams.get(), attributes.get(), argv.data(), environ);
  if (error != 0) fail(error, "cannot start");

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
