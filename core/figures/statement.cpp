#include "figures/statement.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "figures/paper_figure.h"
#include "report/charts/plot_text.h"
#include "report/files/markdown.h"
#include "report/rows/csv_rows.h"
#include "report/rows/text_table.h"

namespace slipcheck {
namespace {

std::string measured_text(const Statement& statement) {
  if (!std::isfinite(statement.measured)) return "–";
  std::string text = fmt::format("{:.4g}", statement.measured);
  if (statement.error > 0) text += fmt::format(" ± {:.1g}", statement.error);
  return text;
}

constexpr const char* kHowTheyAreMade = R"(```sh
slipcheck figures results/figures                  # under a minute on two cores; writes this file too, figures.md
slipcheck figures results/figures --only K7,B1     # some of them
slipcheck figures results/figures --full           # L's boxes run twelve times as long: minutes
```

Each figure is an image `NAME.svg`, which gnuplot draws, and its numbers `NAME.csv` (a header with units, a row a point,
nothing where a number does not exist); `index.html` shows all of them with their captions, and `stated.csv` has what the
papers say of them. Columns named `residual` are the reference less the closed form.
)";

TextTable table_of(std::span<const Statement> statements) {
  TextTable table{{{"stated"}, {"paper", true}, {"measured", true}, {"agrees"}, {"remark"}}};
  for (const Statement& each : statements)
    table.rows.push_back({{each.what},
                          {each.stated},
                          {measured_text(each)},
                          {each.agrees() ? "yes" : "no"},
                          {each.remark}});
  return table;
}

}  // namespace

Statement stated_number(std::string what, std::string stated, double value, double half_digit,
                        double measured, double error, std::string remark) {
  return {std::move(what), std::move(stated), value - half_digit, value + half_digit, measured,
          error,           std::move(remark)};
}

Statement stated_order(std::string what, std::string stated, double value, double measured,
                       double error, std::string remark) {
  const double half = std::sqrt(10.0);
  return {std::move(what), std::move(stated), value / half, value * half, measured,
          error,           std::move(remark)};
}

std::string stated_csv(std::span<const PaperFigure> figures) {
  CsvRows rows(
      {"figure", "claim", "stated", "low", "high", "measured", "error", "agrees", "remark"}, 12);
  for (const PaperFigure& figure : figures)
    for (const Statement& each : figure.statements)
      rows.add({figure.name, each.what, each.stated, each.low, each.high, each.measured, each.error,
                std::string(each.agrees() ? "yes" : "no"), each.remark});
  return rows.text();
}

std::string figures_markdown(std::span<const PaperFigure> figures,
                             const std::string& introduction) {
  std::string text = "# The papers' figures\n\n";
  text += kHowTheyAreMade;
  text += "\n" + introduction + "\n";
  for (const PaperFigure& figure : figures) {
    text += fmt::format("\n## {}: {}\n\n{}\n", figure.name,
                        markdown_escaped(plain_plot_text(figure.title)),
                        markdown_escaped(plain_plot_text(figure.caption)));
    if (!figure.notes.empty()) text += "\n" + figure.notes + "\n";
    if (!figure.statements.empty()) text += "\n" + markdown_table(table_of(figure.statements));
  }
  return text;
}

}  // namespace slipcheck
