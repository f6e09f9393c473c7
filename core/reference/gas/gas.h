#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "physics/sphere.h"
#include "reference/events/huge_pages.h"
#include "reference/gas/gas_law.h"
#include "reference/gas/gas_visit.h"

namespace slipcheck {

/// A homogeneous gas of equal spheres.
struct GasSetup {
  Sphere sphere;
  int dimensions = 3;               ///< 2 (disks, spins about the normal) or 3
  std::size_t particles = 100'000;  ///< a multiple of 8, >= 16
  double filled = 0.005;            ///< φ, share of the space that they fill, in (0, 0.5]
  double speed = 1;                 ///< root mean square at the start [m/s], > 0
  double rotation = 0;              ///< T_rot/T at the start [-], >= 0
  std::uint64_t seed = 1;
  double step = 0.25;  ///< of time, in mean times between two collisions of a particle, in (0, 1]
  std::size_t threads = 1;  ///< 0: one for each core
};

/// Sums over some of the particles, in velocities.
struct GasMoments {
  double particles = 0, v2 = 0, v4 = 0, w2 = 0;
};

/// The Boltzmann (with χ(φ): Enskog) equation of a homogeneous gas by direct simulation Monte Carlo
/// with Bird's no-time-counter scheme (Molecular Gas Dynamics, 1994). From B (40), which is
/// misprinted, it needs the direct collision rule alone.
///
/// In the time Δt a cell of N particles has N n χ σ_T G Δt/2 candidate pairs, each of which
/// collides with the probability g/G (visit_cell()). G is twice the largest speed in the cell when
/// the step begins. As pairs collide one after the other with the velocities that they have, a cell
/// is a Markov process whose rates are right at each moment: the step has no error of its own but
/// that of candidates whose number is not random (of the order of 1/N) and of a G that was
/// overtaken (counted).
///
/// Cells only keep the particles at hand in a near cache; in a homogeneous gas any two may meet.
/// Every cell takes one piece from each of sixteen columns of memory, and after each step each
/// column is turned by a random number of pieces, so that the energies of cells cannot drift apart
/// and no two pieces stay together. A cell has random numbers of its own: the number of threads
/// changes no bit.
class Gas {
 public:
  /// Maxwellian velocities of this speed and rotation to rounding, with the momentum 0.
  Gas(const GasSetup& setup, const GasLaw& law);

  /// One step.
  void advance();

  double now() const { return now_; }  ///< [s]
  std::size_t collisions() const { return collisions_; }
  double collisions_per_particle() const {
    return 2 * static_cast<double>(collisions_) / static_cast<double>(setup_.particles);
  }
  std::size_t overtaken() const { return overtaken_; }
  const GasSetup& setup() const { return setup_; }
  bool spins() const { return layout_.spins; }
  std::size_t cells() const { return cells_.size(); }

  /// The sums over kBatches parts of the particles.
  static constexpr std::size_t kBatches = 32;
  std::vector<GasMoments> moments() const;
  /// The k-th particle: its velocity and ω, in two dimensions those in the plane z = 0.
  BodyState particle(std::size_t k) const;

 private:
  struct Cell {
    GasRandom random;
    std::vector<std::uint32_t> groups = {};
    double rest = 0;        ///< of a candidate, from the step before
    double square_sum = 0;  // v² before its step
    std::size_t collisions = 0, overtaken = 0;
  };
  /// The c-th component of the k-th particle.
  double& component(std::size_t k, std::size_t c) {
    return particles_[k / kGasGroup * (layout_.stride() / kGasGroup) + c].at[k % kGasGroup];
  }
  double component(std::size_t k, std::size_t c) const {
    return particles_[k / kGasGroup * (layout_.stride() / kGasGroup) + c].at[k % kGasGroup];
  }
  void fill(std::size_t from, std::size_t to, double mean_square, GasRandom& random);
  void deal();
  void visit(Cell& cell, double time);

  GasSetup setup_;
  GasLaw law_;
  GasLayout layout_;
  std::size_t groups_;
  struct alignas(64) Eight {
    double at[kGasGroup] = {};
  };
  std::vector<Eight, HugePages<Eight>> particles_;  // a component of a group each
  std::vector<Cell> cells_;
  GasRandom turns_;
  double rate_;         // n χ σ_T [1/m]
  double mean_square_;  // ⟨v²⟩ when the last step began
  double now_ = 0;
  std::size_t collisions_ = 0, overtaken_ = 0;
};

}  // namespace slipcheck
