#include "report/html/html_matrix.h"

#include "report/html/html_text.h"
#include "report/rows/engine_matrix.h"

namespace slipcheck {

std::string html_matrix(const std::vector<SceneRecord>& scenes, const ReportCharts& charts,
                        const StandingCharts& standing) {
  const EngineMatrix matrix = engine_matrix(scenes);
  if (matrix.methods.empty()) return {};
  std::string html = "<section id=\"engines\">\n<h2>Engines over all scenes</h2>\n";
  html += html_list("findings", "", matrix_findings(matrix));
  html += html_table(score_table(matrix));
  if (!charts.engines.empty())
    html += "<div class=\"plots\" data-engines=\"0\"></div>\n" + standing.html(charts.engines);
  return html + "</section>\n";
}

}  // namespace slipcheck
