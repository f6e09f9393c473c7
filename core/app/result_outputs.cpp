#include "app/result_outputs.h"

#include <fmt/format.h>

#include <filesystem>
#include <set>
#include <stdexcept>
#include <utility>

#include "app/output.h"
#include "report/charts/gnuplot.h"
#include "report/charts/report_charts.h"
#include "report/files/extended_xyz.h"
#include "report/files/file_stem.h"
#include "report/files/files.h"
#include "report/files/junit.h"
#include "report/files/markdown.h"
#include "report/files/result_csv.h"
#include "report/files/vtk_files.h"
#include "report/html/report_page.h"
#include "report/rows/summary.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

using NamedTexts = std::vector<std::pair<std::string, std::string>>;

/// Writes the files that `files_of` makes of each recorded motion of each scene.
void write_motions(const fs::path& folder, const std::vector<SceneRecord>& scenes,
                   NamedTexts (*files_of)(const Scenario& scenario, const RecordedMotion& motion,
                                          const std::string& stem)) {
  fs::create_directories(folder);
  std::set<std::string> taken;
  const auto write = [&](const Scenario& scenario, const RecordedMotion& motion,
                         const std::string& name) {
    for (const auto& [file, text] : files_of(scenario, motion, file_stem(name, taken)))
      write_file_atomically(folder / file, text);
  };
  for (const SceneRecord& scene : scenes) {
    const std::string& name = scene.scenario.name;
    if (scene.reference.motion) write(scene.scenario, *scene.reference.motion, name + "-reference");
    for (const EngineRecord& run : scene.runs)
      for (const RecordedMotion& motion : run.motions)
        write(scene.scenario, motion,
              fmt::format("{}-{}-{}-{}-{:g}Hz{}-{}", name, run.engine, run.precision, run.profile,
                          run.rate, run.scale == 1 ? "" : fmt::format("-scale{:g}", run.scale),
                          motion.role));
  }
}

NamedTexts xyz_files_of(const Scenario& scenario, const RecordedMotion& motion,
                        const std::string& stem) {
  return {{stem + ".xyz", xyz_of(scenario, motion)}};
}

/// An option, and the file or folder that it names.
struct Writer {
  const char* option;
  const char* about;
  std::string ResultOutputs::*path;
  std::string (*text_of)(const ReportContent& content, const ResultOutputs& outputs);
  void (*write_folder)(const fs::path& folder, const ReportContent& content) = nullptr;
};

/// In the order in which they are written: that of gnuplot may fail and is the last.
constexpr Writer kWriters[] = {
    {"--html", "Write one self-contained page here", &ResultOutputs::html,
     [](const auto& content, const auto& outputs) {
       return report_page(content,
                          outputs.without_script ? PageScript::left_out : PageScript::included);
     }},
    {"--csv", "Write a table: a row for each run and observable", &ResultOutputs::csv,
     [](const auto& content, const auto&) { return results_csv(content.scenes); }},
    {"--phases-csv", "Write a table: a row for each phase of an observable with a tolerance",
     &ResultOutputs::phases_csv,
     [](const auto& content, const auto&) { return phases_csv(content.scenes); }},
    {"--markdown", "Write a summary that fits a pull request's comment", &ResultOutputs::markdown,
     [](const auto& content, const auto&) { return markdown_of(content.scenes, content.moved); }},
    {"--engines-markdown", "Write scenes by engines, with a score for each",
     &ResultOutputs::engines,
     [](const auto& content, const auto&) { return engines_markdown(content.scenes); }},
    {"--junit", "Write JUnit XML: a test for each run", &ResultOutputs::junit,
     [](const auto& content, const auto& outputs) {
       return junit_xml(test_outcomes(content.scenes, outputs.allow_undecided),
                        "slipcheck: " + summarize(content.scenes).heading);
     }},
    {"--xyz", "Write a folder of trajectories as extended XYZ, for OVITO", &ResultOutputs::xyz,
     nullptr,
     [](const auto& folder, const auto& content) {
       write_motions(folder, content.scenes, xyz_files_of);
     }},
    {"--vtk", "Write a folder of trajectories as PVD and VTP, for ParaView", &ResultOutputs::vtk,
     nullptr,
     [](const auto& folder, const auto& content) {
       write_motions(folder, content.scenes, vtk_files_of);
     }},
    {"--svg", "Write a folder of charts for papers, by gnuplot, with data and scripts",
     &ResultOutputs::svg, nullptr,
     [](const auto& folder, const auto& content) {
       const std::vector<Chart> charts = report_charts(content, ChartExtent::all).all();
       const ChartDrawings drawings = draw_charts(charts);
       if (!drawings.trouble.empty()) throw std::runtime_error(drawings.trouble);
       write_charts(folder, charts, drawings, true);
     }},
};

}  // namespace

bool ResultOutputs::show_motion() const {
  return !html.empty() || !svg.empty() || !xyz.empty() || !vtk.empty();
}

void add_result_outputs(CLI::App& command, ResultOutputs& outputs, const std::string& page_option) {
  for (const Writer& writer : kWriters)
    command.add_option(writer.path == &ResultOutputs::html ? page_option : writer.option,
                       outputs.*writer.path, writer.about);
  command.add_flag("--without-script", outputs.without_script,
                   "The page has its tables and drawings, charts that stand still, and no replay");
  command.add_flag("--allow-undecided", outputs.allow_undecided,
                   "A tolerance by which nothing can be judged is no failure");
}

void check_outputs(const ResultOutputs& outputs) {
  for (const Writer& writer : kWriters)
    check_output(writer.option, outputs.*writer.path, writer.write_folder != nullptr);
}

void write_outputs(const ResultOutputs& outputs, const ReportContent& content) {
  for (const Writer& writer : kWriters) {
    const std::string& path = outputs.*writer.path;
    if (path.empty()) continue;
    if (writer.write_folder)
      writer.write_folder(path, content);
    else
      write_file_atomically(path, writer.text_of(content, outputs));
  }
}

}  // namespace slipcheck
