#include "studies/sweep/sweep_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "harness/run/engine_grid.h"
#include "scenario/content_digest.h"
#include "scenario/fault.h"
#include "scenario/file_text.h"
#include "scenario/load.h"
#include "scenario/rules/scene_rules.h"
#include "studies/sweep/sweep_choice.h"

namespace slipcheck {
namespace {

using Kind = SweepParameter::Kind;

/// Keys of a scene that no sweep varies.
constexpr std::array<const char*, 6> kFixedKeys = {"slipcheck", "name",  "title",
                                                   "source",    "units", "sweep"};

/// Both places are one, or one of them is around the other.
bool overlap(const ScenePath& one, const ScenePath& other) {
  const std::string a = dotted(one.text()) + '.', b = dotted(other.text()) + '.';
  return a.starts_with(b) || b.starts_with(a);
}

void check_scene_parameter(const SweepParameter& parameter, Reading& reading) {
  const std::string& key = parameter.path.steps.front().key;
  if (std::ranges::count(kFixedKeys, key) > 0)
    reading.fault(parameter.location, "sweep." + parameter.name,
                  fmt::format("must not be {}, which is the same in all runs", key));
  if (parameter.name == "run")  // which is the number of a run in the store
    reading.fault(parameter.location, "sweep.run", "must be a key below run, as in run.limit");
  if (parameter.path.text().starts_with("compare.engines") ||
      parameter.path.text().starts_with("compare.scales"))
    reading.fault(parameter.location, "sweep." + parameter.name,
                  "must be engine, version, precision, profile, rate, scale, phases or "
                  "settings.NAME, which stand for compare's own");
}

/// Columns of a store are told apart by more than case.
std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// Notes what is wrong with the names that vary; each once.
void check_names(const std::vector<SweepParameter>& parameters, Reading& reading) {
  for (std::size_t k = 0; k < parameters.size(); ++k)
    for (std::size_t j = 0; j < k; ++j) {
      const SweepParameter &one = parameters[j], &other = parameters[k];
      const bool both_scene = one.kind == Kind::scene && other.kind == Kind::scene;
      if (lower_case(one.name) == lower_case(other.name) ||
          (both_scene && overlap(one.path, other.path)))
        reading.fault(
            other.location, "sweep." + other.name,
            fmt::format("must vary once, and {} does at line {}", one.name, one.location.line));
    }
}

/// The UnitSystem that the file says.
UnitSystem units_in(const YamlNode& root, const std::string& file) {
  UnitSystem units = UnitSystem::si;
  Reading ignored(file, units);
  if (const YamlNode* node = root.find("units")) units_rule().read(*node, ignored, units);
  return units;
}

/// The scene's tree with `compare.engines: []`.
YamlPointer without_engines(const YamlPointer& root) {
  const YamlNode* compare = root->find("compare");
  if (compare == nullptr || compare->kind != YamlNode::Kind::mapping ||
      compare->find("engines") == nullptr)
    return root;
  auto none = std::make_shared<YamlNode>();
  none->kind = YamlNode::Kind::list;
  none->location = compare->find("engines")->location;
  return with_value(root, scene_path(*root, "compare.engines"), none, none->location);
}

/// Fails where the product is beyond what a sweep may have.
std::uint64_t product(const std::vector<SweepPart>& parts, std::uint64_t first,
                      const YamlNode& block, Reading& reading) {
  double product = static_cast<double>(first);
  for (const SweepPart& part : parts) product *= static_cast<double>(part.count);
  if (product > static_cast<double>(kMostSweepRuns)) {
    reading.fault(block.location, "sweep",
                  fmt::format("must come to at most {} runs", kMostSweepRuns),
                  fmt::format("{:g}", product));
    return 1;
  }
  return static_cast<std::uint64_t>(product);
}

}  // namespace

SweepPlan SweepPlan::load(const std::filesystem::path& file) {
  return parse(read_file(file), file.string());
}

SweepPlan SweepPlan::parse(std::string_view text, const std::string& file) {
  const YamlPointer root = parse_yaml(checked_text(text, file), file);
  SweepPlan plan;
  plan.file_ = file;
  plan.text_ = text;
  plan.units_ = units_in(*root, file);
  Reading reading(file, plan.units_);
  const YamlNode* written = root->find("sweep");
  if (written == nullptr) {
    reading.fault({1, 1}, "sweep", "must be there, with what varies (slipcheck run runs a scene)");
    reading.throw_faults();
  }
  SweepBlock block;
  {
    const auto step = reading.key("sweep", written->location, *written);
    sweep_rule().read(*written, reading, block);
  }
  reading.throw_faults();
  plan.parts_ = std::move(block.parts);
  plan.whole_ = without_key(root, "sweep");
  plan.tree_ = without_engines(plan.whole_);
  plan.sort_parts();
  for (SweepParameter& parameter : plan.parameters_) {
    if (parameter.kind != Kind::scene) continue;
    try {
      parameter.path = scene_path(*plan.whole_, parameter.name);
      check_scene_parameter(parameter, reading);
    } catch (const BadPath& bad) {
      reading.fault(parameter.location, "sweep." + parameter.name, bad.what());
    }
  }
  reading.throw_faults();
  check_names(plan.parameters_, reading);
  plan.runs_ = product(plan.parts_, 1, *written, reading);
  reading.throw_faults();

  const Scenario first = plan.whole_scene(0);
  plan.name_ = first.name;
  plan.add_requests(first);
  plan.runs_ = product(plan.parts_, plan.requests_.size(), *written, reading);
  plan.check(reading);
  reading.throw_faults();
  return plan;
}

/// Parts of the scene go first, and vary slowest: a reference then serves runs that follow each
/// other. Rows with the same scene stand together.
void SweepPlan::sort_parts() {
  const auto varies_scene = [](const SweepPart& part) {
    return std::ranges::any_of(part.names, [](const SweepName& name) {
      return named_parameter(name).kind == Kind::scene;
    });
  };
  std::ranges::stable_partition(parts_, varies_scene);
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    SweepPart& part = parts_[p];
    std::vector<std::size_t>& names = part_names_.emplace_back();
    for (std::size_t k = 0; k < part.names.size(); ++k) {
      names.push_back(parameters_.size());
      places_.emplace_back(p, k);
      parameters_.push_back(named_parameter(part.names[k]));
    }
    std::vector<std::uint64_t>& keys = scene_keys_.emplace_back();
    if (!varies_scene(part)) continue;
    std::map<std::string, std::uint64_t> known;
    keys.resize(part.count);
    const bool is_mixed = std::ranges::any_of(
        names, [&](std::size_t k) { return parameters_[k].kind != Kind::scene; });
    if (!is_mixed || part.rows.empty()) {
      std::iota(keys.begin(), keys.end(), std::uint64_t{0});
    } else {
      for (std::size_t row = 0; row < part.count; ++row) {
        std::string content;
        for (std::size_t k = 0; k < names.size(); ++k)
          if (parameters_[names[k]].kind == Kind::scene)
            content += content_text(*part.rows[row][k]) + '\n';
        keys[row] = known.try_emplace(content, known.size()).first->second;
      }
      std::vector<std::size_t> order(part.count);
      std::iota(order.begin(), order.end(), std::size_t{0});
      std::ranges::stable_sort(order, {}, [&](std::size_t row) { return keys[row]; });
      std::vector<std::vector<YamlPointer>> rows;
      for (const std::size_t row : order) rows.push_back(std::move(part.rows[row]));
      part.rows = std::move(rows);
      std::ranges::sort(keys);
    }
    scenes_ *= keys.back() + 1;
  }
}

