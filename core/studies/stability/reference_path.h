#pragma once

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "harness/run/prepared_scene.h"
#include "studies/stability/outcome.h"

namespace slipcheck {

/// What the reference shows of a scene on a substrate along its run, as the outcomes of other
/// methods are judged by: energies, rests and overlaps. Looked at at even times, and where the
/// substrate oscillates at least 32 times a period (up to 8192 in all); on a moving substrate the
/// energies of the instants of all events count too, where slipping turns round.
class ReferencePath {
 public:
  /// `scene` is on a substrate and must outlive this; `samples` >= 1 beside the start. Where the
  /// reference fails on the way, what lies beyond is missing (end()).
  explicit ReferencePath(const PreparedScene& scene, std::size_t samples = 256);

  const PreparedScene& prepared() const { return *prepared_; }
  const ContactScene& scene() const { return *scene_; }
  const std::vector<double>& times() const { return times_; }                    ///< [s], from 0 on
  const std::vector<std::vector<BodyState>>& states() const { return states_; }  ///< at times()
  double end() const { return times_.back(); }                                   ///< [s], >= 0

  /// The fastest that the scene can make a body until `time` [s]: what they bring with them, and
  /// falling [m/s].
  double fastest(double time) const;
  /// What changes of the energy are measured by [J], > 0: the largest kinetic energy or the range
  /// of the potential energy, whichever is more; Σ m g R where nothing moves.
  double energy_scale() const { return energy_scale_; }
  /// Largest rise of the energy over an earlier minimum [J]; beyond rounding only where the
  /// substrate moves.
  double energy_rise() const { return energy_rise_; }
  /// max − min of the energy [J].
  double energy_range() const { return energy_range_; }
  /// From when on a body rests over the substrate, to the end [s]; infinite where it does not.
  double rests_from(std::size_t body) const { return rests_from_[body]; }
  /// Duration of the longest contact of two bodies [s]; 0 where contacts are instants.
  double longest_contact() const { return longest_contact_; }
  /// Deepest overlap of two bodies, first < second [m], >= 0.
  double overlap(int first, int second) const;

 private:
  void look_at_energies(const ReferenceSolver& solver);
  void look_at_rests();
  void look_at_contacts();

  const PreparedScene* prepared_;
  const ContactScene* scene_;
  double speed_scale_ = 0;
  std::vector<double> times_;
  std::vector<std::vector<BodyState>> states_;
  double energy_scale_ = 0, energy_rise_ = 0, energy_range_ = 0;
  std::vector<double> rests_from_;
  double longest_contact_ = 0;
  std::map<std::pair<int, int>, double> overlaps_;  ///< that are > 0
};

}  // namespace slipcheck
