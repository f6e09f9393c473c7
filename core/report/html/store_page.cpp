#include "report/html/store_page.h"

#include <fmt/format.h>

#include <algorithm>

#include "report/charts/plot_text.h"
#include "report/html/html_charts.h"
#include "report/html/html_page.h"
#include "report/html/html_text.h"
#include "report/rows/context.h"
#include "report/rows/quantity.h"
#include "report/rows/query_rows.h"

namespace slipcheck {

std::string store_page(const StoreView& view, const QueryResult& runs,
                       const std::vector<Chart>& charts, const ChartDrawings& drawn,
                       const std::string& program, const std::string& command) {
  std::string html = html_head("Slipcheck sweep");
  html += fmt::format("<header>\n<h1>Slipcheck: sweep of {}</h1>\n", escaped(view.scene));
  html += html_paragraph("title", "", store_finding(view));
  html += "<dl class=\"context\">\n" + html_fact("command", command) +
          html_fact("store made by", program) + html_fact("date", context().date) +
          "</dl>\n</header>\n<main>\n";
  html += "<section>\n<h2>What goes with each parameter</h2>\n" + html_table(effects_table(view)) +
          html_paragraph("faint", "",
                         "The share is ε² of an analysis of variance over the groups of runs that "
                         "have the same value, or lie in the same twelfth of its range.") +
          "</section>\n";
  for (std::size_t k = 0; k < charts.size(); ++k)
    html += fmt::format("<section class=\"scene\" id=\"{}\">\n<h2>{}</h2>\n", charts[k].name,
                        html_plot_text(charts[k].title)) +
            html_chart(charts[k], drawn.svgs[k], drawn.trouble) + "</section>\n";
  QueryResult shown = runs;
  shown.rows.resize(std::min(shown.rows.size(), kMostStoreRows));
  TextTable table = query_table(shown);
  table.title = "Runs";
  html += "<section>\n<h2>Runs</h2>\n" +
          html_details(shown.rows.size() < runs.found
                           ? fmt::format("The first {} of {}", shown.rows.size(), runs.found)
                           : counted(runs.found, "run"),
                       html_table(table)) +
          "</section>\n";
  return html + "</main>\n" + kHtmlEnd;
}

}  // namespace slipcheck
