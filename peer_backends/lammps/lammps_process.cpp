#include "peer_backends/lammps/lammps_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

namespace slipcheck::lammps {
namespace {

struct Pipe {
  Pipe() {
    std::array<int, 2> ends;
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw LammpsError("no pipe can be made");
    read = ends[0];
    write = ends[1];
  }
  int read, write;
};

/// In the child: never returns. stdbuf makes lmp say each line when it has it.
[[noreturn]] void become_lammps(int ranks, int commands, int words) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  signal(SIGPIPE, SIG_DFL);
  dup2(commands, STDIN_FILENO);
  dup2(words, STDOUT_FILENO);
  setenv("OMP_NUM_THREADS", "1", 0);
  setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 0);  // mpirun refuses it otherwise, and containers run so
  setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 0);
  // Open MPI's directory of a session lies in one that all share, which the last to end removes
  // while another begins and then fails. One rank alone has no need of any.
  if (ranks > 1) {
    const std::string own = fmt::format("slipcheck-lammps-{}", getpid());
    setenv("OMPI_MCA_orte_top_session_dir", (std::filesystem::temp_directory_path() / own).c_str(),
           0);
  } else {
    setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
  }
  const std::string count = std::to_string(ranks);
  std::vector<const char*> words_of = {"stdbuf", "-oL"};
  if (ranks > 1)
    words_of.insert(words_of.end(), {"mpirun", "--oversubscribe", "-n", count.c_str()});
  words_of.insert(words_of.end(), {"lmp", "-log", "none", "-nocite", nullptr});
  std::vector<char*> arguments;
  for (const char* word : words_of) arguments.push_back(const_cast<char*>(word));
  execvp(arguments[0], arguments.data());
  _exit(127);
}

/// Takes a whole line off the front, without its end.
std::optional<std::string> take_line(std::string& text) {
  const std::size_t end = text.find('\n');
  if (end == std::string::npos) return std::nullopt;
  std::string line = text.substr(0, end);
  text.erase(0, end + 1);
  return line;
}

double number_before(std::string_view line, std::string_view what) {
  const std::size_t at = line.find(what);
  std::size_t begin = line.find_last_of(' ', at);
  begin = begin == std::string_view::npos ? 0 : begin + 1;
  double value = 0;
  std::from_chars(line.data() + begin, line.data() + at, value);
  return value;
}

double number_after(std::string_view line, std::string_view what) {
  double value = 0;
  const std::size_t at = line.find(what) + what.size();
  std::from_chars(line.data() + at, line.data() + line.size(), value);
  return value;
}

/// The snapshots at the front: a header of nine lines, of which the second is the step.
constexpr std::size_t kHeaderLines = 9;

/// Where the line after `count` lines from `begin` on starts, npos where they are not all there.
std::size_t after_lines(const std::string& text, std::size_t begin, std::size_t count) {
  for (; count > 0 && begin != std::string::npos; --count) {
    begin = text.find('\n', begin);
    if (begin != std::string::npos) ++begin;
  }
  return begin;
}

/// id and nine numbers in each line.
void read_states(const char* at, const char* end, std::vector<BodyState>& states) {
  const auto number = [&] {
    while (at < end && (*at == ' ' || *at == '\n')) ++at;
    double value = 0;
    at = std::from_chars(at, end, value).ptr;
    return value;
  };
  for (BodyState& state : states) {
    number();
    for (Vector3* vector : {&state.position, &state.velocity, &state.angular_velocity})
      for (int k = 0; k < 3; ++k) (*vector)[k] = number();
  }
}

}  // namespace

LammpsProcess::LammpsProcess(int ranks) {
  const Pipe commands, words, snapshots;
  process_ = fork();
  if (process_ < 0) throw LammpsError("no process can be made");
  if (process_ == 0) become_lammps(ranks, commands.read, words.write);
  close(commands.read);
  close(words.write);
  commands_ = commands.write;
  words_ = words.read;
  snapshots_ = snapshots.read;
  snapshots_write_ = snapshots.write;
  for (const int end : {words_, snapshots_}) fcntl(end, F_SETFL, O_NONBLOCK);
  constexpr int kRoom =
      1 << 20;  // many bodies: fewer turns to and fro; where it is not given, more
  fcntl(snapshots_write_, F_SETPIPE_SZ, kRoom);
  snapshot_file_ = fmt::format("/proc/{}/fd/{}", getpid(), snapshots_write_);
}

