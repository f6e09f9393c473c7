#include "app/checkpoint_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <ranges>
#include <set>
#include <string_view>
#include <system_error>

#include "app/assembly_files.h"
#include "app/commands.h"
#include "app/output.h"
#include "app/say.h"
#include "base/regular_file.h"
#include "engine/settings.h"
#include "report/files/file_stem.h"
#include "report/files/files.h"
#include "report/rows/context.h"
#include "scenario/content_digest.h"
#include "scenario/file_text.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMagic = "slipcheck-checkpoint/1";
constexpr std::size_t kMostHeader = 512;
constexpr FileLimit kLimit{std::size_t{1} << 40, "checkpoints"};

/// One word, of a build's several.
std::string program() {
  const Context& c = context();
  std::string text = fmt::format("{}+{}+{}", c.version, c.commit, c.build);
  std::ranges::replace(text, ' ', '_');
  return text;
}

std::string scene_of(const Scenario& scenario, bool general, const ReferenceExtras& wanted) {
  return sha256_hex(fmt::format("{} {} {} {} {}", content_digest(scenario), general, wanted.samples,
                                static_cast<bool>(wanted.states), wanted.whole));
}

std::string run_of(const Scenario& scenario, const EngineRecord& run, std::size_t samples) {
  std::string text = fmt::format("{} {} {} {} {} {}", content_digest(scenario), samples, run.engine,
                                 run.precision, run.rate, run.scale);
  for (const auto& [name, value] : run.settings)
    text += fmt::format(" {}={}", name, exact_text(value));
  return sha256_hex(text);
}

std::string text_of(std::string_view scene, std::string_view state) {
  std::string text =
      fmt::format("{} {} {} {} {}\n", kMagic, program(), scene, state.size(), sha256_hex(state));
  text += state;
  return text;
}

/// The state in a file, for this program and scene.
std::string state_in(const fs::path& file, const std::string& name, const std::string& scene) {
  const auto refuse = [&](const std::string& rule) {
    throw BadOption(fmt::format("--resume: {} {}", file.string(), rule));
  };
  std::string text;
  try {
    text = read_regular_file(file, kLimit);
  } catch (const UnreadFile& fault) {
    refuse(fault.what());
  }
  const std::string_view head = std::string_view(text).substr(0, kMostHeader);
  const std::size_t end = head.find('\n');
  std::vector<std::string> words;
  for (const auto word : head.substr(0, end == head.npos ? 0 : end) | std::views::split(' '))
    words.emplace_back(word.begin(), word.end());
  if (words.size() != 5 || words[0] != kMagic)
    refuse(fmt::format("must be a checkpoint, whose first line begins with {}", kMagic));
  if (words[1] != program())
    refuse(fmt::format("is of slipcheck {}, and only the same build can go on with it; this is {}",
                       words[1], program()));
  if (words[2] != scene)
    refuse(
        fmt::format("is of another scene than {} is now, or of another --general, --samples, "
                    "--trajectory, --whole or settings of engines",
                    name));
  std::string state = text.substr(end + 1);
  std::size_t bytes = 0;
  const auto [last, error] =
      std::from_chars(words[3].data(), words[3].data() + words[3].size(), bytes);
  if (error != std::errc() || *last != '\0' || bytes != state.size())
    refuse(fmt::format("is damaged: must hold {} bytes of state, has {}", words[3], state.size()));
  if (words[4] != sha256_hex(state)) refuse("is damaged: its bytes are not those of its SHA-256");
  return state;
}

bool is_there(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(fs::symlink_status(file, ignored));
}

/// Whether it came to no end.
bool can_go_on(const EngineRecord& run) {
  return run.status != EngineRecord::Status::ok && run.status != EngineRecord::Status::unstable;
}

}  // namespace

fs::path CheckpointFiles::file_of(const Scenario& scenario) const {
  std::set<std::string> taken;
  return fs::path(folder) / (file_stem(scenario.name, taken) + ".checkpoint");
}

fs::path CheckpointFiles::file_of(const Scenario& scenario, const EngineRecord& run) const {
  std::set<std::string> taken;
  fs::path file = file_of(scenario);
  file.replace_extension("." + file_stem(words_of(run), taken) + ".checkpoint");
  return file;
}

Checkpoints CheckpointFiles::checkpoints(const fs::path& file, const std::string& name,
                                         const std::string& scene) const {
  Checkpoints checkpoints;
  checkpoints.every = every;
  if (is_there(file)) {
    if (!resume)
      throw BadOption(fmt::format(
          "--checkpoint: {} must not be there yet; --resume goes on from it", file.string()));
    checkpoints.state = state_in(file, name, scene);
  }
  checkpoints.write = [file, scene](std::string_view state) {
    write_file_atomically(file, text_of(scene, state));
  };
  return checkpoints;
}

void CheckpointFiles::add_to(std::map<std::string, ReferenceExtras>& extras,
                             const std::vector<Scenario>& scenarios) const {
  if (folder.empty()) return;
  check_output("--checkpoint", folder, true);
  std::set<fs::path> files;
  for (const Scenario& scenario : scenarios) {
    const fs::path file = file_of(scenario);
    if (!files.insert(file).second)
      throw BadOption(fmt::format("--checkpoint: {} would be of two scenes, one of them {}",
                                  file.string(), scenario.name));
    ReferenceExtras& wanted = extras[scenario.name];
    wanted.checkpoints = checkpoints(file, scenario.name, scene_of(scenario, general, wanted));
  }
  fs::create_directories(folder);
}

std::function<Checkpoints(const Scenario&, const EngineRecord&)> CheckpointFiles::of_runs(
    const std::map<std::string, ReferenceExtras>& extras) const {
  if (folder.empty()) return {};
  const auto files = std::make_shared<std::set<fs::path>>();
  return [this, &extras, files](const Scenario& scenario, const EngineRecord& run) {
    const fs::path file = file_of(scenario, run);
    if (!files->insert(file).second)
      throw BadOption(fmt::format("--checkpoint: {} would be of two runs of {} in {}",
                                  file.string(), run.engine, scenario.name));
    return checkpoints(file, scenario.name,
                       run_of(scenario, run, extras.at(scenario.name).samples));
  };
}

void CheckpointFiles::settle(const std::vector<SceneRecord>& scenes) const {
  if (folder.empty()) return;
  for (const SceneRecord& scene : scenes) {
    const Scenario& scenario = scene.scenario;
    std::vector<fs::path> kept, going_on;
    const auto sort = [&](const fs::path& file, bool goes_on) {
      if (!is_there(file)) return;
      kept.push_back(file);
      if (goes_on) going_on.push_back(file);
    };
    sort(file_of(scenario), scene.reference.run.failed);
    for (const EngineRecord& run : scene.runs) sort(file_of(scenario, run), can_go_on(run));
    // What has come to its end is not to be done again either where another goes on.
    if (going_on.empty())
      for (const fs::path& file : kept) {
        std::error_code ignored;
        fs::remove(file, ignored);
      }
    for (const fs::path& file : going_on)
      say("{}: its state is kept in {}; --resume goes on from there\n", scenario.name,
          file.string());
  }
}

}  // namespace slipcheck
