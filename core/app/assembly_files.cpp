#include "app/assembly_files.h"

#include <filesystem>
#include <memory>
#include <set>
#include <utility>

#include "app/commands.h"
#include "app/output.h"
#include "report/files/assembly_csv.h"
#include "report/files/file_stem.h"
#include "report/files/files.h"
#include "report/files/trajectory_stream.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

struct StreamedScene {
  Scenario scenario;
  TrajectoryStream stream;

  StreamedScene(const Scenario& of, const fs::path& folder, std::string stem,
                TrajectoryStream::Form form)
      : scenario(of), stream(scenario, folder, std::move(stem), form) {}
};

}  // namespace

void AssemblyFiles::add_to(std::map<std::string, ReferenceExtras>& extras,
                           const std::vector<Scenario>& scenarios) const {
  if (folder.empty()) {
    if (!trajectory.empty())
      throw BadOption("--trajectory: needs --assembly, the folder to write to");
    return;
  }
  check_output("--assembly", folder, true);
  fs::create_directories(folder);
  std::set<std::string> taken;
  for (const Scenario& scenario : scenarios) {
    ReferenceExtras& wanted = extras[scenario.name];
    wanted.samples = samples;
    const std::string stem = file_stem(scenario.name, taken);
    if (trajectory.empty()) continue;
    const auto streamed = std::make_shared<StreamedScene>(
        scenario, folder, stem,
        trajectory == "xyz" ? TrajectoryStream::Form::xyz : TrajectoryStream::Form::vtk);
    wanted.states = [streamed](double time, const std::vector<BodyState>& bodies) {
      streamed->stream.add(time, bodies);
    };
    wanted.exchange_states = [streamed](StateArchive& archive) { archive(streamed->stream); };
  }
}

void AssemblyFiles::write(const std::vector<SceneRecord>& scenes) const {
  if (folder.empty()) return;
  std::set<std::string> taken;
  for (const SceneRecord& scene : scenes) {
    const std::string& name = scene.scenario.name;
    const std::string stem = file_stem(name, taken);
    if (!scene.reference.assembly) continue;
    const Assembly& seen = *scene.reference.assembly;
    write_file_atomically(fs::path(folder) / (stem + ".series.csv"),
                          assembly_series_csv(name, seen));
    write_file_atomically(fs::path(folder) / (stem + ".distributions.csv"),
                          assembly_distributions_csv(name, seen));
  }
}

}  // namespace slipcheck
