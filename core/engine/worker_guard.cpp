#include "engine/worker_guard.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/close_range.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <mutex>
#include <set>
#include <string>

namespace slipcheck {
namespace {

/// "+ GROUP" and "- GROUP" come line by line, until nobody can send more.
constexpr const char* kScript = R"(groups=
while read -r sign group; do
  rest=
  for each in $groups; do [ "$each" = "$group" ] || rest="$rest $each"; done
  groups=$rest
  [ "$sign" = - ] || groups="$groups $group"
done
for each in $groups; do kill -s KILL -- "-$each"; done 2>&-)";

/// In a child of a child, which is nobody's to reap; async-signal-safe functions alone.
[[noreturn]] void become_guard(int input) {
  if (fork() != 0) _exit(0);
  const char* const arguments[] = {"sh", "-c", kScript, nullptr};
  const char* const environment[] = {nullptr};
  setsid();  // a terminal's ^C is not for it
  for (int number = 1; number < NSIG; ++number) signal(number, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  if (input == 0)  // where this program has no input of its own
    fcntl(input, F_SETFD, 0);
  else
    dup2(input, 0);
  close(1);  // nobody waits for the end of an output of this program that the guard would hold
  close(2);
  close_range(3, ~0U, CLOSE_RANGE_CLOEXEC);
  execve("/bin/sh", const_cast<char* const*>(arguments), const_cast<char* const*>(environment));
  _exit(127);
}

/// There is one while there are groups to guard.
class Guard {
 public:
  static Guard& instance() {
    static Guard& guard = *new Guard;  // outlives the workers of static objects
    return guard;
  }

  void take(pid_t group) {
    const std::lock_guard lock(mutex_);
    if (owner_ != getpid()) leave();  // a fork of this program has workers and a guard of its own
    if (socket_ < 0) start();
    groups_.insert(group);
    tell('+', group);
  }

  void release(pid_t group) {
    const std::lock_guard lock(mutex_);
    if (owner_ != getpid() || groups_.erase(group) == 0) return;
    tell('-', group);
    if (groups_.empty()) leave();
  }

 private:
  /// Without a guard, as where there is no shell, workers are killed as far as this program can.
  void start() {
    owner_ = getpid();
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return;
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    const pid_t pid = fork();
    if (pid == 0) become_guard(ends[1]);
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    while (pid > 0 && waitpid(pid, nullptr, 0) < 0 && errno == EINTR) {
    }
    close(ends[1]);
    socket_ = ends[0];
  }

  void tell(char sign, pid_t group) {
    if (socket_ < 0) return;
    const std::string line = fmt::format("{} {}\n", sign, group);
    static_cast<void>(send(socket_, line.data(), line.size(), MSG_NOSIGNAL));
  }

  /// The guard ends with the last one who could tell it anything.
  void leave() {
    if (socket_ >= 0) close(socket_);
    socket_ = -1;
    groups_.clear();
  }

  std::mutex mutex_;
  pid_t owner_ = -1;
  int socket_ = -1;
  std::set<pid_t> groups_;
};

}  // namespace

void guard_group(pid_t group) { Guard::instance().take(group); }
void release_group(pid_t group) { Guard::instance().release(group); }

}  // namespace slipcheck
