#include "report/rows/store_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <utility>

#include "harness/compare/comparison.h"
#include "report/rows/quantity.h"
#include "studies/sweep/sweep_store.h"

namespace slipcheck {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kDecadesApart = 20;    // numbers farther apart are spread in the logarithm
constexpr double kOutcomesApart = 100;  // outcomes likewise
constexpr double kLeastTold = 0.01;     // share of the scatter
constexpr std::size_t kParts = 12;      // of a range of more numbers than kMostSweptLevels

std::string named(const QueryColumn& column) {
  return column.unit.empty() ? column.name : fmt::format("{} [{}]", column.name, column.unit);
}

double number_of(const SqliteValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  if (const auto* number = std::get_if<double>(&value)) return *number;
  return kNaN;
}

bool is_word(const SqliteValue& value) { return std::holds_alternative<std::string>(value); }

std::string word_of(const SqliteValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (std::holds_alternative<std::monostate>(value)) return {};
  return fmt::format("{:g}", number_of(value));
}

std::vector<SqliteValue> column_of(const QueryResult& result, std::size_t c) {
  std::vector<SqliteValue> values;
  for (const auto& row : result.rows) values.push_back(row[c]);
  return values;
}

/// Numbers, or words where any value is one.
void read_values(const std::vector<SqliteValue>& column, SweptParameter& parameter) {
  parameter.is_number = std::ranges::none_of(column, is_word);
  if (parameter.is_number) {
    for (const SqliteValue& value : column) parameter.values.push_back(number_of(value));
    return;
  }
  std::set<std::string> words;
  for (const SqliteValue& value : column)
    if (const std::string word = word_of(value); !word.empty()) words.insert(word);
  for (const SqliteValue& value : column) {
    const auto found = words.find(word_of(value));
    parameter.values.push_back(
        found == words.end() ? kNaN : static_cast<double>(std::distance(words.begin(), found)));
  }
  for (const std::string& word : words) {
    parameter.places.push_back(static_cast<double>(parameter.levels.size()));
    parameter.levels.push_back(word);
  }
}

/// The levels of numbers, and whether they are spread in the logarithm.
void find_levels(SweptParameter& parameter) {
  std::set<double> different;
  for (const double value : parameter.values)
    if (std::isfinite(value)) different.insert(value);
  if (different.empty()) return;
  const double low = *different.begin(), high = *different.rbegin();
  parameter.logarithmic = low > 0 && high >= kDecadesApart * low;
  if (different.size() <= kMostSweptLevels) {
    parameter.places.assign(different.begin(), different.end());
  } else {
    for (std::size_t k = 0; k < kParts; ++k) {
      const double share = (static_cast<double>(k) + 0.5) / kParts;
      parameter.places.push_back(parameter.logarithmic ? low * std::pow(high / low, share)
                                                       : low + share * (high - low));
    }
  }
  for (const double place : parameter.places)
    parameter.levels.push_back(fmt::format("{:.4g}", place));
}

/// The nearest on the parameter's scale.
std::size_t nearest(const SweptParameter& parameter, double value) {
  const std::vector<double>& places = parameter.places;
  if (!std::isfinite(value)) return places.size();
  const auto above = std::ranges::lower_bound(places, value);
  if (above == places.begin()) return 0;
  if (above == places.end()) return places.size() - 1;
  const double low = *(above - 1), high = *above;
  const double middle = parameter.logarithmic ? std::sqrt(low * high) : (low + high) / 2;
  return static_cast<std::size_t>(above - places.begin()) - (value < middle ? 1 : 0);
}

/// ε² = 1 − (SS_within/(n − k)) / (SS_total/(n − 1)) of n outcomes in k groups (T. L. Kelley, Proc.
/// Natl. Acad. Sci. 21, 554 (1935)).
double effect_of(const SweptParameter& parameter, const StoreView& view) {
  std::vector<double> sums(parameter.places.size()), counts(parameter.places.size());
  const auto scaled = [&](std::size_t run) {
    return view.logarithmic ? std::log10(view.values[run]) : view.values[run];
  };
  const auto counts_for = [&](std::size_t run) {
    return std::isfinite(view.values[run]) && parameter.level[run] < sums.size();
  };
  double n = 0, sum = 0;
  for (std::size_t run = 0; run < view.values.size(); ++run) {
    if (!counts_for(run)) continue;
    sums[parameter.level[run]] += scaled(run);
    counts[parameter.level[run]] += 1;
    sum += scaled(run);
    n += 1;
  }
  const auto groups =
      static_cast<double>(std::ranges::count_if(counts, [](double c) { return c > 0; }));
  if (groups < 2 || n <= groups) return kNaN;
  double within = 0, total = 0;
  for (std::size_t run = 0; run < view.values.size(); ++run) {
    if (!counts_for(run)) continue;
    const std::size_t group = parameter.level[run];
    within += std::pow(scaled(run) - sums[group] / counts[group], 2);
    total += std::pow(scaled(run) - sum / n, 2);
  }
  if (!(total > 0)) return kNaN;
  return std::clamp(1 - within / (n - groups) * (n - 1) / total, 0.0, 1.0);
}

void read_outcome(const QueryResult& result, std::size_t at, StoreView& view) {
  const std::size_t of_tolerance = at + 1;  // NULL of what has none
  for (const auto& row : result.rows) view.values.push_back(number_of(row[at]));
  view.outcome = named(result.columns[at]);
  view.in_tolerances = of_tolerance < result.columns.size() &&
                       std::ranges::all_of(result.rows, [&](const auto& row) {
                         return std::isnan(number_of(row[at])) || number_of(row[of_tolerance]) > 0;
                       });
  if (view.in_tolerances) {
    for (std::size_t run = 0; run < view.values.size(); ++run)
      view.values[run] /= number_of(result.rows[run][of_tolerance]);
    view.outcome = result.columns[at].name + " [tolerances]";
  }
  double least = kNaN, smallest = kNaN, most = kNaN;
  for (double& value : view.values) {
    if (!std::isfinite(value)) value = kNaN;
    view.without += std::isnan(value) ? 1 : 0;
    least = std::fmin(least, value);
    most = std::fmax(most, value);
    if (value > 0) smallest = std::fmin(smallest, value);
  }
  if (std::isnan(least))
    throw BadQuery(
        fmt::format("must be a column with numbers in the runs that are asked for, got {}",
                    result.columns[at].name));
  view.logarithmic = least >= 0 && most >= kOutcomesApart * smallest;
  if (view.logarithmic)
    for (double& value : view.values)
      if (value == 0) value = smallest;
}

/// The levels that have the least and the largest of these medians.
std::pair<std::size_t, std::size_t> best_and_worst(const std::vector<double>& medians) {
  std::size_t best = 0, worst = 0;
  for (std::size_t k = 0; k < medians.size(); ++k) {
    if (!(medians[k] >= medians[best])) best = std::isnan(medians[k]) ? best : k;
    if (!(medians[k] <= medians[worst])) worst = std::isnan(medians[k]) ? worst : k;
  }
  return {best, worst};
}

}  // namespace

