#include "report/rows/check_rows.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "report/rows/quantity.h"
#include "report/rows/selection.h"
#include "report/terminal/text.h"

namespace slipcheck {
namespace {

using Statistic = Change::Statistic;

/// In words rather than numbers.
bool is_in_words(const Change& change) { return !change.was.empty() || !change.is.empty(); }

std::string or_none(const std::string& text) { return text.empty() ? "none" : printable(text); }

/// All digits and the SI unit.
std::string exact(double value, const Change& change) {
  if (std::isnan(value)) return "none";
  if (change.statistic == Statistic::missing) return fmt::format("{:.0f}", value);
  const std::string unit = dimension_of(change.observable).si;
  return fmt::format("{}{}{}", value, unit.empty() ? "" : " ", unit);
}

void put_values(const Change& change, ChangeRow& row) {
  if (is_in_words(change)) {
    row.before = or_none(change.was);
    row.now = or_none(change.is);
    return;
  }
  if (change.statistic == Statistic::missing) {
    row.before = exact(change.before, change);
    row.now = exact(change.after, change) + " phases without";
    return;
  }
  const QuantityFormat format(std::fmax(std::abs(change.before), std::abs(change.after)),
                              dimension_of(change.observable));
  row.before = std::isnan(change.before) ? "none" : format.number(change.before);
  row.now = std::isnan(change.after) ? "none" : format.text(change.after);
  if (format.number(change.before) == format.number(change.after)) {
    row.before = fmt::format("{}", change.before);
    row.now = exact(change.after, change);
  }
  if (!std::isnan(change.allowed))
    row.allowed = "± " + quantity(change.allowed, dimension_of(change.observable), 2);
}

ChangeRow row_of(const Change& change) {
  ChangeRow row;
  row.part = printable(change.part);
  row.what = printable(change.observable.empty() ? change.note : change.observable);
  row.statistic = name_of(change.statistic);
  put_values(change, row);
  row.direction = !change.gates
                      ? Cell{"told only", Tone::faint}
                      : Cell{name_of(change.direction),
                             change.direction == Direction::better ? Tone::good : Tone::bad};
  row.note = printable(change.note);
  return row;
}

/// How far beyond what is allowed; infinite where nothing is.
double severity(const Change& change) {
  const double move = std::abs(change.after - change.before);
  return change.allowed > 0 && std::isfinite(move) ? move / change.allowed
                                                   : std::numeric_limits<double>::infinity();
}

bool is_told(const Change& change) {
  return change.gates || change.statistic == Statistic::verdict;
}

/// Of logarithms of ratios.
class GeometricMean {
 public:
  void add(double ratio) {
    if (!(ratio > 0)) return;
    sum_ += std::log(ratio);
    ++count_;
  }
  double value() const { return std::exp(sum_ / count_); }

