#include "report/files/precision_csv.h"

#include "report/rows/csv_rows.h"

namespace slipcheck {
namespace {

/// Of errors and times: there are hundreds of thousands of them in a study of fifty scenes.
constexpr int kDigits = 8;

/// The columns that say which scene and method a row is of.
std::vector<std::string> with_method(const std::vector<std::string>& more) {
  std::vector<std::string> header = {"scene",   "method",    "kind",    "engine",
                                     "version", "precision", "profile", "iterations"};
  header.insert(header.end(), more.begin(), more.end());
  return header;
}

std::vector<CsvValue> method_of(const PrecisionScene& scene, const MethodCurve& curve) {
  return {scene.scenario.name,
          label_of(curve),
          std::string(name_of(curve.kind)),
          curve.engine,
          curve.version,
          curve.precision,
          curve.profile,
          curve.iterations ? CsvValue(*curve.iterations) : CsvValue(std::string())};
}

void append(std::vector<CsvValue>& row, std::vector<CsvValue> more) {
  row.insert(row.end(), more.begin(), more.end());
}

/// "not ok" and why, for people and programs: of the quantity, else of the point.
std::string reason_of(const WorkPrecision& point, const PhaseErrors* errors) {
  return errors && !errors->reason.empty() ? errors->reason : point.reason;
}

}  // namespace

std::string precision_csv(const std::vector<PrecisionScene>& scenes) {
  CsvRows rows(
      with_method({"knob", "status", "phases", "quantity", "worst_error", "median_error",
                   "rms_error", "absolute", "tolerance", "cpu_per_step [s]",
                   "cpu_per_simulated_second", "cpu_spread", "repeats", "pareto", "reason"}),
      kDigits);
  for (const PrecisionScene& scene : scenes)
    for (const MethodCurve& curve : scene.curves)
      for (const WorkPrecision& point : curve.points) {
        const auto add = [&](const std::string& quantity, const PhaseErrors* errors) {
          std::vector<CsvValue> row = method_of(scene, curve);
          append(row, {point.knob, std::string(name_of(point.status)),
                       static_cast<double>(point.phases), quantity});
          if (errors) {
            append(row, {errors->worst, errors->median, errors->rms,
                         std::string(errors->absolute ? "true" : "false"),
                         errors->tolerance.value_or(kNotObserved)});
          } else {
            append(row, std::vector<CsvValue>(5, std::string()));
          }
          if (point.cost) {
            append(row, {point.cost->per_step, point.cost->per_simulated_second, point.cost->spread,
                         static_cast<double>(point.cost->repeats)});
          } else {
            append(row, std::vector<CsvValue>(4, std::string()));
          }
          append(row, {std::string(point.pareto.contains(quantity) ? "true" : "false"),
                       reason_of(point, errors)});
          rows.add(row);
        };
        for (const auto& [quantity, errors] : point.errors) add(quantity, &errors);
        if (point.errors.empty()) add("", nullptr);
      }
  return rows.text();
}

std::string convergence_csv(const std::vector<PrecisionScene>& scenes) {
  CsvRows rows(with_method({"quantity", "convergence", "order", "order_error", "coarsest_error",
                            "finest_error", "largest_error"}),
               kDigits);
  for (const PrecisionScene& scene : scenes)
    for (const MethodCurve& curve : scene.curves)
      for (const auto& [quantity, convergence] : curve.convergence) {
        std::vector<CsvValue> row = method_of(scene, curve);
        append(row, {quantity, std::string(name_of(convergence.kind)), convergence.order,
                     convergence.order_error, convergence.coarsest, convergence.finest,
                     convergence.largest});
        rows.add(row);
      }
  return rows.text();
}

}  // namespace slipcheck
