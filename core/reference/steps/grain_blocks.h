#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "base/state_archive.h"
#include "reference/steps/grain_kernels.h"

namespace slipcheck {

/// How many steps GrainSolver takes as one block, and how thick the skin of its list of neighbours
/// is: what costs least, as the last block lets expect.
class GrainBlocks {
 public:
  static constexpr std::size_t kLongest = 64;

  GrainBlocks() = default;
  /// step: h [s]; braking: the largest acceleration of a grain by the substrate [m/s²]; landing: by
  /// a landing, the largest change of its speed along the plane for its speed towards it [-];
  /// driven: the plane carries the grains along.
  GrainBlocks(double step, double braking, double landing, bool driven)
      : step_(step), braking_(braking), landing_(landing), gliding_(driven ? kDriven : 1) {}

  void exchange(StateArchive& archive) {
    archive(fastest_, across_, skin_, moved_, joining_, last_length_);
  }

  double fastest() const { return fastest_; }  ///< speed of a grain along the plane [m/s]
  GrainSpeeds speeds() const { return {fastest_ * fastest_, across_ * across_}; }
  void set_fastest(const GrainSpeeds& speeds) {
    fastest_ = std::sqrt(speeds.along2);
    across_ = std::sqrt(speeds.across2);
  }
  double skin() const { return skin_; }  ///< [m]

  /// A bound on speeds within `length` steps [m/s]; GrainSolver does a block again that breaks it.
  double bound(std::size_t length) const {
    return kFaster * fastest_ + landing_ * across_ + braking_ * step_ * static_cast<double>(length);
  }
  /// How near grains must be to meet within `length` steps [m].
  double margin(std::size_t length) const {
    return 2 * bound(length) * step_ * static_cast<double>(length);
  }
  /// Whether none but those of the list can meet within `length` steps.
  bool cover(std::size_t length) const { return 2 * moved_ + margin(length) <= skin_; }

  /// The length of the next block, at most `steps`; 0 where the list no longer covers one step.
  /// listed: pairs of the list; touching: of them, those in contact.
  std::size_t next(std::size_t steps, std::size_t grains, std::size_t listed,
                   std::size_t touching) const {
    const double all = gliding_ * static_cast<double>(grains) +
                       kLook * static_cast<double>(listed) +
                       kIsland * 2 * static_cast<double>(touching);
    const double best = std::sqrt(all / (kSteps * std::max(joining_, 1e-6)));
    const auto length = static_cast<std::size_t>(
        std::clamp(best, 1.0, static_cast<double>(std::min(steps, kLongest))));
    // Where the list covers less than two such, what it covers goes in equal parts.
    std::size_t covered = 2 * length;
    while (covered > 0 && !cover(covered)) --covered;
    return covered > length ? (covered + 1) / 2 : covered;
  }

  /// Chooses the skin of a new list. density: grains over area [1/m²].
  void renew(std::size_t length, double diameter, double density) {
    // A grain has about π ρ d s neighbours in a skin s, looked at once in a block; s lasts for
    // s over twice the speed.
    const double speed = 2 * bound(length);
    const double looks =
        kLook * std::numbers::pi * density * diameter / (static_cast<double>(last_length_) * step_);
    const double best = std::sqrt(kNeighbours * speed / looks);
    skin_ = std::max(std::clamp(best, 0.1 * diameter, 0.6 * diameter), 1.01 * margin(1));
    moved_ = 0;
  }

  /// A block is done. active: grains in islands; fastest: after it.
  void took(std::size_t length, std::size_t active, std::size_t touching,
            const GrainSpeeds& fastest) {
    moved_ += bound(length) * step_ * static_cast<double>(length);
    set_fastest(fastest);
    joining_ = std::max(0.0, static_cast<double>(active) - 2 * static_cast<double>(touching)) /
               static_cast<double>(length);
    last_length_ = length;
  }

 private:
  // Costs in units of one grain gliding through a block, about 1 ns. They only tell how long blocks
  // and how thick skins are.
  static constexpr double kDriven = 6;        ///< of a grain carried along, beside its steps
  static constexpr double kLook = 1;          ///< at a pair of the list
  static constexpr double kSteps = 4;         ///< of a grain in an island, each step
  static constexpr double kIsland = 40;       ///< to sort a grain into one
  static constexpr double kNeighbours = 400;  ///< of a grain, to find them
  /// How much faster than the fastest now a grain may get in a block before it is done again.
  static constexpr double kFaster = 1.1;

  double step_ = 0, braking_ = 0, landing_ = 0, gliding_ = 1;
  double fastest_ = 0, across_ = 0;  ///< speeds of grains along the plane and across it [m/s]
  double skin_ = 0;
  double moved_ = 0;    ///< at most, by any grain since the list was made [m]
  double joining_ = 1;  ///< grains that a further step in a block adds to islands
  std::size_t last_length_ = 8;
};

}  // namespace slipcheck