double StoreView::median_of(const std::vector<std::size_t>& runs) const {
  std::vector<double> shown;
  for (const std::size_t run : runs)
    if (std::isfinite(values[run])) shown.push_back(values[run]);
  return shown.empty() ? kNaN : median(std::move(shown));
}

std::vector<double> StoreView::medians_over(const SweptParameter& parameter) const {
  std::vector<std::vector<std::size_t>> runs(parameter.places.size() + 1);
  for (std::size_t run = 0; run < values.size(); ++run) runs[parameter.level[run]].push_back(run);
  std::vector<double> medians;
  for (std::size_t level = 0; level < parameter.places.size(); ++level)
    medians.push_back(median_of(runs[level]));
  return medians;
}

std::string usual_outcome(SqliteFile& store) {
  StoreQuery one;
  one.limit = 1;
  const QueryResult usual = query_store(store, one);
  for (const char* of : {".error", ".reference"})
    for (const QueryColumn& column : usual.columns)
      if (column.name.ends_with(of)) return column.name;
  return {};
}

StoreView view_of(const std::string& scene, const QueryResult& result, std::size_t parameters) {
  if (result.rows.empty()) throw BadQuery("must find a run: these filters find none");
  StoreView view;
  view.scene = scene;
  read_outcome(result, parameters, view);
  for (std::size_t c = 0; c < parameters; ++c) {
    SweptParameter parameter;
    parameter.name = named(result.columns[c]);
    read_values(column_of(result, c), parameter);
    if (parameter.is_number) find_levels(parameter);
    if (parameter.levels.size() < 2) continue;
    for (const double value : parameter.values)
      parameter.level.push_back(nearest(parameter, value));
    parameter.effect = effect_of(parameter, view);
    view.parameters.push_back(std::move(parameter));
  }
  const auto telling = [](const SweptParameter& parameter) {
    return std::isnan(parameter.effect) ? -1 : parameter.effect;
  };
  std::ranges::stable_sort(view.parameters, std::greater(), telling);
  return view;
}

