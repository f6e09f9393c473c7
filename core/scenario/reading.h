#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenario/fault.h"
#include "scenario/units.h"
#include "scenario/yaml_tree.h"

namespace slipcheck {

/// A number as it was read.
struct ReadNumber {
  double value = 0;       ///< SI, angles in radians
  const char* unit = "";  ///< of it; "" of a pure number
};
/// Numbers by the path at which they stand; none where nothing was read.
using ReadNumbers = std::map<std::string, std::optional<ReadNumber>, std::less<>>;

/// What is carried along while the rules walk through a file: where they are, and what they found
/// to be wrong so far.
class Reading {
 public:
  Reading(std::string file, UnitSystem units) : file_(std::move(file)), units_(units) {}

  const std::string& file() const { return file_; }
  UnitSystem units() const { return units_; }
  const std::string& path() const { return path_; }  ///< "bodies[1].sphere"
  const std::vector<Fault>& faults() const { return faults_; }
  /// Where each key or item stands.
  std::map<std::string, Location> locations() const;
  bool has(const std::string& path) const { return found_.contains(path); }

  /// Steps down to a key or item for as long as the step lives, and notes what stands there.
  class Step {
   public:
    ~Step() { reading_.path_.resize(length_); }
    Step(const Step&) = delete;
    Step& operator=(const Step&) = delete;

   private:
    friend class Reading;
    Step(Reading& reading, std::string_view name, Location location, const YamlNode& value);
    Reading& reading_;
    std::size_t length_;
  };
  Step key(std::string_view name, Location location, const YamlNode& value) {
    return {*this, name, location, value};
  }
  Step item(std::size_t index, const YamlNode& value) {
    return {*this, '[' + std::to_string(index) + ']', value.location, value};
  }

  /// Notes a fault of the node at the present path.
  void fault(const YamlNode& node, std::string rule);
  /// Notes a fault at any path.
  void fault(Location location, std::string path, std::string rule, std::string value = "");
  /// Notes a fault of what was read at the path, or of what encloses it where nothing was.
  void fault_at(const std::string& path, std::string rule);

  /// Numbers that are read at these paths from now on are noted there; null: none.
  void note_numbers(ReadNumbers* numbers) { numbers_ = numbers; }
  /// Tells of the number at the present path, in SI.
  void note_number(double value, const Dimension& dimension);

  /// Throws BadScenario if anything was found.
  void throw_faults() const;

 private:
  std::string file_;
  UnitSystem units_;
  std::string path_;
  std::vector<Fault> faults_;
  struct Found {
    Location key, value;
    std::string shown;
  };
  std::map<std::string, Found> found_;
  ReadNumbers* numbers_ = nullptr;
};

/// A text as it is shown in a message: at most some 60 characters, control characters escaped.
std::string shown(std::string_view text);

/// A node as it is shown in a message.
std::string shown(const YamlNode& node);

}  // namespace slipcheck
