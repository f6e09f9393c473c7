#pragma once

#include <string>

#include "scenario/fault.h"
#include "scenario/scenario.h"

namespace slipcheck {

/// What is said of the key at this path of a scenario, with its place in the file, or that of what
/// encloses it.
Fault fault_of(const Scenario& scenario, const std::string& path, const std::string& rule,
               const std::string& value = "");

/// Collects what cannot be solved, one line for each.
class Obstacles {
 public:
  explicit Obstacles(const Scenario& scenario) : scenario_(scenario) {}

  void add(const std::string& path, const std::string& rule, const std::string& value);
  /// Throws Unsupported if anything was added.
  void throw_any() const;

 private:
  const Scenario& scenario_;
  std::string text_;
};

}  // namespace slipcheck
