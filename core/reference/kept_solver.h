#pragma once

#include <functional>

#include "base/state_archive.h"
#include "physics/frame.h"
#include "reference/solver.h"

namespace slipcheck {

/// One whose run another process can go on with: the same bits come out.
class KeptSolver : public Solver {
 public:
  /// Called between two frames of a run.
  void set_between_frames(std::function<void()> look) { between_frames_ = std::move(look); }
  /// Writes what a run goes on with; or reads it into a solver of the same scene and settings that
  /// has not run: run() then goes on behind the frame that was the last one shown.
  virtual void exchange(StateArchive& archive) = 0;

 protected:
  void look_between_frames() const {
    if (between_frames_) between_frames_();
  }

 private:
  std::function<void()> between_frames_;
};

/// What goes on beside a run and is kept with it.
class RunKeeper {
 public:
  virtual ~RunKeeper() = default;
  /// Where a run goes on: what its solver is read from. Null at a start.
  virtual StateArchive* resumed() = 0;
  /// Time to keep the state.
  virtual bool is_due() = 0;
  /// `write`: adds what the solver goes on with.
  virtual void keep(const std::function<void(StateArchive&)>& write) = 0;
};

inline void exchange_frame(StateArchive& archive, Frame& frame) {
  archive(frame.bodies, frame.touches, frame.part, frame.collisions);
}

}  // namespace slipcheck