/// Where the sweep names no engine, those that the scene asks for, without what the sweep varies of
/// them: each once.
void SweepPlan::add_requests(const Scenario& scenario) {
  std::set<Kind> varied;
  for (const SweepParameter& parameter : parameters_) varied.insert(parameter.kind);
  const auto location_of_first = [&] { return parameters_.front().location; };
  Reading reading(file_, units_);
  if (varied.contains(Kind::engine)) {
    requests_ = {SweepChoice{}};
    if (!varied.contains(Kind::rate))
      reading.fault(location_of_first(), "sweep",
                    "must give a rate where it gives engines: rate: 240 in grid");
    reading.throw_faults();
    return;
  }
  requests_.clear();
  for (const EngineRequest& request : requests_of(scenario)) {
    SweepChoice choice;
    choice.engine = request.engine;
    if (request.precision && !varied.contains(Kind::precision))
      choice.precision =
          *request.precision == EngineRequest::Precision::single_ ? "single" : "double";
    if (!varied.contains(Kind::profile)) choice.profile = request.profile;
    for (const double rate : request.rates)
      for (const double scale : scenario.compare.scales) {
        choice.rate = varied.contains(Kind::rate) ? 0 : rate;
        choice.scale = varied.contains(Kind::scale) ? 1 : scale;
        if (std::ranges::count(requests_, choice) == 0) requests_.push_back(choice);
      }
  }
  if (!requests_.empty()) return;
  reference_alone_ = true;
  requests_ = {SweepChoice{}};
  for (const SweepParameter& parameter : parameters_)
    if (parameter.kind != Kind::scene)
      reading.fault(parameter.location, "sweep." + parameter.name,
                    "must not vary without an engine: compare.engines is empty, and the sweep "
                    "names none");
  reading.throw_faults();
}

