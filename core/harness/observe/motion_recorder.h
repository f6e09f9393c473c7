#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "harness/observe/motion.h"
#include "harness/observe/phase_watch.h"
#include "scene/scene.h"

namespace slipcheck {

/// Of scenes with more bodies no motion is recorded: nobody could follow it.
inline constexpr std::size_t kMostRecordedBodies = 200;

/// How many frames of an engine's run are kept at most: 64, of more than 46 bodies fewer.
std::size_t most_frames(std::size_t bodies);

/// A run's frames, thinned out while it goes on: ever fewer of those at equal numbers of steps, and
/// beside them the frames before and after a touch of two bodies or a landing begins, until these
/// are too many. The first and the last frame are always there. Touches in frames that are left out
/// count to the next one.
class MotionThinning {
 public:
  /// `scene` must outlive this. most: frames, >= 8.
  MotionThinning(const Scene& scene, std::size_t most) : scene_(&scene), most_(most) {}

  /// `time` [s] rises. Frames whose states are not all finite are passed over.
  void take(double time, std::span<const BodyState> bodies, std::span<const Touch> touches);
  /// What was kept. Nothing is left.
  std::vector<MotionFrame> finish();

 private:
  struct Kept {
    MotionFrame frame;
    std::size_t number;     ///< in the run
    std::size_t collision;  ///< that it shows, from 1; 0: none
  };

  bool begins_collision(const std::vector<std::pair<int, int>>& touches) const;
  bool shows(std::size_t collision) const;
  void keep_last(std::size_t collision);
  void thin();

  const Scene* scene_;
  std::size_t most_;
  std::vector<Kept> kept_;
  MotionFrame last_;  ///< with its own touches alone
  std::size_t last_number_ = 0;
  bool last_is_kept_ = false;
  std::vector<std::pair<int, int>> passed_;  ///< touches since the last frame that was kept
  std::size_t count_ = 0, collisions_ = 0;
  std::size_t stride_ = 1, collision_stride_ = 1;
};

/// Keeps every run of an engine's ensemble until it is known which are worth looking at.
class MotionRecorder final : public PhaseWatch {
 public:
  /// `scene` must outlive this.
  explicit MotionRecorder(const Scene& scene) : scene_(&scene) {}

  void begin(double time, std::span<const BodyState> states) override;
  void take(double time, const Frame& frame) override;

  /// The phases in the middle, worst and nearest to the reference by these errors (phase_errors()),
  /// each phase once, under the first of these roles; the first phase as "median" where no phase
  /// has an error. Nothing is left.
  std::vector<RecordedMotion> picked(const std::vector<double>& errors);
  /// As far as the last phase came, as "worst": of an ensemble that did not come to its end.
  /// Nothing is left.
  std::vector<RecordedMotion> last_seen();

 private:
  const Scene* scene_;
  std::vector<MotionThinning> phases_;
};

}  // namespace slipcheck
