#include "scenario/observable_names.h"

#include <algorithm>
#include <array>

namespace slipcheck {
namespace {

using enum ObservableScope;

constexpr ObservableName scalar(std::string_view name, std::string_view doc, Dimension dimension,
                                ObservableScope scope) {
  return {name, doc, dimension, scope, false, false};
}
constexpr ObservableName vector(std::string_view name, std::string_view doc, Dimension dimension) {
  return {name, doc, dimension, body, true, false};
}
constexpr ObservableName restitution(std::string_view name, std::string_view doc) {
  return {name, doc, kPureNumber, pair, false, true};
}

constexpr std::array kNames = {
    vector("angular_velocity_after_collision", "Ω at the end of the last collision",
           kAngularVelocity),
    scalar("collision_rate", "collisions per time of all bodies", kRate, all),
    scalar("contact_time", "duration of the last collision", kTime, pair),
    restitution("effective_restitution",
                "relative velocity once neither body slides over that before the collision"),
    scalar("energy_change_sliding", "|v^f|² − |v^s|² while the body slides", kSpecificEnergy, body),
    scalar("energy_drift", "relative error of the energy balance", kPureNumber, all),
    vector("final_angular_velocity", "Ω at the end of the run", kAngularVelocity),
    vector("final_position", "centre at the end of the run", kLength),
    vector("final_velocity", "velocity at the end of the run", kVelocity),
    scalar("flight_time", "time off the substrate", kTime, body),
    scalar("height", "H, mean height of the centre of mass over its height at rest (L)", kLength,
           all),
    scalar("jump_height", "largest height of the lowest point over the substrate", kLength, body),
    scalar("kinetic_energy", "K, of the translation (L)", kEnergy, all),
    scalar("lift_off_speed", "vertical speed at which the body leaves the substrate", kVelocity,
           body),
    scalar("max_overlap", "largest overlap of the last collision", kLength, pair),
    scalar("momentum_change_sliding", "v^f − v^s along the line of centres while the body slides",
           kVelocity, body),
    scalar("momentum_drift", "relative error of the momentum balance", kPureNumber, all),
    restitution("restitution", "normal restitution of the last collision"),
    vector("rolling_velocity", "velocity when sliding ends", kVelocity),
    scalar("rotational_energy", "R, of the rotation (L)", kEnergy, all),
    scalar("sliding_distance", "length of the displacement while the body slides", kLength, body),
    scalar("sliding_onset", "time from the first touch to the start of sliding", kTime, pair),
    scalar("sliding_time", "time that the body slides", kTime, body),
    vector("slip_after_collision", "slip velocity on the substrate after the last collision",
           kVelocity),
    scalar("spin_stopping_time", "time until the spin about the vertical ends", kTime, body),
    scalar("stopping_distance", "distance until the body rests", kLength, body),
    scalar("stopping_time", "time until the body rests", kTime, body),
    restitution("tangential_restitution", "tangential restitution of the last collision"),
    vector("velocity_after_collision", "velocity at the end of the last collision", kVelocity),
};

}  // namespace

std::span<const ObservableName> observable_names() { return kNames; }

const ObservableName* find_observable(std::string_view name) {
  const auto found = std::ranges::find(kNames, name, &ObservableName::name);
  return found == kNames.end() ? nullptr : &*found;
}

}  // namespace slipcheck
