#pragma once

#include <map>
#include <string>
#include <vector>

#include "harness/compare/record.h"
#include "scenario/observable_names.h"

namespace slipcheck {

/// The observable of a full name as in "i.final_velocity.x"; null if there is none.
const ObservableName* observable_of(std::string_view full_name);

/// Its dimension, a pure number where the name is unknown.
const Dimension& dimension_of(std::string_view full_name);

/// Whether the scene states a tolerance for it.
bool has_tolerance(const Scenario& scenario, std::string_view full_name);

/// What a tolerance names but the reference does not show, by full name with the reason; under the
/// tolerance's own key where the reference shows nothing that it names.
std::map<std::string, std::string> absent_observables(const SceneRecord& scene);

/// What a person sees of a scene, by full name and in order: what has a tolerance (shown or
/// absent), what a run is judged by, what is expected of an engine, and restitution coefficients;
/// with `all`, or where that would be nothing and for a scene without engines, everything that the
/// reference shows, of vectors the length only unless `all`.
std::vector<std::string> shown_observables(const SceneRecord& scene, bool all);

}  // namespace slipcheck
