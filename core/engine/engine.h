#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "engine/engine_scene.h"
#include "physics/frame.h"

namespace slipcheck {

/// A setting's value: a flag, a number or a word.
using Setting = std::variant<bool, double, std::string>;

/// Settings by name.
using Settings = std::map<std::string, Setting>;

/// A setting that an engine takes: what a profile may choose, and what tuning may try.
struct SettingInfo {
  std::string name;   ///< words of small letters and digits, joined by '_'
  std::string about;  ///< one line
  std::string unit;   ///< of a number, "m/s"; empty where it has none
  Setting shipped;    ///< the engine's own value; it tells the type too
  double low = -std::numeric_limits<double>::infinity();  ///< a number's limits, inclusive
  double high = std::numeric_limits<double>::infinity();
  bool whole = false;                ///< a number without fraction
  std::vector<std::string> choices;  ///< the words that there are

  /// Values worth trying one by one, in any order; none where tuning leaves the setting alone.
  std::vector<Setting> candidates;
  /// A range worth searching in; of logarithms where both ends are > 0 and `logarithmic` is set.
  struct Range {
    double low = 0, high = 0;
    bool logarithmic = false;
  };
  std::optional<Range> range;
};

/// What of a scene an engine cannot express.
struct Lack {
  std::string text;       ///< for people: "restitution below 0.2 m/s of approach"
  std::string kind = {};  ///< the same for all scenes and settings; empty where the engine has none
};

/// What an engine made of a scene.
struct Applied {
  Settings settings;  ///< SI
  std::vector<Lack> not_represented;
  std::vector<std::string> left_out;  ///< work that the scene does not need, each with the reason
};

/// What an engine is.
struct EngineInfo {
  std::string engine;                 ///< "bullet"
  std::string version;                ///< "3.24"
  std::string precision;              ///< "single" or "double"
  std::vector<SettingInfo> settings;  ///< in an order that puts what belongs together side by side
  /// What it takes beside spheres and contacts whose friction is a number: words of `scene_part`
  /// (scene_needs.h).
  std::vector<std::string> takes = {};
};

/// The engine cannot run this scene with these settings; the message is the reason.
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

  /// Prepares for a scene with steps of `time_step` [s], > 0. Settings that are not named have the
  /// engine's own values; those that are have been checked against info(). May be called again for
  /// another scene. Throws Refused.
  virtual Applied configure(const EngineScene& scene, const Settings& settings,
                            double time_step) = 0;

  /// A fresh world, nothing left of an earlier one, with the bodies in these states at `time` [s],
  /// >= 0, of the scene's clock, by which the substrate or the box moves.
  virtual void start(std::span<const BodyState> states, double time) = 0;

  /// One step of the configured length, and nothing else: its CPU time is measured.
  virtual void step() = 0;

  /// The state after the last step, into `frame` (its storage is reused).
  virtual void read(Frame& frame) const = 0;

  /// The bodies of that frame alone, for steps that are skipped: what read() tells beside them may
  /// cost more than the steps. What they touched is not asked for afterwards.
  virtual void read_states(std::vector<BodyState>& states) const;

  /// The instants inside the last step at which the engine ended steps of its own, in order, each
  /// with its `part` < 1. None unless overridden.
  virtual std::span<const Frame> parts() const { return {}; }

  /// CPU time [s] that this engine has used so far, >= 0 and never falling: of the difference over
  /// some steps the harness hears. That of the whole process, in case the engine has threads of its
  /// own, unless overridden by an engine whose work is done in processes beside it.
  virtual double cpu_seconds() const;

  /// The worker's process is about to end, and nothing of it is taken apart: ends what would
  /// outlast it, as other processes and their files, within half a second.
  virtual void finish() {}
};

}  // namespace slipcheck
