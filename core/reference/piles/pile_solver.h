#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "reference/kept_solver.h"
#include "reference/piles/pile_law.h"
#include "scene/contact_scene.h"

namespace slipcheck {

struct PileSettings {
  double steps_per_contact = 40;  ///< of the shortest half period of all springs [-], > 0
  /// Of that length [s] in place of it, where > 0.
  double step = 0;
  double collision_time = 0;  ///< of hard contacts [s]; 0: pile_collision_time()
  double least_restitution = PileLaws::kLeastRestitution;  ///< of hard contacts, in (0, 1]
  /// Shows a frame every so many steps, >= 1, and at the end.
  std::size_t steps_per_frame = 1;
  /// Bodies that rest at the start where others or surfaces carry them are loaded slowly first;
  /// not in a solver that is to read a state.
  bool prepare = true;
  bool skip_rest = true;  ///< the rest of a run in which nothing changes any more
  bool general = false;   ///< takes the loop that leaves out nothing
  /// That share each step of many bodies; 0: one for each core. The results are the same bits.
  std::size_t threads = 1;
  /// So many bodies are many: they are sorted by where they are (PileSlabs).
  std::size_t ordered_from = 2000;
};

/// Spheres that touch each other, the substrate and surfaces, any number at once, in contacts that
/// remember (PileLaws, PileLoop), in steps of fixed length.
///
/// A scene in which everything is at rest at the start, on still surfaces under gravity, is
/// prepared: gravity grows from nothing over 200 collisions, while all motion is damped at a fifth
/// of a collision's rate, with all springs and caps at work, and then stays until 1e-8 of it is
/// left as acceleration, 3000 collisions are over or a body has moved by 1e-2 of its radius.
/// Contacts that slide meanwhile are associated (PileLoop), so that an equilibrium is found
/// whenever the caps, less 0.2 %, allow one; which of many the contacts' stiffnesses tell. The run
/// starts from there, at rest, with what the contacts remember, and with Coulomb's law. What
/// touches nothing at the start, within 1e-5 of a radius, is not loaded before that.
///
/// Where nothing but the state changes (still surfaces), and for 10 √(R/g) no body
/// moves or turns by more than 1e-12 of its radius, all is at rest for ever: the rest of the run is
/// skipped.
class PileSolver final : public KeptSolver {
 public:
  /// The scene must outlive the solver. Throws Unsupported for what PileLaws has not.
  PileSolver(const ContactScene& scene, std::span<const BodyState> initial,
             const PileSettings& settings = {});
  ~PileSolver() override;
  PileSolver(PileSolver&&) noexcept;

  /// Until rolling: nothing slides and nobody touches another body, on a still, level substrate
  /// alone, and nobody will; or all is at rest for ever. A run that steps too long has failed.
  SolvedRun run(const RunEnd& end, FrameSink* sink) override;
  std::vector<BodyState> states() const override;
  double now() const override;
  std::vector<std::string> features() const override;
  void exchange(StateArchive& archive) override;

  double step() const;            ///< h [s]
  double collision_time() const;  ///< of hard contacts [s]; 0 where there are none
  EnergyBalance balance() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace slipcheck
