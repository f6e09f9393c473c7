#include "harness/observe/observer.h"
#include "reference/kept_solver.h"

namespace slipcheck {

void Observer::exchange(StateArchive& archive) {
  archive(started_, time_, time_before_, end_, end_time_before_, end_time_after_, end_is_kept_,
          ground0_, ground1_, bodies_, pairs_, touching_, settling_);
  for (Frame* frame : {&last_, &before_last_, &end_before_, &end_after_, &now_})
    exchange_frame(archive, *frame);
  if (!archive.reads()) return;
  pair_numbers_.clear();
  for (std::size_t k = 0; k < pairs_.size(); ++k)
    pair_numbers_.emplace(pair_key(pairs_[k].first, pairs_[k].second), k);
}

}  // namespace slipcheck
