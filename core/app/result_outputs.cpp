#include "app/result_outputs.h"

#include <fmt/format.h>

#include <filesystem>
#include <set>
#include <string_view>

#include "app/output.h"
#include "report/charts/gnuplot_charts.h"
#include "report/files/extended_xyz.h"
#include "report/files/file_stem.h"
#include "report/files/files.h"
#include "report/files/junit.h"
#include "report/files/markdown.h"
#include "report/files/result_csv.h"
#include "report/files/vtk_files.h"
#include "report/html/report_page.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

/// Gives each recorded motion of each scene, with the name of its file, to `take`.
template <class Take>
void for_each_motion(const std::vector<SceneRecord>& scenes, Take&& take) {
  std::set<std::string> taken;
  for (const SceneRecord& scene : scenes) {
    const std::string& name = scene.scenario.name;
    if (scene.reference.motion)
      take(scene.scenario, *scene.reference.motion, file_stem(name + "-reference", taken));
    for (const EngineRecord& run : scene.runs)
      for (const RecordedMotion& motion : run.motions)
        take(scene.scenario, motion,
             file_stem(fmt::format("{}-{}-{}-{}-{:g}Hz-{}", name, run.engine, run.precision,
                                   run.profile, run.rate, motion.role),
                       taken));
  }
}

void write_xyz(const fs::path& folder, const std::vector<SceneRecord>& scenes) {
  fs::create_directories(folder);
  for_each_motion(
      scenes, [&](const Scenario& scenario, const RecordedMotion& motion, const std::string& stem) {
        write_file_atomically(folder / (stem + ".xyz"), xyz_of(scenario, motion));
      });
}

void write_vtk(const fs::path& folder, const std::vector<SceneRecord>& scenes) {
  fs::create_directories(folder);
  for_each_motion(
      scenes, [&](const Scenario& scenario, const RecordedMotion& motion, const std::string& stem) {
        for (const auto& [name, text] : vtk_files_of(scenario, motion, stem))
          write_file_atomically(folder / name, text);
      });
}

}  // namespace

bool ResultOutputs::show_motion() const {
  return !html.empty() || !svg.empty() || !xyz.empty() || !vtk.empty();
}

void add_result_outputs(CLI::App& command, ResultOutputs& outputs, const std::string& page_option) {
  command.add_option(page_option, outputs.html, "Write one self-contained page here");
  command.add_flag("--without-script", outputs.without_script,
                   "The page has its tables and drawings, but no charts and no replay");
  command.add_option("--csv", outputs.csv, "Write a table: a row for each run and observable");
  command.add_option("--phases-csv", outputs.phases_csv,
                     "Write a table: a row for each phase of an observable with a tolerance");
  command.add_option("--markdown", outputs.markdown,
                     "Write a summary that fits a pull request's comment");
  command.add_option("--junit", outputs.junit, "Write JUnit XML: a test for each run");
  command.add_flag("--allow-undecided", outputs.allow_undecided,
                   "A tolerance by which nothing can be judged is no failure");
  command.add_option("--svg", outputs.svg,
                     "Write a folder of charts for papers, by gnuplot, with data and scripts");
  command.add_option("--xyz", outputs.xyz,
                     "Write a folder of trajectories as extended XYZ, for OVITO");
  command.add_option("--vtk", outputs.vtk,
                     "Write a folder of trajectories as PVD and VTP, for ParaView");
}

void check_outputs(const ResultOutputs& outputs) {
  const auto check = [](const char* option, const std::string& path, bool is_folder) {
    if (!path.empty()) check_output(option, path, is_folder);
  };
  check("--html", outputs.html, false);
  check("--csv", outputs.csv, false);
  check("--phases-csv", outputs.phases_csv, false);
  check("--markdown", outputs.markdown, false);
  check("--junit", outputs.junit, false);
  check("--svg", outputs.svg, true);
  check("--xyz", outputs.xyz, true);
  check("--vtk", outputs.vtk, true);
}

void write_outputs(const ResultOutputs& outputs, const ReportContent& content) {
  const std::vector<SceneRecord>& scenes = content.scenes;
  if (!outputs.csv.empty()) write_file_atomically(outputs.csv, results_csv(scenes));
  if (!outputs.phases_csv.empty()) write_file_atomically(outputs.phases_csv, phases_csv(scenes));
  if (!outputs.markdown.empty()) write_file_atomically(outputs.markdown, markdown_of(scenes));
  if (!outputs.junit.empty())
    write_file_atomically(outputs.junit, junit_xml(test_outcomes(scenes, outputs.allow_undecided)));
  if (!outputs.html.empty())
    write_file_atomically(
        outputs.html,
        report_page(content, outputs.without_script ? PageScript::left_out : PageScript::included));
  if (!outputs.xyz.empty()) write_xyz(outputs.xyz, scenes);
  if (!outputs.vtk.empty()) write_vtk(outputs.vtk, scenes);
  if (!outputs.svg.empty()) write_gnuplot_charts(outputs.svg, content);
}

}  // namespace slipcheck
