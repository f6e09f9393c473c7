#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace slipcheck {

/// A chart for a paper: gnuplot makes `name`.svg of `name`.gp and the data beside it.
struct GnuplotChart {
  std::string name;  ///< of its files, as file_stem.h makes them
  std::string script;
  std::vector<std::pair<std::string, std::string>> data;  ///< name and text of each file
};

/// A text in gnuplot's single quotes, in which nothing is expanded. What is shown by it has to be
/// `noenhanced`, else ^, _, {, } and @ are formatting.
std::string gnuplot_text(std::string_view text);

/// The same of a name beside an axis or in the key, cut where it would leave no room for the plot.
std::string gnuplot_label(std::string_view text);

/// A number as gnuplot reads it, exactly; "NaN" for what is not finite.
std::string gnuplot_number(double value);

/// The common beginning of all scripts: terminal, output, CSV with column names, frame, grid, and a
/// key beside the plot. Sizes in px.
std::string gnuplot_head(const std::string& name, int width, int height);

/// Begins a column of `panels` plots over one axis under a title, in a drawing of this height [px].
std::string gnuplot_column(std::size_t panels, int height, double left, double right,
                           std::string_view title);

/// A logarithmic axis, 'x' or 'y', with powers of ten as labels.
std::string gnuplot_logarithmic(char axis);

/// How the k-th curve of a chart looks, told apart without colours too: a colour of Okabe and Ito
/// ("lc rgb '…'"), a point type ("pt 7") and a dash ("dt 1").
std::string gnuplot_colour(std::size_t k);
std::string gnuplot_points(std::size_t k);
std::string gnuplot_dash(std::size_t k);

}  // namespace slipcheck
