#pragma once

#include <hwy/targets.h>

#include <cstdint>
#include <vector>

namespace slipcheck::test {

/// As long as it lives, loops that are compiled once for each instruction set use this one.
class InstructionSet {
 public:
  explicit InstructionSet(std::int64_t target) { set(target); }
  ~InstructionSet() { set(0); }
  InstructionSet(const InstructionSet&) = delete;
  InstructionSet& operator=(const InstructionSet&) = delete;

  /// Those of this machine, and none.
  static std::vector<std::int64_t> all() {
    std::vector<std::int64_t> targets;
    for (std::int64_t left = hwy::SupportedTargets() | HWY_SCALAR; left != 0; left &= left - 1)
      targets.push_back(left & -left);
    return targets;
  }

 private:
  static void set(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
};

}  // namespace slipcheck::test
