#pragma once

#include <vector>

namespace slipcheck::test {

/// Of cases that differ in their numbers alone all; under sanitizers, which look at the code and
/// not at what comes out, the first.
template <class Case>
std::vector<Case> in_part(std::vector<Case> cases) {
#ifdef SLIPCHECK_SANITIZE
  cases.resize(1);
#endif
  return cases;
}

}  // namespace slipcheck::test
