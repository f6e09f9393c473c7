#include "report/charts/gnuplot_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/text.h"
#include "report/charts/gnuplot_parts.h"
#include "report/charts/heat_colours.h"
#include "report/charts/plot_text.h"

namespace slipcheck {
namespace {

// All in px at an image width of 760.
constexpr double kSample = 34, kLegendLine = 20;  // of the legend
constexpr double kTitleShare = 1.25;              // of the frame, for titles and labels
constexpr double kLeastCell = 9;                  // that has room for a letter

constexpr const char* kFrame = "#5c5c5c";
constexpr const char* kTint = "fillcolor rgb '#009e73' fillstyle transparent solid 0.18 noborder";

/// Both files of one chart, as they grow.
class ScriptWriter {
 public:
  explicit ScriptWriter(const Chart& chart) : chart_(&chart) {}
  GnuplotScript write();

 private:
  template <typename... Values>
  void line(fmt::format_string<Values...> format, Values&&... values) {
    script_ += fmt::format(format, std::forward<Values>(values)...) + "\n";
  }
  /// A block of data under a comment, and how a plot names it.
  std::string block(const std::string& comment, const std::string& rows);
  void add_plot(const std::string& plot) { plots_.push_back(plot); }
  void finish_plot();

  void place(const ChartPlace& frame);
  void set_axis(char name, const AxisSpec& axis, const AxisRange& range, double room);
  void add_colours(const ColourMap& map, const Panel& panel, const ChartPlace& frame);
  void add_cells(const Panel& panel, const ChartPlace& frame);
  void add_curve(const Curve& curve);
  void draw_panel(const Panel& panel, const ChartPlace& frame);
  void draw_legend(const ChartPlace& frame);

