#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "scenario/scenario.h"

namespace slipcheck {

/// One thing that is wrong with a file, said as `file:line:column: key: rule, got value`.
struct Fault {
  std::string file;
  Location location;
  std::string key;    ///< path of the key, as in "bodies[1].sphere.radius"; may be empty
  std::string rule;   ///< "must be > 0 m"
  std::string value;  ///< as it stands in the file; empty where nothing is there

  std::string message() const;
};

/// A file that cannot be used, with all its faults.
class BadScenario : public std::runtime_error {
 public:
  explicit BadScenario(std::vector<Fault> faults);
  const std::vector<Fault>& faults() const { return faults_; }

 private:
  std::vector<Fault> faults_;
};

}  // namespace slipcheck
