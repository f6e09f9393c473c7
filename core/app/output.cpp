#include "app/output.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <charconv>
#include <cstdlib>
#include <string_view>
#include <system_error>

#include "app/commands.h"
#include "app/progress_bar.h"
#include "app/say.h"
#include "report/files/files.h"

namespace slipcheck {

namespace fs = std::filesystem;

namespace {

void check_folder(const std::string& option, const fs::path& path) {
  std::error_code ignored;
  if (fs::exists(path, ignored) && !fs::is_directory(path, ignored))
    throw BadOption(fmt::format("{}: must be a directory, got {}", option, path.string()));
  if (const std::string why = why_not_writable(path); !why.empty())
    throw BadOption(fmt::format("{}: must be a directory that can be written to, got {}: {}",
                                option, path.string(), why));
}

void check_file(const std::string& option, const fs::path& path) {
  std::error_code ignored;
  const bool exists = fs::exists(path, ignored);
  if (fs::is_directory(path, ignored))
    throw BadOption(fmt::format("{}: must be a file, got {}", option, path.string()));
  if (exists && !fs::is_regular_file(path, ignored)) {
    if (access(path.c_str(), W_OK) != 0)
      throw BadOption(fmt::format("{}: must be writable, got {}", option, path.string()));
    return;
  }
  const fs::path target = exists ? fs::canonical(path, ignored) : path;
  const fs::path parent = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!fs::is_directory(parent, ignored))
    throw BadOption(fmt::format("{}: its directory must exist, got {}", option, path.string()));
  if (const std::string why = why_not_writable(parent); !why.empty())
    throw BadOption(
        fmt::format("{}: its directory must be writable, got {}: {}", option, path.string(), why));
}

/// What COLUMNS says; 0 where it says nothing sensible.
int columns_wanted() {
  const char* text = std::getenv("COLUMNS");
  if (text == nullptr) return 0;
  const std::string_view written = text;
  int columns = 0;
  const auto [end, error] =
      std::from_chars(written.data(), written.data() + written.size(), columns);
  const bool is_number = error == std::errc() && end == written.data() + written.size();
  return is_number && columns >= 20 && columns <= 10000 ? columns : 0;
}

}  // namespace

void check_output(const std::string& option, const fs::path& path, bool is_directory) {
  if (path.empty() || path == "-") return;
  if (is_directory)
    check_folder(option, path);
  else
    check_file(option, path);
}

void write_json(const std::string& path, const std::function<std::string()>& text) {
  if (path == "-")
    fmt::print("{}", text());
  else if (!path.empty())
    write_file_atomically(path, text());
}

ChartDrawings write_charts_if_drawn(const fs::path& folder, const std::vector<Chart>& charts) {
  ChartDrawings drawings = draw_charts(charts);
  write_charts(folder, charts, drawings, false);
  if (!drawings.trouble.empty()) say("slipcheck: without some charts: {}\n", drawings.trouble);
  return drawings;
}

TableStyle table_style(bool all) {
  TableStyle style;
  style.colour = is_plain_terminal(STDOUT_FILENO);
  winsize size{};
  const bool is_terminal = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  const int columns = columns_wanted();
  style.width = columns > 0 ? columns : is_terminal ? size.ws_col : 100;
  style.is_bound = columns > 0 || is_terminal;
  style.all_observables = all;
  return style;
}

}  // namespace slipcheck
