#pragma once

#include <map>
#include <utility>
#include <vector>

#include "peer_backends/shared/contact_values.h"

namespace slipcheck::peer {

/// Normal impulses since clear(), summed over the contact points of each two that touch. Those of a
/// box's walls and lid are nobody's business; where there is no box, their numbers are surfaces'.
class TouchList {
 public:
  explicit TouchList(bool in_box = true) : in_box_(in_box) {}

  void clear() { impulses_.clear(); }

  /// Between two bodies, or a body and a surface, in any order; `impulse` [N s].
  void add(int first, int second, double impulse) {
    if (first < 0 || (second >= 0 && second < first)) std::swap(first, second);
    if (in_box_ && (second == kWall || second == kLid)) return;
    if (!(impulse > 0)) return;
    impulses_[{first, second}] += impulse;
  }

  void write(std::vector<Touch>& touches) const {
    touches.clear();
    for (const auto& [pair, impulse] : impulses_)
      touches.push_back({pair.first, pair.second, impulse});
  }

 private:
  bool in_box_;
  std::map<std::pair<int, int>, double> impulses_;
};

}  // namespace slipcheck::peer
