#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "studies/baseline/baseline.h"

namespace slipcheck {

/// Where a move leads, as seen from the reference.
enum class Direction { moved, better, worse };
template <>
inline constexpr std::array kNamesOf<Direction> = {"moved", "better", "worse"};

/// Something that is not as in the baseline.
struct Change {
  /// median, min, max and missing (phases) are of an engine's ensemble, the other words of the
  /// whole run, reference or scene.
  enum class Statistic {
    value,
    median,
    min,
    max,
    missing,
    status,
    verdict,
    solver,
    file,
    presence
  };

  std::string scene;
  std::string part;        ///< "reference", a run's label, or "scene"
  std::string observable;  ///< full name; empty where the part as a whole has changed
  Statistic statistic = Statistic::value;
  double before = std::numeric_limits<double>::quiet_NaN();  ///< [SI]; NaN: it was not there
  double after = std::numeric_limits<double>::quiet_NaN();
  /// In words, "ok" and "unstable", where it is no number; else empty.
  std::string was, is;
  /// How far it may move [SI], >= 0; NaN where it may not change at all.
  double allowed = std::numeric_limits<double>::quiet_NaN();
  Direction direction = Direction::moved;
  bool gates = true;  ///< turns the check red; else it is only told
  std::string note;   ///< why a run failed, what to do; may be empty
};

template <>
inline constexpr std::array kNamesOf<Change::Statistic> = {
    "value", "median", "min", "max", "missing", "status", "verdict", "solver", "file", "presence"};

/// A part of a scene that was held against the baseline.
struct CheckedPart {
  std::string label;       ///< as Change::part
  double cpu_seconds = 0;  ///< [s]
  std::string skipped;     ///< why it did not run, now as then; else empty
};

struct SceneCheck {
  std::string scene;
  std::vector<CheckedPart> parts;  ///< the reference, then runs in the order of the scene
  std::vector<Change> changes;     ///< in the order of parts, then by name
  std::size_t compared = 0;        ///< values
  std::size_t drifted = 0;         ///< of these, not the same to the last bit but where they may be
  /// Of the reference's values, those that may move by their uncertainty, which is more than 1e-9.
  std::size_t uncertain = 0;
  std::vector<std::string> versions;  ///< "bullet 3.24, now 3.25" where it is another
  bool failed = false;                ///< an engine is unstable, crashed or timed out that was not
  /// CPU time now over that of the baseline; NaN where there is none.
  double reference_time_ratio = std::numeric_limits<double>::quiet_NaN();
  double engine_time_ratio = std::numeric_limits<double>::quiet_NaN();

  bool is_green() const;  ///< no change gates
};

/// Holds a scene just run with ensembles of the baseline's size against its baseline.
///
/// The reference may move by 1e-9 of its value (of vectors' length; by 1e-9 where there is no
/// unit), or by the sum of both uncertainties if that is more; one that is not finite lets it move
/// and vanish. Median, min and max of an engine's
/// observable may move by its tolerance; in a box by the reference's uncertainties on top. What is
/// expected of a run without a tolerance may move by half the range in which it is expected, and
/// the verdict on such a run may not change; on others a change of verdict is only told.
SceneCheck check_scene(const SceneBaseline& baseline, const SceneRecord& scene);

/// Scenes held against their baselines.
struct CheckReport {
  std::string baselines;   ///< folder, as the user named it
  std::size_t phases = 0;  ///< of each ensemble
  std::vector<SceneCheck> scenes;
  std::string advice = {};  ///< how to make baselines where there are none; else empty
};

/// A scene that has no baseline.
SceneCheck scene_without_baseline(const std::string& scene);
/// A baseline, in this file, whose scene is not there.
SceneCheck baseline_without_scene(const std::string& scene, const std::string& file);

/// All scenes against the baselines, by scene, of a folder. Of those of another size than `phases`
/// no number would compare: their scenes count as without.
CheckReport check_scenes(const std::string& folder, std::size_t phases,
                         const std::map<std::string, SceneBaseline>& baselines,
                         const std::vector<SceneRecord>& scenes);

}  // namespace slipcheck
