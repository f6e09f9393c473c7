#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "physics/frame.h"
#include "studies/stability/outcome.h"
#include "studies/stability/reference_path.h"

namespace slipcheck {

/// Follows the energy of a run beside the reference's. It is known as far as shown_energy() says;
/// only what lies beyond that counts. Nor do minima and losses in frames in which a contact is
/// young: an engine that gives way a little holds energy in it that it does not show.
class EnergyWatch {
 public:
  /// As of OutcomeWatch; `path` must outlive this.
  EnergyWatch(const ReferencePath& path, const OutcomeCriteria& criteria, double step, bool soft);

  void begin(double time, std::span<const BodyState> states);
  void take(double time, const Frame& frame);

  /// Largest rise over an earlier minimum beyond what the reference's energy rises by, over the
  /// energy scale [-], >= 0. Contacts that overlap at the start may give back their elastic energy.
  double gain() const { return gain_; }
  /// Largest fall below an earlier maximum, over the energy scale [-], >= 0; 0 where the reference
  /// does not conserve its energy.
  double loss() const { return loss_; }

  /// What is wrong by the criteria; accurate where nothing is.
  PhaseOutcome outcome() const;

 private:
  /// Whether a contact may hold energy in this frame.
  bool holds_energy(const Frame& frame);

  const ReferencePath* path_;
  OutcomeCriteria criteria_;
  double step_;
  bool soft_, conserved_;
  std::size_t young_;          ///< how long a contact may hold energy [frames]
  std::vector<double> slack_;  ///< of each body's height [m]
  std::map<std::pair<int, int>, std::size_t> ages_;  ///< of the contacts in the last frame [frames]
  double allowed_ = 0;                               ///< rise [J]
  double lowest_ = 0, highest_ = 0;
  double gain_ = 0, loss_ = 0;
  double grows_at_ = 0, falls_at_ = 0;  ///< when a criterion was first missed [s]
};

}  // namespace slipcheck
