#pragma once

#include <string>
#include <vector>

#include "harness/compare/record.h"

namespace slipcheck {

/// One test of a JUnit report.
struct TestOutcome {
  enum class Kind { passed, failed, undecided, error, skipped };

  std::string suite;  ///< scene
  std::string name;   ///< run: "bullet double default 240 Hz", or "reference"
  Kind kind = Kind::passed;
  double seconds = 0;   ///< CPU time [s], >= 0
  std::string message;  ///< one line that says it all; empty where passed
  std::string text;     ///< everything, in lines
};

/// A JUnit XML file, as GitHub, GitLab and Jenkins read it: a test suite for each scene, in the
/// order in which they first come. `name` is that of all of them.
std::string junit_xml(const std::vector<TestOutcome>& outcomes,
                      const std::string& name = "slipcheck");

/// Scenes in engines as tests: one for each run, and one for a reference without engines. A
/// deviation is a failure whose message names the worst observable with reference, median and
/// range, error and tolerance; a crash, a time-out, an instability is an error. What is undecided
/// is a failure of the type "undecided", or skipped where that is allowed.
std::vector<TestOutcome> test_outcomes(const std::vector<SceneRecord>& scenes,
                                       bool allow_undecided = false);

}  // namespace slipcheck
