#pragma once

#include <string>
#include <vector>

#include "scenario/fault.h"

namespace slipcheck::test {

/// What the exception says that call() throws; empty where it throws none.
template <class Exception, class Call>
std::string refusal_of(const Call& call) {
  try {
    call();
  } catch (const Exception& refusal) {
    return refusal.what();
  }
  return "";
}

/// The faults in what call() reads; none where it takes it.
template <class Call>
std::vector<Fault> faults_of(const Call& call) {
  try {
    call();
  } catch (const BadScenario& bad) {
    return bad.faults();
  }
  return {};
}

}  // namespace slipcheck::test
