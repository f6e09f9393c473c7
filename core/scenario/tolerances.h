#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "scenario/scenario.h"

namespace slipcheck {

/// Whether a key of compare.tolerance names an observable (a full name): of its owner, of owners
/// that match it, or without an owner of all bodies, pairs of bodies, or the whole. Where no two
/// bodies can meet, a name without an owner is also that of what is between the body and the
/// substrate; elsewhere a hop on the substrate is not judged by chance.
bool names_observable(const Scenario& scenario, std::string_view key, std::string_view full_name);

/// The tolerance that judges an observable: of those that name it the one that says most of its
/// owner. None where none names it, or that one is `none`. `absolute` is set for restitution
/// coefficients.
std::optional<Tolerance> tolerance_of(const Scenario& scenario, std::string_view full_name);

/// The same; of a vector's component without a tolerance of its own, that of the vector.
std::optional<Tolerance> tolerance_of_part(const Scenario& scenario, std::string_view full_name);

}  // namespace slipcheck
