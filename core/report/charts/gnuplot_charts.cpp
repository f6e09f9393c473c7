#include "report/charts/gnuplot_charts.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "report/charts/gnuplot_scenes.h"
#include "report/charts/gnuplot_studies.h"
#include "report/files/files.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

/// A folder that goes away with all that is in it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "slipcheck-charts-XXXXXX").string();
    if (!::mkdtemp(name.data()))
      throw std::system_error(errno, std::generic_category(), "cannot make a folder for charts");
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

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

std::string read_all(int descriptor) {
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

/// Without the blank lines about it.
std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \n");
  return first == std::string::npos ? "no reason given"
                                    : text.substr(first, text.find_last_not_of(" \n") + 1 - first);
}

/// Runs gnuplot in a folder on its scripts, without the user's own settings; throws
/// std::runtime_error with what it says.
void run_gnuplot(const fs::path& folder, const std::vector<GnuplotChart>& charts) {
  std::vector<std::string> words = {"gnuplot", "--default-settings"};
  for (const GnuplotChart& chart : charts) words.push_back(chart.name + ".gp");
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    throw std::system_error(errno, std::generic_category(), "cannot make a pipe for gnuplot");
  pid_t child = -1;
  const int error = ::posix_spawnp(&child, "gnuplot", FileActions(folder, ends[1]).get(), nullptr,
                                   arguments.data(), environ);
  ::close(ends[1]);
  const std::string said = error == 0 ? read_all(ends[0]) : "";
  ::close(ends[0]);
  if (error == ENOENT)
    throw std::runtime_error(
        "charts as SVG are drawn by gnuplot, which is not there: install gnuplot-nox (Debian) or "
        "gnuplot");
  if (error != 0)
    throw std::runtime_error(
        fmt::format("cannot start gnuplot: {}", std::generic_category().message(error)));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw std::runtime_error(fmt::format("gnuplot failed: {}", trimmed(said)));
}

void write_new(const fs::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw WriteFailure(fmt::format("cannot write {}", path.string()));
}

std::string read_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file || text.str().empty())
    throw std::runtime_error(fmt::format("gnuplot has not drawn {}", path.filename().string()));
  return text.str();
}

}  // namespace

std::vector<GnuplotChart> gnuplot_charts(const ReportContent& content) {
  std::set<std::string> taken;
  std::vector<GnuplotChart> charts;
  for (const SceneRecord& scene : content.scenes) add_scene_charts(scene, taken, charts);
  for (const PrecisionScene& scene : content.precision) add_precision_charts(scene, taken, charts);
  add_stability_charts(content.limits, taken, charts);
  return charts;
}

void write_gnuplot_charts(const fs::path& folder, const ReportContent& content) {
  const std::vector<GnuplotChart> charts = gnuplot_charts(content);
  const TemporaryFolder work;
  for (const GnuplotChart& chart : charts) {
    write_new(work.path() / (chart.name + ".gp"), chart.script);
    for (const auto& [name, text] : chart.data) write_new(work.path() / name, text);
  }
  if (!charts.empty()) run_gnuplot(work.path(), charts);
  std::vector<std::string> drawings;
  for (const GnuplotChart& chart : charts)
    drawings.push_back(read_file(work.path() / (chart.name + ".svg")));

  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw WriteFailure(fmt::format("cannot make {}: {}", folder.string(), error.message()));
  for (std::size_t k = 0; k < charts.size(); ++k) {
    for (const auto& [name, text] : charts[k].data) write_file_atomically(folder / name, text);
    write_file_atomically(folder / (charts[k].name + ".gp"), charts[k].script);
    write_file_atomically(folder / (charts[k].name + ".svg"), drawings[k]);
  }
}

}  // namespace slipcheck
