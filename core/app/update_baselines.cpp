#include "app/update_baselines.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <system_error>

#include "base/regular_file.h"
#include "report/files/files.h"
#include "report/rows/context.h"
#include "report/terminal/text.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

/// The change that is the largest in units of what is allowed; null where nothing is measured.
const Change* largest_of(const CheckReport& report) {
  const Change* largest = nullptr;
  double most = 0;
  for (const SceneCheck& scene : report.scenes)
    for (const Change& change : scene.changes) {
      const double units = std::abs(change.after - change.before) / change.allowed;
      if (!change.gates || !(units > most)) continue;
      most = units;
      largest = &change;
    }
  return largest;
}

/// What a new file begins with.
constexpr const char* kChangesHead =
    "# Changed baselines\n"
    "\n"
    "Why a number of a baseline is not what it was. `slipcheck check --update` appends a line here "
    "with the new\nbaselines; whoever accepts them says why in it.\n"
    "\n";

std::string named(const char* word, const std::vector<std::string>& scenes) {
  constexpr std::size_t kMost = 5;
  if (scenes.size() > kMost) return fmt::format("{} {}", scenes.size(), word);
  return fmt::format("{} {} ({})", scenes.size(), word, fmt::join(scenes, ", "));
}

}  // namespace

std::string changes_text(const fs::path& file) {
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return {};
  return read_regular_file(file, {std::size_t{64} << 20, "lists of changes"});
}

std::string changes_line(const BaselineUpdate& update, const CheckReport& report,
                         const std::string& engines, const std::string& why) {
  const Context& c = context();
  std::vector<std::string> what;
  if (!update.added.empty()) what.push_back(named("new", update.added));
  if (!update.changed.empty()) what.push_back(named("changed", update.changed));
  if (!update.removed.empty()) what.push_back(named("removed", update.removed));
  std::string line =
      fmt::format("- {}, slipcheck {} ({}){}: {}", c.date.substr(0, 10), c.version, c.commit,
                  engines.empty() ? "" : ", " + engines, fmt::join(what, ", "));
  // Scenes and baselines that stand alone are told above.
  std::size_t better = 0, worse = 0, neither = 0;
  for (const SceneCheck& scene : report.scenes)
    for (const Change& change : scene.changes) {
      if (!change.gates || change.statistic == Change::Statistic::presence) continue;
      ++(change.direction == Direction::better  ? better
         : change.direction == Direction::worse ? worse
                                                : neither);
    }
  if (better + worse + neither > 0)
    line += fmt::format("; beyond what is allowed: {} worse, {} better, {} neither", worse, better,
                        neither);
  if (const Change* largest = largest_of(report))
    line += fmt::format("; the largest: {}", change_message(*largest));
  return line + fmt::format(". Why: {}", why.empty() ? "to be told" : printable(why));
}

void write_update(const BaselineUpdate& update, const fs::path& folder, const fs::path& changes,
                  const std::string& line) {
  fs::create_directories(folder);
  for (const auto& [file, text] : update.files) write_file_atomically(file, text);
  for (const fs::path& file : update.left_over) fs::remove(file);
  std::string text = changes_text(changes);
  if (text.empty()) text = kChangesHead;
  if (!text.ends_with('\n')) text += '\n';
  write_file_atomically(changes, text + line + '\n');
}

}  // namespace slipcheck
