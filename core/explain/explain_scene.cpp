#include "explain/explain_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "explain/explain_parts.h"
#include "harness/compare/closed_form_values.h"
#include "harness/compare/scene_features.h"
#include "harness/run/reference_run.h"
#include "physics/closed_forms.h"
#include "reference/events/planar_solver.h"
#include "reference/initial_contacts.h"
#include "reference/reference_solver.h"
#include "scenario/observable_key.h"

namespace slipcheck {
namespace {

std::string solver_text(const ContactScene& scene, const ReferenceSolver& solver) {
  const bool boxed = scene.hard.box.has_value();
  const std::string text =
      boxed && solver.is_resolved() ? "contacts last; their forces are integrated in time"
      : boxed && scene.is_hard() ? "every contact is hard; exact flight from collision to collision"
      : solver.is_piled()        ? "contacts last and remember; in steps of fixed length"
      : solver.is_stepped()
          ? fmt::format("contacts last; in steps of {}", in_unit(solver.step(), "s"))
      : solver.is_resolved()
          ? (scene.is_hard() ? "asked for by compare.reference; collisions are instants"
                             : "contacts last; all forces are integrated in time")
      : !scene.is_hard() ? "asked for by compare.reference; soft contacts become hard ones"
      : !scene.hard.surfaces.empty() && solver.is_exact()
          ? "every contact is hard; impacts on surfaces, phases between them"
      : has_exact_phases(scene.hard) ? "every contact is hard; exact phases between collisions"
      : solver.is_exact()
          ? "every contact is hard; phases between collisions to 1e-13 of the speeds"
          : "every contact is hard; integrated between collisions";
  return fmt::format("{} ({})", solver.name(), text);
}

/// What the loop was made for.
ExplainSection loop_section(const std::vector<std::string>& loop) {
  ExplainSection section{.title = "Loop"};
  for (const std::string& part : loop) section.add(part);
  return section;
}

ExplainSections features(const ContactScene& scene) {
  ExplainSection needs{.title = "Needs", .label_width = 36};
  ExplainSection left_out{.title = "Left out", .label_width = 36};
  for (const Feature& feature : scene_features(scene))
    (feature.needed ? needs : left_out).add(feature.name, feature.detail);
  return {needs, left_out};
}

/// What the cues give their balls.
ExplainSections cues(const Scenario& scenario) {
  ExplainSections sections;
  const auto listed = [](const Vector3& v, const char* unit) {
    return fmt::format("[{:.5g}, {:.5g}, {:.5g}] {}", v.x(), v.y(), v.z(), unit);
  };
  for (const Body& body : scenario.bodies) {
    if (!body.stroke) continue;
    ExplainSection& section = sections.emplace_back();
    section.title = "Cue on " + body.name + ", without squirt";
    section.add("J", in_unit(body.stroke->impulse, "N s"), "impulse along the cue");
    section.add("v", listed(body.initial.velocity, "m/s"), "velocity of the ball");
    section.add("Ω", listed(body.initial.angular_velocity, "rad/s"), "its spin");
  }
  return sections;
}

/// What came from presets, and where they have it from.
ExplainSections from_presets(const Scenario& scenario) {
  if (scenario.presets.empty()) return {};
  ExplainSection section{.title = "From presets", .label_width = 40};
  for (const UsedPreset& used : scenario.presets)
    section.add(used.path, fmt::format("{} ({}: {})", used.value, used.preset, used.source));
  return {section};
}

/// What tilt and motion do to a body that rolls, K (17), (22)-(25).
ExplainSections substrate(const Scenario& scenario, const Scene& scene) {
  if (!scene.has_substrate) return {};
  const Vector3 downhill(scene.downhill.x(), scene.downhill.y(), 0);
  const double shaking = scene.motion.largest_acceleration();
  if (downhill.norm() == 0 && shaking == 0) return {};
  ExplainSection section{.title = "Substrate, under " + scenario.bodies[0].name};
  const double A = scene.bodies[0].inverse_shape_factor();
  const auto rolled = [&](const Vector3& a_G, double a_S) {
    return in_unit(rolling_acceleration(A, a_G, a_S * Vector3::UnitX()).norm(), "m/s²");
  };
  const bool rolls = A > 0;  // no block
  if (downhill.norm() > 0 && rolls)
    section.add("a_roll", rolled(downhill, 0),
                fmt::format("down the slope while it rolls, of {:.5g} m/s²", downhill.norm()));
  if (shaking > 0) {
    section.add("a_S", in_unit(shaking, "m/s²"), "largest acceleration of the substrate");
    if (rolls)
      section.add("a_roll", rolled(Vector3::Zero(), shaking), "of a body that rolls on it then");
  }
  section.add(
      "|a_S − a_G|",
      in_unit(rolling_limit(A, scene.on_substrate(0).static_friction, scene.gravity), "m/s²"),
      rolls ? "up to here it rolls, beyond it slides" : "up to here it holds, beyond it slips");
  return {section};
}

ExplainSection expectations(const Scenario& scenario, const ContactScene& scene,
                            const ReferenceSolver& solver) {
  const double contact = solver.first_contact(run_end(scenario).last());
  ExplainSection section{.title = "Expected", .label_width = 40};
  const bool overlaps = !initial_contacts(scene, scene.hard.initial).empty();
  if (overlaps)
    section.add("bodies overlap at the start: engines run once");
  else if (std::isfinite(contact))
    section.add(
        fmt::format("first contact after {}: engines run as ensembles over its phase in a step",
                    quantity(contact, kTime)));
  else
    section.add("no contact but with the substrate: engines run once");

  Scene hard = scene.hard;
  const bool rubs =
      std::ranges::any_of(hard.pairs, [](const auto& pair) { return has_friction(pair.friction); });
  if (!scene.is_hard())
    for (PairContact& pair : hard.pairs) pair.friction = 0;
  const auto values = has_exact_phases(hard) && !overlaps
                          ? closed_form_values(hard, body_names(scenario))
                          : std::map<std::string, double>{};
  if (values.empty()) {
    section.add("no closed form applies");
    return section;
  }
  section.add(scene.is_hard() ? "closed forms"
              : rubs
                  ? "closed forms, with hard contacts of the same restitution and without rubbing"
                  : "closed forms, with hard contacts of the same restitution");
  for (const auto& [name, value] : values)
    if (observable_key(name).observable == "effective_restitution" && value < 0)
      section.add(name + " is below 0: they meet again, and these hold until then");
  for (const auto& [name, value] : values) {
    const ObservableKey key = observable_key(name);
    if (key.component != '\0') continue;
    const std::string unit = key.known()->dimension.si;
    section.add(name, fmt::format("{:.10g}{}{}", value, unit.empty() ? "" : " ", unit));
  }
  return section;
}

void append(ExplainSections& sections, ExplainSections more) {
  std::ranges::move(more, std::back_inserter(sections));
}

ExplainSections in_box(const Scenario& scenario, const ContactScene& scene) {
  ExplainSections all = explain_box(scenario, scene);
  const double speed = planar_speed_scale(scene.hard, scene.hard.initial);
  append(all, explain_contacts(scenario, scene, std::nullopt, speed > 0 ? speed : 1));
  return all;
}

ExplainSections on_substrate(const Scenario& scenario, const ContactScene& scene,
                             const ReferenceSolver& solver) {
  const auto meeting = first_meeting(scene, run_end(scenario).last());
  ExplainSections all = substrate(scenario, scene.hard);
  append(all, explain_gas(scene.hard));
  append(all, explain_contacts(scenario, scene, meeting, 1));
  if (meeting) append(all, explain_meeting(scenario, scene, *meeting));
  append(all, {expectations(scenario, scene, solver)});
  return all;
}

}  // namespace

Explanation explain_scene(const Scenario& scenario, const ContactScene& scene, bool general) {
  const ReferenceSolver solver(scene, reference_settings(scenario, general));
  Explanation all{solver_text(scene, solver), {loop_section(solver.loop())}};
  append(all.sections, features(solver.scene()));
  append(all.sections, from_presets(scenario));
  append(all.sections, {explain_bodies(scenario, scene.hard)});
  append(all.sections, cues(scenario));
  append(all.sections,
         scene.hard.box ? in_box(scenario, scene) : on_substrate(scenario, scene, solver));
  if (scene.warnings.empty()) return all;
  ExplainSection& section = all.sections.emplace_back();
  section.title = "Warnings";
  for (const std::string& warning : scene.warnings) section.add(warning);
  return all;
}

}  // namespace slipcheck
