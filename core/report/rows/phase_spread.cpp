#include "report/rows/phase_spread.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/compare/observable_scale.h"
#include "report/rows/comparison_rows.h"
#include "report/rows/quantity.h"
#include "report/rows/selection.h"
#include "scenario/observable_key.h"

namespace slipcheck {
namespace {

constexpr double kFarOff = 0.05;

/// How far each phase's vector is from the reference's; empty where the run shows no component.
std::vector<double> distances(const ReferenceResult& reference, const EngineRecord& run,
                              const std::string& vector) {
  std::vector<double> squares;
  for (const std::string& name : observable_key(vector).components()) {
    const auto component = run.observables.find(name);
    const auto expected = reference.observables.find(name);
    if (component == run.observables.end() || expected == reference.observables.end()) return {};
    const std::vector<double>& values = component->second.values;
    squares.resize(values.size());
    for (std::size_t p = 0; p < values.size(); ++p)
      squares[p] += std::pow(values[p] - expected->second.value, 2);
  }
  for (double& square : squares) square = std::sqrt(square);
  return squares;
}

/// The tolerance as the runs were judged by; the same for all of them. None where none could be.
const Deviation* judged_by(const SceneRecord& scene, const std::string& name) {
  for (const EngineRecord& run : scene.runs)
    if (const auto found = run.errors.find(name); found != run.errors.end() &&
                                                  found->second.tolerance &&
                                                  found->second.verdict != Verdict::undecided)
      return &found->second;
  return nullptr;
}

RunSpread run_spread(const PhaseSpread& spread, const EngineRecord& run,
                     std::vector<double> values) {
  RunSpread result;
  result.run = &run;
  result.values = std::move(values);
  for (double value : result.values) {
    if (std::isnan(value)) continue;
    ++result.shown;
    result.outside += value < spread.low || value > spread.high;
    result.far_off += std::abs(value - spread.reference) > kFarOff * spread.scale;
    result.min = std::fmin(result.min, value);
    result.max = std::fmax(result.max, value);
  }
  return result;
}

double worst_error(const PhaseSpread& spread, const RunSpread& run) {
  return std::max(std::abs(run.min - spread.reference), std::abs(run.max - spread.reference));
}

bool same_engine(const EngineRecord& a, const EngineRecord& b) {
  return a.engine == b.engine && a.version == b.version && a.precision == b.precision &&
         a.profile == b.profile && a.scale == b.scale;
}

/// `what`: "phases", or "runs" where a phase has several.
std::string so_many(std::size_t count, std::size_t of, const char* what) {
  return count == of ? fmt::format("all {} {} are", of, what)
                     : fmt::format("{} of {} {} {}", count, of, what, count == 1 ? "is" : "are");
}

}  // namespace

std::optional<PhaseSpread> phase_spread(const SceneRecord& scene, const std::string& name) {
  const Deviation* deviation = judged_by(scene, name);
  const auto reference = scene.reference.observables.find(name);
  const ObservableName* observable = observable_of(name);
  if (!deviation || reference == scene.reference.observables.end() || !observable) return {};
  const bool is_distance = observable->is_vector && observable_key(name).component == '\0';
  const double value = is_distance ? 0 : reference->second.value;
  const double scale = is_distance
                           ? observable_scale(scene.scenario, scene.reference.observables, name)
                           : std::abs(value);
  // Of a value that is zero but for rounding, what the reference knows of it.
  const double known = scene.reference.box ? 0 : 10 * reference->second.uncertainty;
  const bool is_zero = !deviation->absolute && scale <= known;
  const double margin = is_zero ? known : *deviation->tolerance * (deviation->absolute ? 1 : scale);
  if (!std::isfinite(value) || !std::isfinite(margin)) return {};

  PhaseSpread spread;
  spread.name = name;
  spread.dimension = observable->dimension;
  spread.is_distance = is_distance;
  spread.reference = value;
  spread.scale = scale;
  spread.low = is_distance ? 0 : value - margin;
  spread.high = value + margin;
  spread.tolerance =
      tolerance_text(*deviation->tolerance, deviation->absolute, observable->dimension);
  for (const EngineRecord& run : scene.runs) {
    const auto ensemble = run.observables.find(name);
    if (ensemble == run.observables.end()) continue;
    RunSpread row = run_spread(
        spread, run, is_distance ? distances(scene.reference, run, name) : ensemble->second.values);
    if (row.shown > 0) spread.runs.push_back(std::move(row));
  }
  if (spread.runs.empty()) return {};
  return spread;
}

bool look_alike(const PhaseSpread& a, const PhaseSpread& b) {
  if (observable_of(a.name) != observable_of(b.name) || a.is_distance != b.is_distance ||
      a.runs.size() != b.runs.size())
    return false;
  double extent = a.high - a.low;
  for (const RunSpread& run : a.runs) extent = std::max(extent, run.max - run.min);
  const auto same = [&](double x, double y) {
    return (std::isnan(x) && std::isnan(y)) || std::abs(x - y) <= 1e-3 * extent;
  };
  if (!same(a.reference, b.reference) || !same(a.high, b.high)) return false;
  for (std::size_t k = 0; k < a.runs.size(); ++k) {
    const RunSpread &one = a.runs[k], &other = b.runs[k];
    if (one.run != other.run || one.outside != other.outside ||
        !std::equal(one.values.begin(), one.values.end(), other.values.begin(), other.values.end(),
                    same))
      return false;
  }
  return true;
}

std::string words_of(const PhaseSpread& spread, const RunSpread& run) {
  const double magnitude = spread.is_distance ? run.max : spread.reference;
  const QuantityFormat format(magnitude != 0 ? magnitude : run.max, spread.dimension);
  const std::size_t count = run.values.size();
  const char* what = run.run->headings > 1 ? "runs" : "phases";
  const std::string over =
      count > 1 ? fmt::format("Over {} ", run.run->headings > 1 ? ensemble_text(*run.run)
                                                                : fmt::format("{} phases", count))
                : "";
  const std::string low = format.number(run.min), high = format.text(run.max);
  const bool is_one = format.text(run.min) == high;
  std::string text = over + spread.name;
  if (spread.is_distance) {
    text += fmt::format(" is off by {}: ", is_one ? high : low + " to " + high);
  } else {
    text += " comes out " + (is_one ? "as " + high : "between " + low + " and " + high);
    text += fmt::format("; {} is right: ", format.text(spread.reference));
  }
  if (count == 1) {
    text += run.outside ? "outside" : "within";
    text += fmt::format(" the tolerance of {}.", spread.tolerance);
  } else if (run.outside == 0) {
    text += fmt::format("all {} are within the tolerance of {}.", run.shown, spread.tolerance);
  } else {
    text += fmt::format("{} outside the tolerance of {}", so_many(run.outside, run.shown, what),
                        spread.tolerance);
    // More of the same where the tolerance is as wide.
    const bool says_more = spread.high - spread.reference < 0.99 * kFarOff * spread.scale;
    if (says_more && run.far_off > 0)
      text += run.far_off == run.outside
                  ? ", every one of them more than 5 % off"
                  : fmt::format(", {} of them more than 5 % off", run.far_off);
    text += ".";
  }
  if (run.shown < count)
    text += fmt::format(" {} of {} {} do not show it.", count - run.shown, count, what);
  return text;
}

std::vector<std::string> words_on_convergence(const PhaseSpread& spread) {
  std::vector<std::string> result;
  for (std::size_t k = 0; k < spread.runs.size(); ++k) {
    const EngineRecord& first = *spread.runs[k].run;
    const auto is_of_group = [&](const RunSpread& run) { return same_engine(*run.run, first); };
    if (std::any_of(spread.runs.begin(), spread.runs.begin() + static_cast<std::ptrdiff_t>(k),
                    is_of_group))
      continue;
    const RunSpread *lowest = &spread.runs[k], *highest = lowest;
    for (const RunSpread& run : spread.runs) {
      if (!is_of_group(run)) continue;
      if (run.run->rate < lowest->run->rate) lowest = &run;
      if (run.run->rate > highest->run->rate) highest = &run;
    }
    const double coarse = worst_error(spread, *lowest), fine = worst_error(spread, *highest);
    if (highest->run->rate < 2 * lowest->run->rate || highest->outside == 0 || fine < 0.5 * coarse)
      continue;
    const QuantityFormat format(coarse, spread.dimension, 3);
    result.push_back(fmt::format(
        "A smaller step does not help {} {} ({}{}): from {:g} to {:g} Hz the largest error goes "
        "from {} to {}.",
        first.engine, first.precision, first.profile,
        first.scale == 1 ? "" : fmt::format(", scale {:g}", first.scale), lowest->run->rate,
        highest->run->rate, format.text(coarse), format.text(fine)));
  }
  return result;
}

}  // namespace slipcheck
