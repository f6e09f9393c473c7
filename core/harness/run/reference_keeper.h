#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/observe/assembly_observer.h"
#include "harness/observe/observables.h"
#include "harness/run/checkpoints.h"
#include "reference/kept_solver.h"

namespace slipcheck {

/// One of the runs that a reference is made of.
struct ObservedRun {
  SolvedRun run;
  Observables seen;
  double cpu_seconds = 0;                 ///< of all processes that had a part in it
  std::optional<Assembly> assembly = {};  ///< where that was asked for

  void exchange(StateArchive& archive);
};

/// Keeps the runs of one scene's reference: those that have finished, and of the present one its
/// solver and its observers.
class ReferenceKeeper final : public RunKeeper {
 public:
  /// `checkpoints` must outlive it. Throws BadState where their state is none.
  explicit ReferenceKeeper(const Checkpoints& checkpoints);

  /// The next run, where it has finished in a process before; else null.
  const ObservedRun* next();
  /// It begins, or goes on from what was kept. observers: writes or reads what they go on with.
  void begin(std::function<void(StateArchive&)> observers);
  void finish(const ObservedRun& run);
  /// CPU time that the present run took in processes before [s].
  double cpu_before() const { return cpu_before_; }
  /// Why a state could not be written the last time that was tried; else empty.
  const std::string& trouble() const { return clock_.trouble(); }

  StateArchive* resumed() override { return resumes_ ? &archive_ : nullptr; }
  bool is_due() override { return clock_.is_due(); }
  void keep(const std::function<void(StateArchive&)>& write) override;

 private:
  CheckpointClock clock_;
  StateArchive archive_;
  bool resumes_ = false;  ///< the next run that begins is in the archive
  std::vector<ObservedRun> finished_;
  std::size_t asked_ = 0;  ///< of the finished ones
  std::function<void(StateArchive&)> observers_;
  double cpu_before_ = 0, cpu_begin_ = 0;
};

}  // namespace slipcheck