LammpsProcess::~LammpsProcess() {
  forget_file();
  for (const int end : {commands_, words_, snapshots_, snapshots_write_}) close(end);
  if (process_ < 0) return;
  // Without commands it ends by itself, and mpirun with it, which so tidies up.
  for (int k = 0; k < 200; ++k) {
    if (waitpid(process_, nullptr, WNOHANG) != 0) return;
    usleep(10000);
  }
  kill(process_, SIGKILL);
  waitpid(process_, nullptr, 0);
}

void LammpsProcess::send(const std::string& commands) {
  std::size_t sent = 0;
  while (sent < commands.size()) {
    const ssize_t n = write(commands_, commands.data() + sent, commands.size() - sent);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) fail();
    sent += static_cast<std::size_t>(n);
  }
}

std::string LammpsProcess::keep_file(std::string_view text) {
  forget_file();
  file_ = memfd_create("bodies", MFD_CLOEXEC);
  if (file_ < 0) throw LammpsError("no file in memory can be made");
  while (!text.empty()) {
    const ssize_t n = write(file_, text.data(), text.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) throw LammpsError("a file in memory cannot hold the bodies");
    text.remove_prefix(static_cast<std::size_t>(n));
  }
  return fmt::format("/proc/{}/fd/{}", getpid(), file_);
}

void LammpsProcess::forget_file() {
  if (file_ >= 0) close(file_);
  file_ = -1;
}

void LammpsProcess::wait() {
  std::array<pollfd, 2> ends = {{{words_, POLLIN, 0}, {snapshots_, POLLIN, 0}}};
  poll(ends.data(), ends.size(), -1);
  std::array<char, 65536> buffer;
  for (auto [end, text] : {std::pair{snapshots_, &frames_}, std::pair{words_, &said_}}) {
    ssize_t n;
    while ((n = read(end, buffer.data(), buffer.size())) > 0)
      text->append(buffer.data(), static_cast<std::size_t>(n));
    if (n == 0 && end == words_) ended_ = true;
  }
}

void LammpsProcess::fail() {
  while (!ended_) wait();
  while (const auto line = take_line(said_))
    if (line->find("ERROR") != std::string::npos && error_.empty()) error_ = *line;
  throw LammpsError(error_.empty() ? reap() : error_);
}

/// How it ended, of one that has closed its output.
std::string LammpsProcess::reap() {
  int status = 0;
  waitpid(std::exchange(process_, -1), &status, 0);
  if (WIFSIGNALED(status)) return fmt::format("lmp was ended by signal {}", WTERMSIG(status));
  constexpr int kNotFound = 127;  // as become_lammps() and stdbuf say it
  if (WEXITSTATUS(status) == kNotFound) return "lmp was not found: is it installed?";
  return fmt::format("lmp ended with exit code {}", WEXITSTATUS(status));
}

double LammpsProcess::finish_run() {
  double loop = 0, ranks = 1;
  while (true) {
    while (const auto line = take_line(said_)) {
      if (line->find("ERROR") != std::string::npos) {
        error_ = *line;
        fail();
      }
      if (line->starts_with("Loop time of ")) {
        loop = number_after(*line, "Loop time of ");
        ranks = number_after(*line, " on ");
      }
      // "99.6% CPU use with 1 MPI tasks", the mean over them.
      if (line->find("% CPU use") != std::string::npos)
        return loop * ranks * number_before(*line, "% CPU use") / 100;
    }
    if (ended_) fail();
    wait();
  }
}

void LammpsProcess::read_snapshot(long step, std::vector<BodyState>& states, std::size_t bodies) {
  states.resize(bodies);
  while (true) {
    std::size_t begin = 0;
    while (true) {
      const std::size_t rows = after_lines(frames_, begin, kHeaderLines);
      const std::size_t end = after_lines(frames_, rows, bodies);
      if (end == std::string::npos) break;
      const std::size_t number = after_lines(frames_, begin, 1);
      const bool is_it = std::strtol(frames_.c_str() + number, nullptr, 10) == step;
      if (is_it) read_states(frames_.data() + rows, frames_.data() + end, states);
      begin = end;
      if (is_it) {
        frames_.erase(0, begin);
        return;
      }
    }
    frames_.erase(0, begin);
    if (ended_) fail();
    wait();
  }
}

}  // namespace slipcheck::lammps
