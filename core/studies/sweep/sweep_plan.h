#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/engine.h"
#include "scenario/reading.h"
#include "scenario/scenario.h"
#include "studies/sweep/scene_path.h"
#include "studies/sweep/sweep_block.h"

namespace slipcheck {

/// How an engine is run: what of a run is no part of the scene.
struct SweepChoice {
  std::string engine;     ///< empty: the reference alone
  std::string version;    ///< of those installed side by side; empty: what `engine` says
  std::string precision;  ///< "single", "double"; empty: that which is installed
  std::string profile = "default";
  double rate = 0;          ///< [Hz], > 0
  double scale = 1;         ///< as of EngineRecord
  std::size_t phases = 32;  ///< >= 1
  Settings settings;        ///< over those of the profile

  /// "rapier@0.19.3".
  std::string engine_name() const;
  bool operator==(const SweepChoice&) const = default;
};

/// Something that varies.
struct SweepParameter {
  enum class Kind { scene, engine, version, precision, profile, rate, scale, phases, setting };
  std::string name;  ///< in dots
  Kind kind = Kind::scene;
  Location location;
  ScenePath path;       ///< of a scene's
  std::string setting;  ///< of an engine's
};

/// A sweep as its file says it: a scene, and what varies. Runs are numbered from 0, the scene's
/// parameters vary slowest, and each is made from its number alone.
class SweepPlan {
 public:
  /// Throws BadScenario with every fault of the file, of each value by itself, and of kMostTried
  /// combinations.
  static SweepPlan load(const std::filesystem::path& file);
  /// The same for a text in memory; `file` only names it in messages.
  static SweepPlan parse(std::string_view text, const std::string& file);

  const std::string& file() const { return file_; }
  const std::string& text() const { return text_; }
  const std::string& name() const { return name_; }  ///< the scene's
  std::uint64_t runs() const { return runs_; }       ///< in [1, kMostSweepRuns]
  std::uint64_t scenes() const { return scenes_; }   ///< distinct ones
  bool is_reference_alone() const { return reference_alone_; }

  /// What varies in the order of the file, grids before lists.
  const std::vector<SweepParameter>& parameters() const { return parameters_; }
  const std::vector<SweepPart>& parts() const { return parts_; }
  /// Every choice of engine, version, precision and profile, each once; other fields are those of
  /// one run that has it.
  std::vector<SweepChoice> engine_choices() const;

  SweepChoice choice(std::uint64_t run) const;
  /// The same for all runs with the same scene, and for no others; in [0, runs()).
  std::uint64_t scene_id(std::uint64_t run) const;
  /// The run's value of a parameter, as it could stand in the file.
  YamlPointer value(std::uint64_t run, std::size_t parameter) const;
  /// The run's scene without engines. `numbers` gets those of scene parameters, by their paths.
  /// Throws BadScenario.
  Scenario scene(std::uint64_t run, ReadNumbers* numbers = nullptr) const;
  /// The same with the engines that the file's own `compare` asks for.
  Scenario whole_scene(std::uint64_t run) const;

  /// SHA-256 of what the file says, in hex, whatever its layout, title and source.
  std::string digest() const;

  static constexpr std::size_t kMostTried = 1000;

 private:
  std::vector<std::size_t> rows_of(std::uint64_t run) const;
  std::uint64_t runs_of_scene_rows() const;
  std::set<std::uint64_t> tried_runs() const;
  YamlPointer tree_of(std::uint64_t run, YamlPointer tree) const;
  void add_requests(const Scenario& scenario);
  void sort_parts();
  void check(Reading& reading) const;

  std::string file_, text_, name_;
  YamlPointer tree_, whole_;  ///< the scene's, without `sweep`
  UnitSystem units_ = UnitSystem::si;
  std::vector<SweepParameter> parameters_;
  std::vector<SweepPart> parts_;                             ///< those of scenes first
  std::vector<std::vector<std::size_t>> part_names_;         ///< the parameters of each part
  std::vector<std::vector<std::uint64_t>> scene_keys_;       ///< of each part's rows; of none empty
  std::vector<std::pair<std::size_t, std::size_t>> places_;  ///< of parameters: part, name
  /// What compare.engines asks for where the sweep names no engine; the slowest but the scene.
  std::vector<SweepChoice> requests_ = {{}};
  std::uint64_t runs_ = 1, scenes_ = 1;
  bool reference_alone_ = false;
};

}  // namespace slipcheck
