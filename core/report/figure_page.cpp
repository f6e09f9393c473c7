#include "report/figure_page.h"

#include <fmt/format.h>

#include "report/context.h"
#include "report/html_text.h"
#include "report/page_css.h"
#include "report/plot_text.h"

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
  std::string html = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8"/>
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'"/>
<meta name="viewport" content="width=device-width, initial-scale=1"/>
<meta name="color-scheme" content="light dark"/>
<title>Slipcheck figures</title>
<style>
)";
  html += kPageCss;
  html +=
      ".plot svg { display: block; width: 100%; max-width: 60rem; height: auto; }\n"
      "</style>\n</head>\n<body>\n<header>\n<h1>Slipcheck: the papers' figures</h1>\n";
  html += html_paragraph("title", "", introduction);
  html += fmt::format(
      "<dl class=\"context\">\n<div><dt>command</dt><dd>{}</dd></div>\n<div><dt>date</dt>"
      "<dd>{}</dd></div>\n<div><dt>slipcheck</dt><dd>{}, commit {}</dd></div>\n</dl>\n",
      escaped(command), escaped(made.date), escaped(made.version), escaped(made.commit));
  html += "<nav aria-label=\"Figures\"><ul class=\"contents\">\n";
  for (const FigureOnPage& figure : figures)
    html += fmt::format("<li><a href=\"#{0}\">{0}</a> {1}</li>\n", escaped(figure.name),
                        html_plot_text(figure.title));
  html += "</ul></nav>\n</header>\n<main>\n";
  for (const FigureOnPage& figure : figures) html += section_of(figure);
  return html + "</main>\n</body>\n</html>\n";
}

}  // namespace slipcheck