/// A row for each part, and last the request.
std::vector<std::size_t> SweepPlan::rows_of(std::uint64_t run) const {
  std::vector<std::size_t> rows(parts_.size() + 1);
  const auto take = [&](std::size_t count) {
    const std::uint64_t row = run % count;
    run /= count;
    return static_cast<std::size_t>(row);
  };
  std::size_t p = parts_.size();
  for (; p > 0 && scene_keys_[p - 1].empty(); --p) rows[p - 1] = take(parts_[p - 1].count);
  rows.back() = take(requests_.size());
  for (; p > 0; --p) rows[p - 1] = take(parts_[p - 1].count);
  return rows;
}

/// Runs that follow each other with one row of each part of the scene.
std::uint64_t SweepPlan::runs_of_scene_rows() const {
  std::uint64_t count = requests_.size();
  for (std::size_t p = 0; p < parts_.size(); ++p)
    if (scene_keys_[p].empty()) count *= parts_[p].count;
  return count;
}

/// Every row of a scene's part with the first rows of all others, and combinations spread over all;
/// of many, kMostTried of each.
std::set<std::uint64_t> SweepPlan::tried_runs() const {
  std::set<std::uint64_t> tried;
  std::uint64_t stride = runs_;
  for (std::size_t p = 0; p < parts_.size() && !scene_keys_[p].empty(); ++p) {
    const std::size_t count = parts_[p].count;
    stride /= count;
    const std::size_t few = std::min(count, kMostTried);
    for (std::size_t k = 0; k < few; ++k) tried.insert(k * count / few * stride);
  }
  const std::uint64_t each = runs_of_scene_rows(), scenes = runs_ / each;
  const std::uint64_t few = std::min<std::uint64_t>(scenes, kMostTried);
  for (std::uint64_t k = 0; k < few; ++k) tried.insert(k * scenes / few * each);
  return tried;
}

void SweepPlan::check(Reading& reading) const {
  std::set<std::string> told;
  const auto tell = [&](const Fault& fault) {
    if (told.insert(fault.message()).second)
      reading.fault(fault.location, fault.key, fault.rule, fault.value);
  };
  for (std::size_t p = 0; p < parts_.size(); ++p)
    for (std::size_t k = 0; k < parts_[p].names.size(); ++k) {
      const SweepParameter& parameter = parameters_[part_names_[p][k]];
      if (parameter.kind == Kind::scene) continue;
      for (std::size_t row = 0; row < parts_[p].count; ++row) {
        const YamlPointer node = parts_[p].value(row, k);
        Reading each(file_, units_);
        SweepChoice ignored;
        {
          const auto step = each.key("sweep." + parameter.name, node->location, *node);
          choose(parameter, *node, each, ignored);
        }
        std::ranges::for_each(each.faults(), tell);
      }
    }
  for (const std::uint64_t run : tried_runs()) {
    try {
      scene(run);
    } catch (const BadScenario& bad) {
      std::ranges::for_each(bad.faults(), tell);
    }
  }
}

