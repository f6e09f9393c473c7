#include "report/charts/gnuplot_script.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "report/terminal/text.h"

namespace slipcheck {
namespace {

constexpr std::size_t kLongestLabel = 40;  // columns

constexpr std::array kColours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"};
// Circle, square, triangle, diamond, the other triangle: full, then empty.
constexpr std::array kPoints = {7, 5, 9, 13, 11, 6, 4, 8, 12, 10};
constexpr std::array kDashes = {"1", "(6,3)", "(2,3)", "(9,3,2,3)"};

}  // namespace

std::string gnuplot_text(std::string_view text) {
  std::string quoted = "'";
  for (const char c : printable(text)) quoted += c == '\'' ? "''" : std::string(1, c);
  return quoted + "'";
}

std::string gnuplot_label(std::string_view text) {
  return gnuplot_text(shortened(printable(text), kLongestLabel));
}

std::string gnuplot_number(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : "NaN";
}

std::string gnuplot_head(const std::string& name, int width, int height) {
  return fmt::format(
      "# gnuplot {0}.gp draws {0}.svg\n"
      "reset\n"
      "set encoding utf8\n"
      "set terminal svg enhanced size {1},{2} font 'Helvetica,13' background '#ffffff'\n"
      "set output '{0}.svg'\n"
      "set datafile separator comma\n"
      "set datafile columnheaders\n"
      "set border 3 lc rgb '#404040'\n"
      "set tics nomirror\n"
      "set grid lc rgb '#dddddd' dt 1 lw 0.7\n"
      "set key outside right top Left reverse noenhanced samplen 2.5\n",
      name, width, height);
}

std::string gnuplot_column(std::size_t panels, int height, double left, double right,
                           std::string_view title) {
  return fmt::format(
      "set multiplot layout {},1 margins screen {}, {}, {:.4f}, {:.4f} spacing 0, {:.4f} "
      "title {} noenhanced\n",
      panels, left, right, 62.0 / height, 1 - 34.0 / height, 20.0 / height, gnuplot_text(title));
}

std::string gnuplot_logarithmic(char axis) {
  return fmt::format("set logscale {0}\nset format {0} '10^{{%T}}'\n", axis);
}

std::string gnuplot_colour(std::size_t k) {
  return fmt::format("lc rgb '{}'", kColours[k % kColours.size()]);
}

std::string gnuplot_points(std::size_t k) {
  return fmt::format("pt {}", kPoints[k % kPoints.size()]);
}

std::string gnuplot_dash(std::size_t k) {
  return fmt::format("dt {}", kDashes[k % kDashes.size()]);
}

}  // namespace slipcheck
