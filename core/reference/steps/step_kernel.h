#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/state_archive.h"
#include "physics/frame.h"
#include "reference/steps/step_body.h"
#include "scene/contact_scene.h"

namespace slipcheck {

enum class StepStop {
  never,
  rolling,  ///< no body slides or flies and none touches another
  rest,     ///< nor moves or spins relative to the substrate
};

/// All that the fixed-step solver's loops work on, but for the contacts of bodies.
struct StepWorld {
  std::vector<StepBody> bodies;
  std::vector<StepKind> kinds;  ///< of these
  /// Where many are stored near those that they are near, by their places in the scene's order;
  /// empty: in that order.
  std::vector<std::uint32_t> number;  ///< in the scene's order, of each that is stored
  std::vector<std::uint32_t> place;   ///< where it is stored, of each in the scene's order
  StepSurroundings around;
  const SubstrateMotion* motion = nullptr;
  double step = 0;             ///< h [s]
  std::size_t n = 0;           ///< time is n h
  double slowest_rebound = 0;  ///< of a landing [m/s]
  bool forces_known = false;   ///< those of the time n h
  std::size_t touching = 0;    ///< pairs in contact
  std::size_t collisions = 0;  ///< contacts of two bodies that began

  void exchange(StateArchive& archive) {
    archive(bodies, number, place, around, step, n, slowest_rebound, forces_known, touching,
            collisions);
  }
  std::size_t number_of(std::size_t stored) const {
    return number.empty() ? stored : number[stored];
  }
  std::size_t place_of(std::size_t in_scene) const {
    return place.empty() ? in_scene : place[in_scene];
  }
  double time() const { return static_cast<double>(n) * step; }
  /// From the velocities' time, half a step back, to the next half step.
  double kick_length() const { return n == 0 ? 0.5 * step : step; }
  /// Whether `stop`, not StepStop::never, is met.
  bool is_met(StepStop stop) const;
};

/// The loop over the steps, for one kind of scene.
class StepKernel {
 public:
  virtual ~StepKernel() = default;
  /// The pair forces of now.
  virtual void find_forces(StepWorld& world) = 0;
  /// So many steps, or fewer where `stop` is met first.
  virtual void advance(StepWorld& world, std::size_t steps, StepStop stop) = 0;
  /// Whether `stop`, not StepStop::never, is met now.
  virtual bool is_met(const StepWorld& world, StepStop stop) const = 0;
  /// The world at the time of the positions; touches, where wanted, are those of the step around
  /// it.
  virtual void show(const StepWorld& world, Frame& frame, bool with_touches) = 0;
  /// What the loop was made for, in a few words each: "linear normal force", ...
  virtual std::vector<std::string> features() const = 0;
  /// The world, but for what the scene says of it, and what the loop goes on with.
  virtual void exchange(StateArchive& archive, StepWorld& world) = 0;
};

struct StepSettings;

/// The loop that leaves out what the scene lacks; StepSettings::general: the one that has
/// everything. Throws Unsupported where bodies could meet whose contact is hard.
std::unique_ptr<StepKernel> make_step_kernel(const ContactScene& scene,
                                             std::span<const BodyState> initial,
                                             const StepSettings& settings);

}  // namespace slipcheck
