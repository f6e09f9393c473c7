#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "physics/vector.h"

namespace slipcheck {

/// What did not happen: a NaN of its own, which arithmetic hands on and never makes.
inline constexpr double kNotObserved = std::bit_cast<double>(std::uint64_t{0x7ff8'0000'6e6f'6e65});
/// Else a NaN was computed, which is a fault.
inline bool is_not_observed(double value) {
  return std::bit_cast<std::uint64_t>(std::abs(value)) ==
         std::bit_cast<std::uint64_t>(kNotObserved);
}
inline const Vector3 kVectorNotObserved = Vector3::Constant(kNotObserved);

// What a run shows, defined in docs/observables.md. What did not happen is NaN. Times and distances
// count from the end of the body's last collision with another body, or from the start.

struct BodyObservables {
  double sliding_time = kNotObserved;      ///< time spent sliding [s]
  double sliding_distance = kNotObserved;  ///< length of the displacement while it slides [m]
  Vector3 velocity_after_collision = kVectorNotObserved;          ///< v^f [m/s]
  Vector3 slip_after_collision = kVectorNotObserved;              ///< u^f [m/s]
  Vector3 angular_velocity_after_collision = kVectorNotObserved;  ///< Ω^f [rad/s]
  Vector3 rolling_velocity = kVectorNotObserved;                  ///< v^s [m/s]
  double energy_change_sliding = kNotObserved;                    ///< |v^f|² − |v^s|² [m²/s²]
  double momentum_change_sliding = kNotObserved;  ///< (v^f − v^s)·n, n away from the other [m/s]
  double stopping_time = kNotObserved;            ///< [s]
  double stopping_distance = kNotObserved;        ///< [m]
  double spin_stopping_time = kNotObserved;       ///< until Ω_z = 0 [s]
  double lift_off_speed = kNotObserved;           ///< v^z [m/s]
  double jump_height = kNotObserved;              ///< h^z [m]
  double flight_time = kNotObserved;              ///< t^z [s]
  Vector3 final_position = kVectorNotObserved;    ///< [m]
  Vector3 final_velocity = kVectorNotObserved;    ///< [m/s]
  Vector3 final_angular_velocity = kVectorNotObserved;  ///< [rad/s]
};

struct PairObservables {
  int first = 0;
  int second = 0;                                ///< body, > first, kSubstrate or surface_touch()
  double restitution = kNotObserved;             ///< normal: −g'/g of the centres
  double tangential_restitution = kNotObserved;  ///< ε^T: g' = +ε^T g at the contact point
  double effective_restitution = kNotObserved;   ///< once neither slides
  // Of a contact that lasts:
  double contact_time = kNotObserved;   ///< [s]
  double max_overlap = kNotObserved;    ///< [m]
  double sliding_onset = kNotObserved;  ///< from the first touch [s]
};

struct Observables {
  std::vector<BodyObservables> bodies;
  std::vector<PairObservables> pairs;  ///< that collided, in order of the bodies
  /// Of the centre of mass over z = 0 at the end, beside surfaces [m].
  double height = kNotObserved;
};

/// The full name of a value that these bodies and pairs can have: "i.sliding_time",
/// "i.final_velocity.x", "i-j.restitution". A vector's bare name is its length. The names of the
/// surfaces beside the substrate stand after those of the bodies.
std::string value_name(const Observables& observables, const std::vector<std::string>& body_names,
                       std::size_t index);
/// The same into a string that may have room for it.
void write_value_name(const Observables& observables, const std::vector<std::string>& body_names,
                      std::size_t index, std::string& name);

/// The body of such a value, null of a pair's or of all.
const BodyObservables* body_of_value(const Observables& observables, std::size_t index);

/// The values in the order of their value_name(), NaN where not observed.
std::vector<double> flat_values(const Observables& observables);

/// Of values in the order of flat_values(), such as their uncertainties: gives each component of a
/// vector the largest finite one of them, where it is finite itself. One alone may be small by
/// chance.
void share_within_vectors(const Observables& observables, std::vector<double>& values);

/// The places of flat_values() in the order of their names: what is put into a map in this order
/// needs no search in it.
std::vector<std::size_t> order_of_names(const Observables& observables,
                                        const std::vector<std::string>& body_names);

/// Both together, what is not observed left out.
std::map<std::string, double> named_values(const Observables& observables,
                                           const std::vector<std::string>& body_names);

/// `observables` with the bodies and pairs of `like`, in its order: what has no counterpart there
/// is dropped, what is missing is not observed.
Observables aligned(const Observables& observables, const Observables& like);

}  // namespace slipcheck