  const Chart* chart_;
  double height_ = 0;
  std::string script_, data_;
  int blocks_ = 0;
  std::vector<std::string> plots_;
  AxisRange x_{0, 1}, y_{0, 1};  // of the panel that is drawn
};

std::string ScriptWriter::block(const std::string& comment, const std::string& rows) {
  data_ += fmt::format("{}# {}\n{}", blocks_ > 0 ? "\n\n" : "", printable(comment),
                       rows.empty() ? "NaN NaN\n" : rows);
  return fmt::format("data index {}", blocks_++);
}

void ScriptWriter::finish_plot() {
  script_ += "plot NaN notitle";
  for (const std::string& plot : plots_) script_ += ", \\\n  " + plot + " notitle";
  script_ += "\n";
  plots_.clear();
}

void ScriptWriter::place(const ChartPlace& frame) {
  line("set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}", frame.left / kChartWidth,
       (frame.left + frame.width) / kChartWidth);
  line("set tmargin at screen {:.5f}\nset bmargin at screen {:.5f}", 1 - frame.top / height_,
       1 - (frame.top + frame.height) / height_);
  line("unset logscale\nunset label\nunset arrow\nunset object\nunset colorbox\nunset x2tics");
}

void ScriptWriter::set_axis(char name, const AxisSpec& axis, const AxisRange& range, double room) {
  line("set {}label {} font ',13' offset {}", name, gnuplot_text(fitted_text(axis.label, room)),
       name == 'x' ? "0, 0.5" : "0.8, 0");
  const bool is_reversed = name == 'y' && !axis.names.empty();
  line("set {}range [{}:{}]", name, gnuplot_number(is_reversed ? range.high : range.low),
       gnuplot_number(is_reversed ? range.low : range.high));
  line("unset {}tics", name);
  if (axis.logarithmic) {
    line("set logscale {0}\nset {0}tics nomirror in ({1})", name, gnuplot_logarithmic_ticks(range));
  } else if (axis.names.empty()) {
    line("set {0}tics nomirror in autofreq\nset format {0} '%g'", name);
  } else if (name == 'y') {
    line("set ytics nomirror scale 0 ({})", gnuplot_named_ticks(axis.names));
  } else {
    line("set x2range [{}:{}]\nset x2tics nomirror scale 0 rotate by 60 left ({})",
         gnuplot_number(range.low), gnuplot_number(range.high), gnuplot_named_ticks(axis.names));
  }
}

void ScriptWriter::add_colours(const ColourMap& map, const Panel& panel, const ChartPlace& frame) {
  const std::vector<double> x = cell_borders(map.x_values, panel.x.logarithmic);
  const std::vector<double> y = cell_borders(map.y_values, panel.y.logarithmic);
  const std::size_t columns = map.x_values.size();
  const auto level = [&](std::size_t k) {
    return std::isnan(map.z[k]) ? -1 : heat_level((map.z[k] - map.low) / (map.high - map.low));
  };
  std::string rows, missing;
  for (std::size_t k = 0; k < map.z.size(); ++k)
    if (std::isnan(map.z[k]))
      missing += fmt::format("{} {} –\n", map.x_values[k % columns], map.y_values[k / columns]);
  for (std::size_t r = 0; r < map.y_values.size(); ++r)
    for (std::size_t c = 0; c < columns;) {
      // Neighbours of one colour are one rectangle.
      const int colour = level(r * columns + c);
      std::size_t end = c + 1;
      while (end < columns && level(r * columns + end) == colour) ++end;
      if (colour >= 0)
        rows += fmt::format("{} {} {} {} {} {} {}\n", x[c], y[r], x[c], x[end], y[r], y[r + 1],
                            map.low + heat_share(colour) * (map.high - map.low));
      c = end;
    }
  line("set palette defined ({})", heat_palette(map.low_is_blue));
  line(
      "set cbrange [{}:{}]\nset colorbox user origin screen {:.5f}, screen {:.5f} size screen "
      "{:.5f}, screen {:.5f}",
      gnuplot_number(map.low), gnuplot_number(map.high),
      (frame.left + frame.width + 12) / kChartWidth, 1 - (frame.top + frame.height) / height_,
      12 / kChartWidth, frame.height / height_);
  line("set label {} at screen {:.5f}, screen {:.5f} center", gnuplot_text(map.label),
       (frame.left + frame.width + 24) / kChartWidth, 1 - (frame.top - 9) / height_);
  add_plot(block(map.label, rows) +
           " using 1:2:3:4:5:6:7 with boxxyerror fs solid 1 noborder lc "
           "palette");
  if (!missing.empty())
    add_plot(block("missing", missing) + " using 1:2:3 with labels tc rgb '#7a7a7a' font ',10'");
}

void ScriptWriter::add_cells(const Panel& panel, const ChartPlace& frame) {
  std::vector<std::string> rows(panel.looks.size()), letters(panel.looks.size());
  for (const MapCell& cell : panel.cells) {
    const double x0 = x_.fraction(cell.x_low, panel.x.logarithmic);
    const double x1 = x_.fraction(cell.x_high, panel.x.logarithmic);
    const double y0 = y_.fraction(cell.y_low, panel.y.logarithmic);
    const double y1 = y_.fraction(cell.y_high, panel.y.logarithmic);
    const auto middle = [](double low, double high, bool logarithmic) {
      return logarithmic ? std::sqrt(low * high) : (low + high) / 2;
    };
    const double x = middle(cell.x_low, cell.x_high, panel.x.logarithmic);
    const double y = middle(cell.y_low, cell.y_high, panel.y.logarithmic);
    rows[cell.look] +=
        fmt::format("{} {} {} {} {} {}\n", x, y, cell.x_low, cell.x_high, cell.y_low, cell.y_high);
    if ((x1 - x0) * frame.width >= kLeastCell && std::abs(y1 - y0) * frame.height >= kLeastCell)
      letters[cell.look] += fmt::format("{} {} {}\n", x, y, panel.looks[cell.look].letter);
  }
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const CellLook& look = panel.looks[k];
    if (rows[k].empty()) continue;
    add_plot(block(look.label, rows[k]) +
             fmt::format(" using 1:2:3:4:5:6 with boxxyerror fc rgb '{}' fs solid 1 border lc rgb "
                         "'#ffffff' lw 0.5",
                         look.fill));
    // gnuplot 5.4 dies of labels without a point.
    if (!letters[k].empty() && !look.letter.empty())
      add_plot(block(look.label, letters[k]) +
               fmt::format(" using 1:2:3 with labels tc rgb '{}' font ',10' noenhanced", look.ink));
  }
}

void ScriptWriter::add_curve(const Curve& curve) {
  const auto row = [&](std::size_t k) {
    double x = curve.x[k], y = curve.y[k];
    if (curve.at_edge && std::isfinite(x) && std::isfinite(y)) {
      x = std::clamp(x, x_.low, x_.high);
      y = std::clamp(y, y_.low, y_.high);
    }
    return gnuplot_number(x) + " " + gnuplot_number(y) + "\n";
  };
  const char* colour = colour_of(curve.look.ink);
  if (curve.look.line != Line::none) {
    std::string rows;
    for (std::size_t k = 0; k < curve.x.size(); ++k) rows += row(k);
    const std::string data = block(plain_plot_text(curve.label), rows);
    if (curve.look.halo) add_plot(data + " using 1:2 with lines lw 5 lc rgb '#ffffff'");
    add_plot(fmt::format("{} using 1:2 with lines lw {} dt {} lc rgb '{}'", data,
                         curve.look.halo                   ? 2.0
                         : curve.look.line == Line::dotted ? 1.9
                                                           : 1.6,
                         gnuplot_dash(curve.look.line), colour));
  }
  if (curve.look.marker != Marker::none) {
    std::string rows;
    const std::size_t every = std::max<std::size_t>(1, curve.marker_every);
    for (std::size_t k = curve.marker_first; k < curve.x.size(); k += every)
      if (std::isfinite(curve.x[k]) && std::isfinite(curve.y[k])) rows += row(k);
    add_plot(fmt::format("{} using 1:2 with points {} lc rgb '{}'",
                         block(plain_plot_text(curve.label), rows),
                         gnuplot_point(curve.look.marker), colour));
  }
}

void ScriptWriter::draw_panel(const Panel& panel, const ChartPlace& frame) {
  x_ = x_range(panel);
  y_ = y_range(panel);
  place(frame);
  line("set title {} font ',13' offset 0, {}",
       gnuplot_text(fitted_text(panel.title, kTitleShare * frame.width)),
       panel.x.names.empty() ? "-0.4" : "0");
  line("set border {} lc rgb '{}'", panel.y.names.empty() || !panel.x.names.empty() ? 15 : 1,
       kFrame);
  set_axis('x', panel.x, x_, kTitleShare * frame.width);
  set_axis('y', panel.y, y_, kTitleShare * frame.height);
  line("{}", panel.y.logarithmic || !panel.y.names.empty() ? "unset xzeroaxis"
                                                           : "set xzeroaxis lt 1 lc rgb '#d5d5d0'");
  for (const Band& band : panel.bands) {
    const auto at = [](double value, const AxisRange& range) {
      return gnuplot_number(std::clamp(value, range.low, range.high));
    };
    line("set object rectangle from {}, {} to {}, {} behind {}", at(band.x_low, x_),
         at(band.y_low, y_), at(band.x_high, x_), at(band.y_high, y_), kTint);
  }
  double down = 14;
  for (const ChartMark& mark : panel.marks) {
    const double at = x_.fraction(mark.x, panel.x.logarithmic);
    if (!(at >= 0 && at <= 1)) continue;
    line("set arrow from {0}, graph 0 to {0}, graph 1 nohead dt (2,2) lc rgb '{1}'",
         gnuplot_number(mark.x), kFrame);
    line("set label {} at {}, graph {:.4f} offset 0.5, 0", gnuplot_text(mark.label),
         gnuplot_number(mark.x), mark.is_low ? 10 / frame.height : 1 - down / frame.height);
    if (!mark.is_low) down += 16;
  }
  if (panel.colours) add_colours(*panel.colours, panel, frame);
  add_cells(panel, frame);
  for (const Curve& curve : panel.curves)
    if (has_point(curve)) add_curve(curve);
  finish_plot();
}

/// What the legend names, each once: curves, tinted bands, kinds of cells that occur.
Panel legend_of(const Chart& chart) {
  Panel legend;
  const auto is_new = [&](const std::string& label) {
    const auto has = [&](const auto& entries) {
      return std::ranges::any_of(entries, [&](const auto& one) { return one.label == label; });
    };
    return !label.empty() && !has(legend.curves) && !has(legend.bands) && !has(legend.looks);
  };
  for (const Panel& panel : chart.panels) {
    for (const Curve& curve : panel.curves)
      if (is_new(curve.label)) legend.curves.push_back({curve.label, curve.look, {}, {}});
    for (const Band& band : panel.bands)
      if (is_new(band.label)) legend.bands.push_back(band);
    for (std::size_t k = 0; k < panel.looks.size(); ++k)
      if (std::ranges::any_of(panel.cells, [&](const MapCell& cell) { return cell.look == k; }) &&
          is_new(panel.looks[k].label))
        legend.looks.push_back(panel.looks[k]);
  }
  return legend;
}

double legend_height(const Panel& legend, std::size_t& columns) {
  const std::size_t count = legend.curves.size() + legend.bands.size() + legend.looks.size();
  double widest = 1;
  const auto measure = [&](const auto& entries) {
    for (const auto& entry : entries)
      widest = std::max(widest, kSample + 28 + text_pixels(entry.label));
  };
  measure(legend.curves);
  measure(legend.bands);
  measure(legend.looks);
  columns = std::clamp<std::size_t>(static_cast<std::size_t>((kChartWidth - 20) / widest), 1,
                                    std::max<std::size_t>(1, count));
  const std::size_t rows = (count + columns - 1) / columns;
  return kLegendLine * static_cast<double>(rows);
}

/// Samples and names in equal columns, drawn over axes in px.
void ScriptWriter::draw_legend(const ChartPlace& frame) {
  Panel legend = legend_of(*chart_);
  std::size_t columns = 1;
  const double height = legend_height(legend, columns);
  if (height <= 0) return;
  const std::size_t rows = static_cast<std::size_t>(std::lround(height / kLegendLine));
  x_ = {0, frame.width};
  y_ = {0, height};
  place(frame);
  line("unset title\nunset border\nunset tics\nunset xlabel\nunset ylabel\nunset xzeroaxis");
  line("set xrange [0:{}]\nset yrange [0:{}]", frame.width, height);
  std::size_t k = 0;
  const double width = frame.width / static_cast<double>(columns);
  const auto put = [&](const std::string& label) {
    const std::size_t column = k / rows;
    const double x = width * static_cast<double>(column) + 8;
    const double y = height - kLegendLine * (static_cast<double>(k % rows) + 0.5);
    line("set label {} at {}, {} left", gnuplot_text(label), x + kSample + 8, y);
    ++k;
    return std::pair(x, y);
  };
  for (Curve& curve : legend.curves) {
    const auto [x, y] = put(curve.label);
    curve.x = {x, x + kSample / 2, x + kSample};
    curve.y = {y, y, y};
    curve.marker_every = 3;
    curve.marker_first = 1;
    add_curve(curve);
  }
  for (const Band& band : legend.bands) {
    const auto [x, y] = put(band.label);
    line("set object rectangle from {}, {} to {}, {} {}", x + 8, y - 7, x + 28, y + 7, kTint);
  }
  for (std::size_t look = 0; look < legend.looks.size(); ++look) {
    const auto [x, y] = put(legend.looks[look].label);
    legend.cells.push_back({x + 8, x + 26, y - 8, y + 8, look, ""});
  }
  add_cells(legend, frame);
  finish_plot();
}

GnuplotScript ScriptWriter::write() {
  const std::vector<Panel>& panels = chart_->panels;
  const auto columns = static_cast<std::size_t>(std::max(1, chart_->columns));
  const double panel_width = kChartWidth / static_cast<double>(columns);
  std::vector<ChartPlace> frames;
  for (std::size_t k = 0; k < panels.size(); k += columns) {
    PanelMargins most{0, 0, 0, 0};
    const std::span row(panels.data() + k, std::min(columns, panels.size() - k));
    for (const Panel& panel : row) {
      const PanelMargins margins = panel_margins(panel);
      most.top = std::max(most.top, margins.top);
      most.bottom = std::max(most.bottom, margins.bottom);
    }
    for (std::size_t c = 0; c < row.size(); ++c) {
      const PanelMargins margins = panel_margins(row[c]);
      frames.push_back({static_cast<double>(c) * panel_width + margins.left, height_ + most.top,
                        std::max(40.0, panel_width - margins.left - margins.right),
                        chart_->plot_height});
    }
    height_ += most.top + chart_->plot_height + most.bottom;
  }
  const double legend_top = height_ + 4;
  std::size_t legend_columns = 1;
  const double legend = legend_height(legend_of(*chart_), legend_columns);
  height_ = std::ceil(height_ + legend + 10);

  line("# gnuplot {0}.gp draws {0}.svg of {0}.dat\nreset\nset encoding utf8", chart_->name);
  line("set terminal svg enhanced size {},{} font 'Helvetica,{}' background '#ffffff'", kChartWidth,
       height_, kChartFont);
  line(
      "set output '{0}.svg'\ndata = '{0}.dat'\nset key off\nset tics front\nset style fill "
      "noborder\nset "
      "multiplot",
      chart_->name);
  for (std::size_t k = 0; k < panels.size(); ++k) draw_panel(panels[k], frames[k]);
  draw_legend({10, legend_top, kChartWidth - 20, std::max(1.0, legend)});
  line("unset multiplot\nunset output");
  return {std::move(script_), std::move(data_)};
}

}  // namespace

GnuplotScript gnuplot_script(const Chart& chart) { return ScriptWriter(chart).write(); }

}  // namespace slipcheck
