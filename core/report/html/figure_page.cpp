#include "report/html/figure_page.h"

#include <fmt/format.h>

#include "report/charts/plot_text.h"
#include "report/html/html_charts.h"
#include "report/html/html_page.h"
#include "report/html/html_text.h"
#include "report/rows/context.h"

namespace slipcheck {
namespace {

std::string section_of(const Chart& figure, const std::string& svg, const std::string& trouble) {
  std::string files = fmt::format("<a href=\"{0}.csv\">{0}.csv</a>", figure.name);
  if (!svg.empty()) files = fmt::format("<a href=\"{0}.svg\">{0}.svg</a>, ", figure.name) + files;
  return fmt::format("<section class=\"scene\" id=\"{0}\">\n<h2>{0}: {1}</h2>\n", figure.name,
                     html_plot_text(figure.title)) +
         html_chart(figure, svg, trouble) + "<p class=\"faint\">Files: " + files +
         "</p>\n</section>\n";
}

}  // namespace

std::string figure_page(const std::vector<Chart>& figures, const ChartDrawings& drawn,
                        const std::string& introduction, const std::string& command) {
  const Context& made = context();
  std::string html = html_head("Slipcheck figures");
  html += "<header>\n<h1>Slipcheck: the papers' figures</h1>\n";
  html += html_paragraph("title", "", introduction);
  html +=
      "<dl class=\"context\">\n" + html_fact("command", command) + html_fact("date", made.date) +
      html_fact("slipcheck", fmt::format("{}, commit {}", made.version, made.commit)) + "</dl>\n";
  html += "<nav aria-label=\"Figures\"><ul class=\"contents\">\n";
  for (const Chart& figure : figures)
    html += fmt::format("<li><a href=\"#{0}\">{0}</a> {1}</li>\n", figure.name,
                        html_plot_text(figure.title));
  html += "</ul></nav>\n</header>\n<main>\n";
  for (std::size_t k = 0; k < figures.size(); ++k)
    html += section_of(figures[k], drawn.svgs[k], drawn.trouble);
  return html + "</main>\n" + kHtmlEnd;
}

}  // namespace slipcheck
