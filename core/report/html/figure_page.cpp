#include "report/html/figure_page.h"

#include <fmt/format.h>

#include "report/charts/plot_text.h"
#include "report/html/html_page.h"
#include "report/html/html_text.h"
#include "report/rows/context.h"

namespace slipcheck {
namespace {

std::string section_of(const FigureOnPage& figure) {
  return fmt::format(
      "<section class=\"scene\" id=\"{0}\">\n<h2>{0}: {1}</h2>\n<figure class=\"plot\">\n{2}"
      "<figcaption>{3}</figcaption>\n</figure>\n"
      "<p class=\"faint\">Files: <a href=\"{0}.svg\">{0}.svg</a>, <a "
      "href=\"{0}.csv\">{0}.csv</a></p>"
      "\n</section>\n",
      escaped(figure.name), html_plot_text(figure.title), figure.svg,
      html_plot_text(figure.caption));
}

}  // namespace

std::string figure_page(std::span<const FigureOnPage> figures, const std::string& introduction,
                        const std::string& command) {
  const Context& made = context();
  std::string html =
      html_head("Slipcheck figures",
                ".plot svg { display: block; width: 100%; max-width: 60rem; height: auto; }\n");
  html += "<header>\n<h1>Slipcheck: the papers' figures</h1>\n";
  html += html_paragraph("title", "", introduction);
  html +=
      "<dl class=\"context\">\n" + html_fact("command", command) + html_fact("date", made.date) +
      html_fact("slipcheck", fmt::format("{}, commit {}", made.version, made.commit)) + "</dl>\n";
  html += "<nav aria-label=\"Figures\"><ul class=\"contents\">\n";
  for (const FigureOnPage& figure : figures)
    html += fmt::format("<li><a href=\"#{0}\">{0}</a> {1}</li>\n", escaped(figure.name),
                        html_plot_text(figure.title));
  html += "</ul></nav>\n</header>\n<main>\n";
  for (const FigureOnPage& figure : figures) html += section_of(figure);
  return html + "</main>\n" + kHtmlEnd;
}

}  // namespace slipcheck
