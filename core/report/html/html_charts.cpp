#include "report/html/html_charts.h"

#include <fmt/format.h>

#include "report/charts/plot_text.h"
#include "report/html/html_text.h"

namespace slipcheck {

std::string html_chart(const Chart& chart, const std::string& svg, const std::string& trouble) {
  return fmt::format(
      "<figure class=\"plot\">\n{}<figcaption>{}</figcaption>\n</figure>\n",
      svg.empty() ? html_paragraph("reason", "Not drawn:", trouble) : inline_svg(svg),
      html_plot_text(chart.caption));
}

StandingCharts::StandingCharts(const std::vector<Chart>& charts) : are_drawn_(true) {
  ChartDrawings drawings = draw_charts(charts);
  trouble_ = std::move(drawings.trouble);
  for (std::size_t k = 0; k < charts.size(); ++k)
    svgs_[charts[k].name] = std::move(drawings.svgs[k]);
}

std::string StandingCharts::html(const std::vector<Chart>& charts) const {
  std::string html;
  for (const Chart& chart : charts)
    html += are_drawn_ ? html_chart(chart, svgs_.at(chart.name), trouble_)
                       : "<li>" + html_plot_text(chart.caption) + "</li>\n";
  return are_drawn_ || html.empty() ? html : "<noscript><ul>\n" + html + "</ul></noscript>\n";
}

}  // namespace slipcheck
