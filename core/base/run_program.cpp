#include "base/run_program.h"

#include <fcntl.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

/// A child's standard streams and folder: nothing to read, all that it says into a pipe.
class FileActions {
 public:
  FileActions(const fs::path& folder, int output) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str());
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions_, output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, output, STDERR_FILENO);
  }
  ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_;
};

std::string read_to_end(int descriptor) {
  std::string text;
  char buffer[4096];
  for (ssize_t got; (got = ::read(descriptor, buffer, sizeof buffer)) != 0;) {
    if (got > 0)
      text.append(buffer, static_cast<std::size_t>(got));
    else if (errno != EINTR)
      break;
  }
  return text;
}

}  // namespace

ProgramEnd run_program(std::vector<std::string> words, const fs::path& folder) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    throw std::system_error(errno, std::generic_category(), "cannot make a pipe for " + words[0]);
  pid_t child = -1;
  const int error = ::posix_spawnp(&child, words[0].c_str(), FileActions(folder, ends[1]).get(),
                                   nullptr, arguments.data(), environ);
  ::close(ends[1]);
  ProgramEnd end;
  if (error == 0) end.said = read_to_end(ends[0]);
  ::close(ends[0]);
  if (error != 0)
    throw std::system_error(error, std::generic_category(), "cannot start " + words[0]);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  end.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return end;
}

TemporaryFolder::TemporaryFolder(const std::string& name, const fs::path& parent) {
  std::string path = (parent / (name + "-XXXXXX")).string();
  if (!::mkdtemp(path.data()))
    throw std::system_error(errno, std::generic_category(), "cannot make a folder " + path);
  path_ = path;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace slipcheck
