#include "report/charts/gnuplot.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <pugixml.hpp>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "base/run_program.h"
#include "base/text.h"
#include "report/charts/gnuplot_script.h"
#include "report/charts/plot_text.h"
#include "report/files/files.h"

namespace slipcheck {
namespace {

namespace fs = std::filesystem;

/// Without the blank lines about it.
std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \n");
  return first == std::string::npos ? "no reason given"
                                    : text.substr(first, text.find_last_not_of(" \n") + 1 - first);
}

/// Runs gnuplot in a folder on its scripts, without the user's own settings; throws
/// std::runtime_error with what it says.
void run_gnuplot(const fs::path& folder, const std::vector<Chart>& charts) {
  std::vector<std::string> words = {"gnuplot", "--default-settings"};
  for (const Chart& chart : charts) words.push_back(chart.name + ".gp");
  ProgramEnd end;
  try {
    end = run_program(words, folder);
  } catch (const std::system_error& error) {
    if (error.code() == std::errc::no_such_file_or_directory)
      throw std::runtime_error(
          "charts as SVG are drawn by gnuplot, which is not there: install gnuplot-nox (Debian) or "
          "gnuplot");
    throw;
  }
  if (end.exit_code != 0)
    throw std::runtime_error(fmt::format("gnuplot failed: {}", trimmed(end.said)));
}

void write_new(const fs::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw WriteFailure(fmt::format("cannot write {}", path.string()));
}

std::string text_of(const pugi::xml_document& svg) {
  std::ostringstream text;
  svg.save(text, "", pugi::format_raw | pugi::format_no_declaration);
  return text.str() + "\n";
}

/// Takes gnuplot's own names and what it does not use away, and gives it the chart's.
class Finisher : public pugi::xml_tree_walker {
 public:
  explicit Finisher(const Chart& chart) : prefix_(chart.name + "-") {}

  bool for_each(pugi::xml_node& node) override {
    const std::string_view name = node.name();
    const bool is_of_plot =
        std::string_view(node.parent().attribute("id").value()).starts_with("gnuplot_");
    const bool is_bare = (name == "g" || name == "tspan") && !node.first_child();
    const bool says_nothing =
        name == "text" && std::ranges::none_of(node.children(), [](const pugi::xml_node& child) {
          return child.type() == pugi::node_pcdata || child.first_child();
        });
    if (name == "filter" || (name == "title" && is_of_plot) || is_bare || says_nothing)
      spare_.push_back(node);
    if (pugi::xml_attribute id = node.attribute("id")) id.set_value((prefix_ + id.value()).c_str());
    if (pugi::xml_attribute link = node.attribute("xlink:href"))
      link.set_value(("#" + prefix_ + (link.value() + 1)).c_str());
    if (name == "tspan") node.remove_attribute("font-family");
    return true;
  }
  void take_away() {
    // What is inside first, and groups that are then empty.
    for (auto node = spare_.rbegin(); node != spare_.rend(); ++node) {
      pugi::xml_node parent = node->parent();
      parent.remove_child(*node);
      while (std::string_view(parent.name()) == "g" && !parent.first_child()) {
        const pugi::xml_node empty = parent;
        parent = parent.parent();
        parent.remove_child(empty);
      }
    }
  }

 private:
  std::string prefix_;
  std::vector<pugi::xml_node> spare_;
};

/// The image of a chart; empty where gnuplot has not drawn it to its end.
std::string finished(const fs::path& path, const Chart& chart) {
  pugi::xml_document svg;
  if (!svg.load_file(path.c_str())) return {};
  pugi::xml_node root = svg.child("svg");
  root.child("title").text() = printable(plain_plot_text(chart.title)).c_str();
  root.child("desc").text() = printable(plain_plot_text(chart.caption)).c_str();
  root.child("title").append_attribute("id") = "title";
  root.append_attribute("role") = "img";
  root.append_attribute("aria-labelledby") = (chart.name + "-title").c_str();
  Finisher finisher(chart);
  root.traverse(finisher);
  finisher.take_away();
  return text_of(svg);
}

}  // namespace

ChartDrawings draw_charts(const std::vector<Chart>& charts) {
  ChartDrawings drawings;
  drawings.svgs.resize(charts.size());
  if (charts.empty()) return drawings;
  try {
    const TemporaryFolder work("slipcheck-charts");
    for (const Chart& chart : charts) {
      const GnuplotScript made = gnuplot_script(chart);
      write_new(work.path() / (chart.name + ".gp"), made.script);
      write_new(work.path() / (chart.name + ".dat"), made.data);
    }
    try {
      run_gnuplot(work.path(), charts);
    } catch (const std::exception& error) {
      drawings.trouble = error.what();
    }
    for (std::size_t k = 0; k < charts.size(); ++k) {
      drawings.svgs[k] = finished(work.path() / (charts[k].name + ".svg"), charts[k]);
      if (drawings.svgs[k].empty() && drawings.trouble.empty())
        drawings.trouble = fmt::format("gnuplot has not drawn {}.svg", charts[k].name);
    }
  } catch (const std::exception& error) {
    drawings.trouble = error.what();
  }
  return drawings;
}

std::string inline_svg(const std::string& svg) {
  pugi::xml_document document;
  document.load_string(svg.c_str());
  pugi::xml_node root = document.child("svg");
  root.remove_attribute("xmlns");
  root.remove_attribute("xmlns:xlink");
  for (const pugi::xpath_node& found : document.select_nodes("//*[@*[name()='xlink:href']]"))
    found.node().attribute("xlink:href").set_name("href");
  return text_of(document);
}

void write_charts(const fs::path& folder, const std::vector<Chart>& charts,
                  const ChartDrawings& drawings, bool with_sources) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw WriteFailure(fmt::format("cannot make {}: {}", folder.string(), error.message()));
  for (std::size_t k = 0; k < charts.size(); ++k) {
    const std::string& name = charts[k].name;
    if (drawings.svgs[k].empty()) continue;
    if (with_sources) {
      const GnuplotScript made = gnuplot_script(charts[k]);
      write_file_atomically(folder / (name + ".dat"), made.data);
      write_file_atomically(folder / (name + ".gp"), made.script);
    }
    write_file_atomically(folder / (name + ".svg"), drawings.svgs[k]);
  }
}

}  // namespace slipcheck
