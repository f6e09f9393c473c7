#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "physics/sphere.h"

namespace slipcheck {

/// Stands for the substrate where a contact names two bodies.
inline constexpr int kSubstrate = -1;
/// Stands for a surface of the scene beside the substrate, and back.
constexpr int surface_touch(std::size_t surface) { return -2 - static_cast<int>(surface); }
constexpr std::size_t touched_surface(int second) { return static_cast<std::size_t>(-2 - second); }
/// Else one of these.
constexpr bool is_body(int second) { return second >= 0; }

/// Two bodies that exchanged a normal impulse since the frame before, or that overlap without one.
struct Touch {
  int first = 0;              ///< body
  int second = kSubstrate;    ///< body, > first, kSubstrate or surface_touch()
  double normal_impulse = 0;  ///< summed over the pair's contact points [N s], >= 0
};

/// The world at one instant: at the end of an engine's step, or inside it where the engine ends
/// steps of its own there, or at an event of the reference.
struct Frame {
  std::vector<BodyState> bodies;
  std::vector<Touch> touches;  ///< since the frame before
  double part = 1;             ///< of an engine's step that has passed, in (0, 1]
  /// Of two bodies since the start, of a solver that counts them.
  std::optional<std::uint64_t> collisions = {};
};

/// A frame of those bodies alone that an event is about to change or has just changed. The others
/// go on as they did.
struct PartialFrame {
  std::span<const std::size_t> bodies;                  ///< each once
  std::span<const BodyState> states;                    ///< of these, in their order
  std::span<const Touch> touches;                       ///< of these, since the frame before
  std::function<BodyState(std::size_t)> state_of = {};  ///< now, of any body
};

/// Takes the frames of a run one after the other.
class FrameSink {
 public:
  virtual ~FrameSink() = default;
  /// `time` [s] never falls; two frames of one time are the state before and after an event.
  virtual void take(double time, const Frame& frame) = 0;
  /// From when on [s] it looks next, at states alone: a solver in steps need not show what comes
  /// before, nor touches. None: it looks at everything.
  virtual std::optional<double> next_look() const { return std::nullopt; }
  /// The same where a solver knows who changes: costs as much as these are, not as all bodies are.
  /// False: all of them are wanted, and the frame comes whole.
  virtual bool take_partial(double /*time*/, const PartialFrame& /*frame*/) { return false; }
};

}  // namespace slipcheck
