#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "harness/compare/record.h"
#include "report/rows/text_table.h"

namespace slipcheck {

/// An engine in one version and precision, under one profile, at one rate.
struct EngineMethod {
  std::string engine, version, precision, profile;
  double rate = 0;  ///< [Hz]

  auto operator<=>(const EngineMethod&) const = default;
  /// "rapier 0.21.0 default 240 Hz"; with the precision where the engine comes in both.
  std::string label(bool with_precision) const;
};

/// How a method comes out of a scene: nothing where it was not asked for.
struct MatrixCell {
  const EngineRecord* run = nullptr;
  /// The worst phase's largest error [tolerances]; NaN where nothing is judged, infinite where the
  /// run failed or does not show what the reference shows.
  double error = std::numeric_limits<double>::quiet_NaN();
};

/// The worst phase's largest error of a run [tolerances], as in MatrixCell.
double worst_phase(const EngineRecord& run);

/// Scenes by methods. Runs of which something is expected are left out: they show a trait of one
/// engine, and so are methods that fewer than half as many scenes ask for as the commonest.
struct EngineMatrix {
  struct Row {
    const SceneRecord* scene = nullptr;
    std::size_t place = 0;          ///< of the scene in what was given
    std::vector<MatrixCell> cells;  ///< one for each method
  };
  std::vector<EngineMethod> methods;
  std::vector<Row> rows;

  /// Whether any engine comes in both precisions.
  bool has_both_precisions() const;
};

/// Which methods a matrix has: those that enough scenes ask for, to be held beside each other, or
/// all of them.
enum class MatrixExtent { common, all };

/// The common one is empty where there are not two scenes and two methods. The scenes must outlive
/// it.
EngineMatrix engine_matrix(const std::vector<SceneRecord>& scenes,
                           MatrixExtent extent = MatrixExtent::common);

/// A cell as people see it: "0.5", "✗" of a run that failed, "–" of one that cannot run the scene.
Cell matrix_cell(const MatrixCell& cell);

/// A method over all its scenes.
struct MethodScore {
  std::size_t within = 0, deviates = 0, undecided = 0, failed = 0, skipped = 0;
  double median_error =
      std::numeric_limits<double>::quiet_NaN();  ///< of the worst phases [tolerances]
  /// CPU time of the stepping for one simulated second, geometric mean over scenes [-].
  double cost = std::numeric_limits<double>::quiet_NaN();
};
std::vector<MethodScore> scores_of(const EngineMatrix& matrix);

/// A row for each scene, a column for each method: the worst phase's error in tolerances, "✗" of a
/// run that failed, "–" of one that cannot run the scene. `anchor` makes the link of a scene from
/// its place, as in "#scene-3"; none where it is empty.
TextTable matrix_table(const EngineMatrix& matrix, const std::string& anchor = {});
/// A row for each method, the best first: those with the most scenes within, then the smaller
/// error.
TextTable score_table(const EngineMatrix& matrix);

/// What the matrix comes to, in sentences.
std::vector<std::string> matrix_findings(const EngineMatrix& matrix);

}  // namespace slipcheck
