#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/output.h"
#include "app/progress_bar.h"
#include "app/say.h"
#include "base/stop_scope.h"
#include "figures/paper_figures.h"
#include "report/files/csv.h"
#include "report/files/files.h"
#include "report/html/figure_page.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

struct FiguresArguments {
  std::string directory;
  std::vector<std::string> only;
  bool full = false;
  bool quiet = false;
};

std::vector<std::string> known_names() {
  std::vector<std::string> names;
  for (const PaperFigureMaker& maker : paper_figures()) names.emplace_back(maker.name);
  return names;
}

/// Those asked for in the papers' order. Throws BadOption for names that no figure has.
std::vector<PaperFigureMaker> chosen(const std::vector<std::string>& only) {
  const std::vector<std::string> known = known_names();
  for (const std::string& name : only)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw BadOption(fmt::format("--only: must be of {}, got {}", fmt::join(known, ", "), name));
  std::vector<PaperFigureMaker> makers;
  for (const PaperFigureMaker& maker : paper_figures())
    if (only.empty() || std::find(only.begin(), only.end(), maker.name) != only.end())
      makers.push_back(maker);
  return makers;
}

int draw(const FiguresArguments& arguments) {
  const std::vector<PaperFigureMaker> makers = chosen(arguments.only);
  const fs::path directory = arguments.directory;
  check_output("DIR", directory, true);
  fs::create_directories(directory);

  watch_for_interrupts();
  std::vector<PaperFigure> figures;
  {
    ProgressBar bar("drawing", !arguments.quiet);
    for (const PaperFigureMaker& maker : makers) {
      if (interrupted()) break;
      bar.set(figures.size(), makers.size());
      PaperFigure figure;
      try {
        figure = maker.make(arguments.full ? Effort::full : Effort::brief);
      } catch (const Interrupted&) {
        break;
      }
      write_file_atomically(directory / (figure.name + ".csv"), csv_text(figure.table));
      figures.push_back(std::move(figure));
    }
  }
  const std::vector<Chart> page(figures.begin(), figures.end());
  const ChartDrawings drawn = write_charts_if_drawn(directory, page);
  if (interrupted()) {
    if (!arguments.quiet) say("interrupted: what had finished is kept\n");
    return kInterrupted;
  }
  // These are of all figures; a few of them do not replace them.
  if (!arguments.only.empty()) return kWithinTolerance;
  write_file_atomically(directory / "stated.csv", stated_csv(figures));
  write_file_atomically(directory / "figures.md",
                        figures_markdown(figures, kPaperFiguresIntroduction));
  const fs::path index = directory / "index.html";
  write_file_atomically(index, figure_page(page, drawn, kPaperFiguresIntroduction,
                                           "slipcheck figures " + arguments.directory +
                                               (arguments.full ? " --full" : "")));
  if (!arguments.quiet) fmt::print("{}\n", index.string());
  return kWithinTolerance;
}

}  // namespace

void add_figures_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "figures", "Compute the papers' figures anew, as SVG and CSV with the closed forms beside");
  auto arguments = std::make_shared<FiguresArguments>();
  command->add_option("DIR", arguments->directory, "Where the files go; made if need be")
      ->required();
  command
      ->add_option("--only", arguments->only,
                   fmt::format("Only these, of {}; index.html is then left alone",
                               fmt::join(known_names(), ", ")))
      ->delimiter(',');
  command->add_flag(
      "--full", arguments->full,
      "Long runs of the vibrated boxes: more points, errors a third as large, minutes");
  command->add_flag("-q,--quiet", arguments->quiet, "No progress; the exit code tells");
  command->footer(
      "Examples:\n"
      "  slipcheck figures results/figures\n"
      "  slipcheck figures /tmp/figures --only K5,B1");
  command->callback([arguments, &exit_code] { exit_code = draw(*arguments); });
}

}  // namespace slipcheck
