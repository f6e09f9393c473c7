#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

namespace slipcheck {

/// What a paper says in words or numbers, beside what a run of this program gives.
struct Statement {
  std::string what;    ///< with its unit, plain text: "t^s at v_rel = 10 cm/s [s]"
  std::string stated;  ///< in the paper's own figures: "0.03", "about 2", "falls"
  /// What the paper's words allow: its last digit up and down, its own error, or a bound; infinite
  /// where there is none.
  double low, high;
  double measured;          ///< NaN where it could not be: then nothing agrees
  double error = 0;         ///< of `measured`, its standard error or bound, >= 0
  std::string remark = {};  ///< why not, or how the words are read

  bool agrees() const { return measured + error >= low && measured - error <= high; }
};

/// Where the last digit of a stated number may be rounded: `value` ± `half_digit`.
Statement stated_number(std::string what, std::string stated, double value, double half_digit,
                        double measured, double error = 0, std::string remark = {});

/// A power of ten stated alone: what is nearer to `value` than to its neighbours.
Statement stated_order(std::string what, std::string stated, double value, double measured,
                       double error = 0, std::string remark = {});

/// Where a statement has no bound.
inline constexpr double kUnbounded = std::numeric_limits<double>::infinity();

struct PaperFigure;

/// RFC 4180: figure, claim, stated, low, high, measured, error, agrees (yes or no), remark.
std::string stated_csv(std::span<const PaperFigure> figures);

/// All figures for a reader of Markdown: how they are made, what a page with them says first, and
/// of each title, caption, notes, and the table of its statements.
std::string figures_markdown(std::span<const PaperFigure> figures, const std::string& introduction);

}  // namespace slipcheck