 private:
  double sum_ = 0, count_ = 0;
};

}  // namespace

CheckTotals totals_of(const CheckReport& report) {
  CheckTotals totals;
  GeometricMean reference, engines;
  for (const SceneCheck& scene : report.scenes) {
    totals.moved_scenes += !scene.is_green();
    for (const CheckedPart& part : scene.parts)
      totals.runs += part.label != "reference" && part.label != "scene";
    for (const Change& change : scene.changes) {
      if (!change.gates)
        totals.verdicts += change.statistic == Statistic::verdict;
      else
        ++(change.direction == Direction::better  ? totals.better
           : change.direction == Direction::worse ? totals.worse
                                                  : totals.neither);
    }
    totals.compared += scene.compared;
    totals.drifted += scene.drifted;
    totals.uncertain += scene.uncertain;
    for (const std::string& version : scene.versions)
      if (std::ranges::find(totals.versions, version) == totals.versions.end())
        totals.versions.push_back(version);
    reference.add(scene.reference_time_ratio);
    engines.add(scene.engine_time_ratio);
  }
  totals.reference_time_ratio = reference.value();
  totals.engine_time_ratio = engines.value();
  return totals;
}

bool is_more_severe(const Change& one, const Change& other) {
  if (one.gates != other.gates) return one.gates;
  return severity(one) > severity(other);
}

std::vector<ChangeRow> change_rows(const SceneCheck& scene, bool all) {
  std::vector<ChangeRow> rows;
  std::vector<const Change*> worst;  // of each row
  for (const Change& change : scene.changes) {
    if (!all && !is_told(change)) continue;
    const auto same_part = [&](const Change* each) { return each->part == change.part; };
    const auto place = all ? worst.end() : std::ranges::find_if(worst, same_part);
    if (place == worst.end()) {
      worst.push_back(&change);
      rows.push_back(row_of(change));
      continue;
    }
    ChangeRow& row = rows[static_cast<std::size_t>(place - worst.begin())];
    const std::size_t others = row.others + 1;
    if (is_more_severe(change, **place)) {
      *place = &change;
      row = row_of(change);
    }
    row.others = others;
  }
  return rows;
}

TextTable change_table(const CheckReport& report) {
  TextTable table{{{"scene"},
                   {"run"},
                   {"observable"},
                   {"of"},
                   {"baseline", true},
                   {"now", true},
                   {"may move by", true},
                   {"way"}}};
  for (const bool green : {false, true})
    for (const SceneCheck& scene : report.scenes) {
      if (scene.is_green() != green) continue;
      for (const ChangeRow& row : change_rows(scene, false)) {
        Cell way = row.direction;
        if (row.others > 0) way.text += fmt::format(", + {} more", row.others);
        table.rows.push_back({{(green ? "✓ " : "✗ ") + scene.scene},
                              {row.part},
                              {row.what},
                              {row.statistic},
                              {row.before},
                              {row.now},
                              {row.allowed},
                              std::move(way)});
      }
    }
  return table;
}

std::string change_message(const Change& change) {
  std::string text = fmt::format("{}, {}: ", change.scene, change.part);
  if (!change.observable.empty()) text += change.observable + ' ';
  text += name_of(change.statistic);
  if (is_in_words(change)) {
    text += fmt::format(" was {}, is {}", or_none(change.was), or_none(change.is));
  } else {
    text +=
        fmt::format(" was {}, is {}", exact(change.before, change), exact(change.after, change));
    if (change.statistic == Statistic::missing) text += " phases";
  }
  if (!std::isnan(change.allowed))
    text += fmt::format(", allowed {}", quantity(change.allowed, dimension_of(change.observable)));
  if (change.direction != Direction::moved) text += fmt::format(": {}", name_of(change.direction));
  if (!change.note.empty()) text += fmt::format(" ({})", change.note);
  return printable(text);
}

std::string check_verdict(const CheckReport& report) {
  const CheckTotals totals = totals_of(report);
  if (totals.moved_scenes == 0) return "nothing has moved";
  std::vector<std::string> parts;
  if (totals.worse > 0) parts.push_back(fmt::format("{} worse", totals.worse));
  if (totals.better > 0) parts.push_back(fmt::format("{} better", totals.better));
  if (totals.neither > 0)
    parts.push_back(fmt::format("{} neither better nor worse", totals.neither));
  return fmt::format("{} of {} {} moved: {} ({})", totals.moved_scenes,
                     counted(report.scenes.size(), "scene"),
                     totals.moved_scenes == 1 ? "has" : "have", counted(totals.gating(), "change"),
                     fmt::join(parts, ", "));
}

std::vector<std::string> check_remarks(const CheckReport& report) {
  const CheckTotals totals = totals_of(report);
  std::vector<std::string> remarks;
  if (!report.advice.empty()) remarks.push_back(report.advice);
  for (const std::string& version : totals.versions)
    remarks.push_back("another engine version than the baseline's: " + version);
  if (totals.verdicts > 0)
    remarks.push_back(counted(totals.verdicts, "changed verdict") +
                      ": told only, what is judged is the values");
  if (totals.drifted > 0)
    remarks.push_back(counted(totals.drifted, "value") +
                      " not the same to the last bit, but within what is allowed");
  if (totals.uncertain > 0)
    remarks.push_back(counted(totals.uncertain, "value") +
                      " of the reference may move by more than 1e-9: by the uncertainty");
  if (std::isfinite(totals.reference_time_ratio) || std::isfinite(totals.engine_time_ratio)) {
    std::vector<std::string> times;
    if (std::isfinite(totals.reference_time_ratio))
      times.push_back(fmt::format("reference × {:.2f}", totals.reference_time_ratio));
    if (std::isfinite(totals.engine_time_ratio))
      times.push_back(fmt::format("engines × {:.2f}", totals.engine_time_ratio));
    remarks.push_back(
        fmt::format("CPU time over the baseline's, never judged: {}", fmt::join(times, ", ")));
  }
  return remarks;
}

Moved moved_since(const CheckReport& report) {
  const CheckTotals totals = totals_of(report);
  std::string finding = fmt::format(
      "Since {}: {}; {} in {} and {} held against it, ensembles of {}.", report.baselines,
      check_verdict(report), counted(totals.compared, "value"),
      counted(report.scenes.size(), "scene"), counted(totals.runs, "run"), report.phases);
  for (const std::string& remark : check_remarks(report)) finding += fmt::format(" {}.", remark);
  return {std::move(finding), change_table(report)};
}

}  // namespace slipcheck