StoreView view_of_store(SqliteFile& store, const std::vector<std::string>& filters,
                        const std::string& outcome) {
  const StoreHead head = head_of(store);
  StoreQuery query;
  query.filters = filters;
  for (const StoreColumn& column : head.columns) query.columns.push_back(column.name);
  query.columns.push_back(outcome);
  constexpr std::string_view kError = ".error";
  if (outcome.ends_with(kError))
    query.columns.push_back(outcome.substr(0, outcome.size() - kError.size()) + ".tolerance");
  return view_of(head.name, query_store(store, query), head.columns.size());
}

std::string store_finding(const StoreView& view) {
  std::vector<std::size_t> all(view.values.size());
  for (std::size_t run = 0; run < all.size(); ++run) all[run] = run;
  const auto shown = view.values.size() - view.without;
  std::string text =
      fmt::format("{} of {}; {}: {} in the median, {} at most", counted(view.values.size(), "run"),
                  view.scene, view.outcome, plain_number(view.median_of(all)),
                  plain_number(*std::ranges::max_element(view.values, [](double a, double b) {
                    return (std::isnan(a) ? -INFINITY : a) < (std::isnan(b) ? -INFINITY : b);
                  })));
  if (view.in_tolerances)
    text += fmt::format(", within one in {} of {}",
                        std::ranges::count_if(view.values, [](double v) { return v <= 1; }), shown);
  if (view.without > 0) text += fmt::format("; {} without", counted(view.without, "run"));
  std::string telling;
  for (const SweptParameter& parameter : view.parameters)
    if (parameter.effect >= kLeastTold)
      telling +=
          fmt::format("{}{:.0f} % {}with {}", telling.empty() ? "" : ", ", 100 * parameter.effect,
                      telling.empty() ? "goes " : "", parameter.name);
  if (!telling.empty()) text += fmt::format(". Of its scatter {}", telling);
  return text + ".";
}

TextTable effects_table(const StoreView& view) {
  TextTable table{{{"parameter"},
                   {"values", true},
                   {"from"},
                   {"to"},
                   {"share of the scatter", true},
                   {"least median"},
                   {"at"},
                   {"largest median"},
                   {"at"}},
                  {},
                  "What goes with each parameter"};
  for (const SweptParameter& parameter : view.parameters) {
    const std::vector<double> medians = view.medians_over(parameter);
    const auto [best, worst] = best_and_worst(medians);
    std::set<double> different;
    for (const double value : parameter.values)
      if (std::isfinite(value)) different.insert(value);
    const auto end = [&](double value, const std::string& word) {
      return parameter.is_number ? Cell{fmt::format("{:.6g}", value), Tone::plain, value}
                                 : Cell{word};
    };
    const auto cell = [](double value) { return Cell{plain_number(value), Tone::plain, value}; };
    table.rows.push_back(
        {{parameter.name},
         count_cell(different.size()),
         end(*different.begin(), parameter.levels.front()),
         end(*different.rbegin(), parameter.levels.back()),
         std::isnan(parameter.effect)
             ? Cell{"–"}
             : Cell{fmt::format("{:.2f}", parameter.effect), Tone::plain, parameter.effect},
         cell(medians[best]),
         {parameter.levels[best]},
         cell(medians[worst]),
         {parameter.levels[worst]}});
  }
  return table;
}

}  // namespace slipcheck
