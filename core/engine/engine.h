#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "physics/frame.h"
#include "scenario/hard_scene.h"

namespace slipcheck {

/// A setting as the engine applied it.
using Setting = std::variant<bool, double, std::string>;

/// What an engine made of a scene.
struct Applied {
  std::map<std::string, Setting> settings;   ///< by name; SI
  std::vector<std::string> not_represented;  ///< what of the scene the engine cannot express
};

/// What an engine is.
struct EngineInfo {
  std::string engine;                 ///< "bullet"
  std::string version;                ///< "3.24"
  std::string precision;              ///< "single" or "double"
  std::vector<std::string> profiles;  ///< known by name
};

/// The engine cannot run this scene or profile; the message is the reason.
class Refused : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What an engine's adapter implements; it runs in a worker process of its own (worker.h).
/// It only steps and reports states: observables are computed elsewhere, by one function for all.
class Engine {
 public:
  virtual ~Engine() = default;

  virtual EngineInfo info() const = 0;

  /// Prepares for a scene under a named profile with steps of `time_step` [s], > 0. May be called
  /// again for another scene. Throws Refused.
  virtual Applied configure(const HardScene& scene, const std::string& profile,
                            double time_step) = 0;

  /// A fresh world, nothing left of an earlier one, with the bodies in these states at `time` [s],
  /// >= 0, of the scene's clock, by which the substrate or the box moves.
  virtual void start(std::span<const BodyState> states, double time) = 0;

  /// One step of the configured length, and nothing else: its CPU time is measured.
  virtual void step() = 0;

  /// The state after the last step, into `frame` (its storage is reused).
  virtual void read(Frame& frame) const = 0;
};

}  // namespace slipcheck
