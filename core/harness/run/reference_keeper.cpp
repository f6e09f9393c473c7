#include "harness/run/reference_keeper.h"

#include <string_view>
#include <utility>

#include "harness/run/cpu_time.h"

namespace slipcheck {

void ObservedRun::exchange(StateArchive& archive) {
  archive(run.end_time, run.reached, run.failed, run.lasting, run.reason, run.events,
          run.collisions, run.collapses, run.contacts, run.steps, run.balance, run.momentum_error);
  bool has_assembly = assembly.has_value();
  archive(seen.bodies, seen.pairs, seen.height, cpu_seconds, has_assembly);
  if (!has_assembly) return;
  if (archive.reads()) assembly.emplace();
  archive(*assembly);
}

ReferenceKeeper::ReferenceKeeper(const Checkpoints& checkpoints)
    : clock_(checkpoints), archive_(std::string_view(checkpoints.state)) {
  if (!checkpoints.state.empty()) archive_(finished_, resumes_, cpu_before_);
}

const ObservedRun* ReferenceKeeper::next() {
  return asked_ < finished_.size() ? &finished_[asked_++] : nullptr;
}

void ReferenceKeeper::begin(std::function<void(StateArchive&)> observers) {
  observers_ = std::move(observers);
  if (resumes_)
    observers_(archive_);
  else
    cpu_before_ = 0;
  cpu_begin_ = thread_cpu_seconds();
}

void ReferenceKeeper::finish(const ObservedRun& run) {
  finished_.push_back(run);
  asked_ = finished_.size();
  resumes_ = false;
  cpu_before_ = 0;
  if (!is_due()) return;
  StateArchive archive;
  bool goes_on = false;
  archive(finished_, goes_on, cpu_before_);
  clock_.write(archive);
}

void ReferenceKeeper::keep(const std::function<void(StateArchive&)>& write_solver) {
  StateArchive archive;
  bool goes_on = true;
  double cpu = cpu_before_ + thread_cpu_seconds() - cpu_begin_;
  archive(finished_, goes_on, cpu);
  observers_(archive);
  write_solver(archive);
  clock_.write(archive);
}

}  // namespace slipcheck
