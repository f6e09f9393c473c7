#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "report/charts/plot_text.h"
#include "report/charts/scene_charts.h"
#include "report/files/file_stem.h"
#include "report/rows/quantity.h"
#include "scenario/units.h"

namespace slipcheck {
namespace {

struct AssemblyStrip {
  const char* label;
  Look look;
  double (*of)(const AssemblyState& state);
};

/// An engine's run beside what is shown.
struct AssemblyBeside {
  std::string label;
  const Assembly* assembly;
};

/// Quantities of one dimension over time, and the first of them in the runs beside.
Panel strip_of_assembly(const Assembly& assembly, const std::vector<AssemblyBeside>& beside,
                        const std::string& label, const Dimension& dimension,
                        const std::vector<AssemblyStrip>& all, const QuantityFormat& time) {
  double most = 0;
  for (const AssemblyStrip& each : all)
    for (const AssemblyState& state : assembly.states)
      most = std::max(most, std::abs(each.of(state)));
  const QuantityFormat format(most, dimension);
  Panel panel{
      "", {"", false, 0.0}, {label + (format.unit().empty() ? "" : " [" + format.unit() + "]")}};
  for (const AssemblyStrip& each : all) {
    Curve curve{all.size() > 1 ? each.label : "", each.look, {}, {}};
    for (std::size_t k = 0; k < assembly.time.size(); ++k) {
      curve.x.push_back(assembly.time[k] / time.factor());
      curve.y.push_back(each.of(assembly.states[k]) / format.factor());
    }
    panel.curves.push_back(std::move(curve));
  }
  for (const auto& [name, other] : beside) {
    Curve curve{name, {Ink::black, Line::dotted}, {}, {}};
    for (std::size_t k = 0; k < other->time.size(); ++k) {
      curve.x.push_back(other->time[k] / time.factor());
      curve.y.push_back(all.front().of(other->states[k]) / format.factor());
    }
    panel.curves.push_back(std::move(curve));
  }
  return panel;
}

constexpr Look kMeasured{Ink::blue, Line::none, Marker::circle};

Panel velocity_panel(const Assembly& assembly) {
  Panel panel{"", {"component of velocity over its root mean square"}, {"probability density"}};
  const auto [a2, error] = assembly.sonine();
  Curve seen{"of the bodies", kMeasured, {}, {}},
      maxwell{"Maxwell", {Ink::black, Line::dashed}, {}, {}};
  Curve sonine{fmt::format("with a_2 = {:.3g}{}", a2,
                           std::isfinite(error) ? fmt::format(" ± {:.2g}", error) : ""),
               {Ink::vermilion, Line::solid},
               {},
               {}};
  for (std::size_t k = 0; k < assembly.velocity.counts.size(); ++k) {
    const double c = assembly.velocity.middle(k);
    for (Curve* each : {&seen, &maxwell, &sonine}) each->x.push_back(c);
    seen.y.push_back(assembly.velocity_density(k));
    maxwell.y.push_back(Assembly::maxwell(c));
    sonine.y.push_back(Assembly::with_sonine(c, a2));
  }
  panel.curves = {std::move(maxwell), std::move(sonine), std::move(seen)};
  return panel;
}

Panel pairs_panel(const Assembly& assembly) {
  Panel panel{
      "", {"distance over the mean diameter", false, 0.0}, {"pair correlation g", false, 0.0}};
  Curve seen{"", {Ink::blue, Line::solid}, {}, {}};
  for (std::size_t k = 0; k < assembly.pairs.counts.size(); ++k) {
    seen.x.push_back(assembly.pairs.middle(k));
    seen.y.push_back(assembly.pair_correlation(k));
  }
  const double last = seen.x.back();
  panel.curves = {{"ideal gas", {Ink::black, Line::dashed}, {0, last}, {1, 1}}, std::move(seen)};
  return panel;
}

}  // namespace

std::vector<Chart> assembly_charts(const SceneRecord& scene, std::set<std::string>& taken) {
  std::vector<AssemblyBeside> beside;
  for (const EngineRecord& run : scene.runs)
    if (run.assembly) beside.push_back({plot_literal(run.engine), &*run.assembly});
  const Assembly* shown = scene.reference.assembly ? &*scene.reference.assembly : nullptr;
  std::string name = plot_literal(scene.scenario.name);
  if (!shown && !beside.empty()) {  // the reference was left out
    shown = beside.front().assembly;
    name += " in " + beside.front().label;
    beside.erase(beside.begin());
  }
  if (!shown || shown->time.size() < 2) return {};
  const Assembly& assembly = *shown;
  const QuantityFormat time(assembly.time.back(), kTime);
  Chart series{file_stem("assembly-" + scene.scenario.name, taken),
               name + " as a whole",
               fmt::format("{} bodies: energies of all together; contacts of a body with others, "
                           "without rattlers; the mean of the normal stresses by normal forces and "
                           "motion.",
                           assembly.bodies),
               {},
               1,
               110};
  series.panels.push_back(strip_of_assembly(
      assembly, beside, "height of the centre of mass", kLength,
      {{"", {Ink::blue, Line::solid}, [](const auto& s) { return s.height; }}}, time));
  series.panels.push_back(strip_of_assembly(
      assembly, beside, "energy", kEnergy,
      {{"of translation", {Ink::blue, Line::solid}, [](const auto& s) { return s.kinetic_energy; }},
       {"of rotation",
        {Ink::vermilion, Line::dashed},
        [](const auto& s) { return s.rotational_energy; }},
       {"elastic", {Ink::green, Line::dotted}, [](const auto& s) { return s.elastic_energy; }}},
      time));
  series.panels.push_back(strip_of_assembly(
      assembly, beside, "contacts of a body", kPureNumber,
      {{"all bodies", {Ink::blue, Line::solid}, [](const auto& s) { return s.coordination; }},
       {"without rattlers",
        {Ink::vermilion, Line::dashed},
        [](const auto& s) { return s.coordination_of_carried; }}},
      time));
  series.panels.push_back(strip_of_assembly(
      assembly, beside, "pressure", kPressure,
      {{"", {Ink::blue, Line::solid}, [](const auto& s) { return s.pressure(); }}}, time));
  series.panels.front().title = name;
  series.panels.back().x.label = "time [" + time.unit() + "]";
  Chart distributions{file_stem("distributions-" + scene.scenario.name, taken),
                      name + " over the second half of the run",
                      "Velocities beside Maxwell's distribution and its first correction by "
                      "Sonine's polynomials; distances beside those of bodies at random.",
                      {}};
  if (std::isfinite(assembly.velocity_density(0)))
    distributions.panels.push_back(velocity_panel(assembly));
  distributions.panels.push_back(pairs_panel(assembly));
  return {std::move(series), std::move(distributions)};
}

}  // namespace slipcheck