SweepChoice SweepPlan::choice(std::uint64_t run) const {
  const std::vector<std::size_t> rows = rows_of(run);
  SweepChoice choice = requests_[rows.back()];
  Reading ignored(file_, units_);  // checked before
  for (std::size_t k = 0; k < parameters_.size(); ++k)
    if (parameters_[k].kind != Kind::scene) {
      const auto& [part, name] = places_[k];
      choose(parameters_[k], *parts_[part].value(rows[part], name), ignored, choice);
    }
  return choice;
}

std::vector<SweepChoice> SweepPlan::engine_choices() const {
  if (reference_alone_) return {};
  // Of each part that says something of them the distinct rows.
  std::vector<SweepChoice> choices = requests_;
  for (SweepChoice& choice : choices) choice.rate = choice.scale = 1;
  const auto is_engines = [](Kind kind) {
    return kind == Kind::engine || kind == Kind::version || kind == Kind::precision ||
           kind == Kind::profile;
  };
  Reading ignored(file_, units_);
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    std::vector<std::size_t> names;
    for (std::size_t k = 0; k < part_names_[p].size(); ++k)
      if (is_engines(parameters_[part_names_[p][k]].kind)) names.push_back(k);
    if (names.empty()) continue;
    std::vector<SweepChoice> more;
    for (const SweepChoice& before : choices)
      for (std::size_t row = 0; row < parts_[p].count; ++row) {
        SweepChoice choice = before;
        for (const std::size_t k : names)
          choose(parameters_[part_names_[p][k]], *parts_[p].value(row, k), ignored, choice);
        if (std::ranges::count(more, choice) == 0) more.push_back(std::move(choice));
      }
    choices = std::move(more);
  }
  std::vector<SweepChoice> distinct;
  for (SweepChoice& choice : choices)
    if (std::ranges::count(distinct, choice) == 0) distinct.push_back(std::move(choice));
  return distinct;
}

std::uint64_t SweepPlan::scene_id(std::uint64_t run) const {
  const std::vector<std::size_t> rows = rows_of(run);
  std::uint64_t id = 0;
  for (std::size_t p = 0; p < parts_.size() && !scene_keys_[p].empty(); ++p)
    id = id * (scene_keys_[p].back() + 1) + scene_keys_[p][rows[p]];
  return id;
}

YamlPointer SweepPlan::value(std::uint64_t run, std::size_t parameter) const {
  const auto& [part, name] = places_[parameter];
  return parts_[part].value(rows_of(run)[part], name);
}

/// `tree` with the run's values of the scene.
YamlPointer SweepPlan::tree_of(std::uint64_t run, YamlPointer tree) const {
  const std::vector<std::size_t> rows = rows_of(run);
  for (std::size_t k = 0; k < parameters_.size(); ++k) {
    if (parameters_[k].kind != Kind::scene) continue;
    const auto& [part, name] = places_[k];
    tree = with_value(tree, parameters_[k].path, parts_[part].value(rows[part], name),
                      parameters_[k].location);
  }
  return tree;
}

Scenario SweepPlan::scene(std::uint64_t run, ReadNumbers* numbers) const {
  return scenario_of(tree_of(run, tree_), file_, numbers);
}

Scenario SweepPlan::whole_scene(std::uint64_t run) const {
  return scenario_of(tree_of(run, whole_), file_);
}

std::string SweepPlan::digest() const {
  return content_digest(*parse_yaml(checked_text(text_, file_), file_));
}

}  // namespace slipcheck
