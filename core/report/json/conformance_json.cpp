#include "report/json/conformance_json.h"

#include "report/json/common_fields.h"

namespace slipcheck {

template <class Fields>
void describe(Fields& f, ConformanceCheck& check) {
  f("name", check.name);
  f("verdict", check.verdict);
  f("why", check.why);
  f.if_any("mend", check.mend);
}

template <class Fields>
void describe(Fields& f, ConformanceReport& report) {
  std::string executable = report.executable.program.string();
  f("executable", executable);
  f.if_any("engine", report.engine);
  f.if_any("version", report.version);
  f.if_any("precision", report.precision);
  f.if_any("no_start", report.no_start);
  f("checks", report.checks);
}

nlohmann::ordered_json json_of(const std::vector<ConformanceReport>& reports) {
  nlohmann::ordered_json json{{"schema", "slipcheck-conformance/1"}};
  put_context(json);
  json["workers"] = nlohmann::ordered_json::array();
  for (const ConformanceReport& report : reports) {
    nlohmann::ordered_json worker = written(report);
    using enum CheckVerdict;
    worker["passed"] = report.count(passed);
    worker["failed"] = report.count(failed);
    worker["not_judged"] = report.count(not_judged);
    json["workers"].push_back(std::move(worker));
  }
  return json;
}

}  // namespace slipcheck
