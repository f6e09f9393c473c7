#include <fmt/format.h>

#include "scenario/record_keys.h"
#include "scenario/rules/scene_rules.h"

namespace slipcheck {
namespace {

/// Steps per second, one or several.
Rule<std::vector<double>> rates_rule() {
  using Rates = std::vector<double>;
  // From a step of days to one shorter than light crosses a grain: beyond is a slip of the
  // keyboard.
  const Rule<double> rate = number(kFrequency, {1e-6, {}, 1e12, {}});
  return one_form_of<Rates>(
      "must be a frequency or a list of them",
      {{[](const YamlNode& node) { return is_list(node); }, list(rate, 1)},
       {is_scalar, made_from<Rates>(rate, [](double value) { return Rates{value}; })}});
}

Rule<EngineRequest> engine_rule() {
  using Precision = EngineRequest::Precision;
  Record<EngineRequest> engine;
  engine
      .key("engine", &EngineRequest::engine, name_text(NameStyle::engine), required,
           "an engine's name")
      .key("precision", &EngineRequest::precision,
           choice<Precision>({{"single", Precision::single_}, {"double", Precision::double_}}),
           optional, "of its floating-point numbers; else what is installed, of both double")
      .key("profile", &EngineRequest::profile, free_text(), optional,
           "its settings, by name or by the path of a YAML file")
      .key("rate", &EngineRequest::rates, rates_rule(), required,
           "steps per second, one or several")
      .key("expect", &EngineRequest::expect, expectation_rule(), optional,
           "what it is known to do; judged by this in place of the tolerances");
  return engine.rule();
}

/// The word true alone.
Rule<bool> true_rule() {
  return {[rule = boolean()](const YamlNode& node, Reading& reading, bool& target) {
            if (!rule.read(node, reading, target)) return false;
            if (!target) reading.fault(node, "must be true, or engines a list");
            return target;
          },
          [] {
            return nlohmann::json{{"const", true}};
          }};
}

/// A list of engines, or all that are installed.
Rule<Compare> engines_rule() {
  Record<AllEngines> all;
  all.key("all", &AllEngines::all, true_rule(), required, "every engine that is installed")
      .key("profiles", &AllEngines::profiles, list(free_text(), 1), optional,
           "of each, where it has them; else default and physical")
      .key("rate", &AllEngines::rates, rates_rule(), optional,
           "steps per second, one or several; else 240 and 1000");
  const Rule<std::vector<EngineRequest>> listed = list(engine_rule(), 0);
  const Rule<std::size_t> word_all = word({"all"});
  const Rule<AllEngines> in_part = all.rule();
  const Rule<Compare> as_word = {
      [word_all](const YamlNode& node, Reading& reading, Compare& compare) {
        std::size_t index = 0;
        compare.all_engines.emplace();
        return word_all.read(node, reading, index);
      },
      word_all.schema};
  const Rule<Compare> as_mapping = {
      [in_part](const YamlNode& node, Reading& reading, Compare& compare) {
        return in_part.read(node, reading, compare.all_engines.emplace());
      },
      in_part.schema};
  const Rule<Compare> as_list = {
      [listed](const YamlNode& node, Reading& reading, Compare& compare) {
        return listed.read(node, reading, compare.engines);
      },
      listed.schema};
  return one_form_of<Compare>("must be a list of engines, or all",
                              {{[](const YamlNode& node) { return is_list(node); }, as_list},
                               {[](const YamlNode& node) { return is_mapping(node); }, as_mapping},
                               {is_scalar, as_word}});
}

/// Periods to leave out, or until the state is steady.
Rule<WrittenRun> discard_rule(const Rule<std::int64_t>& periods) {
  const Rule<std::size_t> steady = word({"auto"});
  const Rule<WrittenRun> until_steady = {
      [steady](const YamlNode& node, Reading& reading, WrittenRun& run) {
        std::size_t index = 0;
        return run.discard_until_steady = steady.read(node, reading, index);
      },
      steady.schema};
  const Rule<WrittenRun> number = {
      [periods](const YamlNode& node, Reading& reading, WrittenRun& run) {
        const bool good = periods.read(node, reading, run.discard.emplace());
        if (!good) run.discard.reset();
        return good;
      },
      periods.schema};
  return one_form_of<WrittenRun>("must be a number of periods or auto",
                                 {{is_word("auto"), until_steady}, {is_scalar, number}});
}

Rule<CollapseModel> collapse_rule() {
  const Rule<double> time = number(kTime, kPositive);
  Record<ContactTimeModel> contact_time;
  contact_time.key("contact_time", &ContactTimeModel::contact_time, time, required,
                   "collisions of a body less than this apart do not dissipate");
  Record<LargestVelocityModel> largest_velocity;
  largest_velocity.key("contact_time", &LargestVelocityModel::contact_time, time, required,
                       "bodies that collide again within this form a cluster");
  return one_of<CollapseModel>(
      "model",
      {alternative<CollapseModel>("slowest_rebound", "a least speed with which bodies part",
                                  Record<SlowestRebound>()),
       alternative<CollapseModel>("contact_time", "TC model of Luding and McNamara", contact_time),
       alternative<CollapseModel>("largest_velocity",
                                  "of a cluster the pair that approaches fastest goes first",
                                  largest_velocity)});
}

}  // namespace

Rule<WrittenRun> run_rule() {
  using Until = Run::Until;
  const Rule<double> time = number(kTime, kPositive);
  const auto named = choice<Until>({{"rolling", Until::rolling}, {"rest", Until::rest}});
  const auto wrap = [](auto rule, auto assign) {
    return Rule<WrittenRun>{[=](const YamlNode& node, Reading& reading, WrittenRun& target) {
                              return assign(rule, node, reading, target);
                            },
                            rule.schema};
  };
  const Rule<WrittenRun> until_named =
      wrap(named, [](const auto& rule, const YamlNode& node, Reading& reading, WrittenRun& run) {
        return rule.read(node, reading, run.until.emplace());
      });
  const Rule<WrittenRun> until_time =
      wrap(time, [](const auto& rule, const YamlNode& node, Reading& reading, WrittenRun& run) {
        run.until = Until::time;
        return rule.read(node, reading, run.time);
      });
  const auto is_number = [](const YamlNode& node) {
    return is_scalar(node) && node.text.find_first_of("0123456789") != std::string::npos;
  };
  // What is nearly a word is read as one, so that the fault names the word.
  const auto is_nearly_a_word = [](const YamlNode& node) {
    return is_scalar(node) && !nearest(node.text, {"rolling", "rest"}).empty();
  };
  constexpr std::int64_t kMostPeriods = 1'000'000'000;
  Record<WrittenRun> run;
  run.whole("until",
            one_form_of<WrittenRun>("must be rolling, rest or a time",
                                    {{is_nearly_a_word, until_named},
                                     {is_word("rest"), until_named},
                                     {is_number, until_time}}),
            optional,
            "rolling: no body slides after the last collision; rest: none moves; or a time")
      .key("limit", &WrittenRun::limit, time, optional, "simulated time after which until failed")
      .key("periods", &WrittenRun::periods, integer(1, kMostPeriods), optional,
           "of a container's floor, to run")
      .whole("discard", discard_rule(integer(0, kMostPeriods)), optional,
             "periods before the first sample; auto: until the state is steady")
      .key("sample", &WrittenRun::sample_phase_zero, choice<bool>({{"phase_zero", true}}), optional,
           "when samples are taken, otherwise at every step")
      .key("collapse", &WrittenRun::collapse, collapse_rule(), optional,
           "what keeps inelastic collapse finite")
      .key("most_events", &WrittenRun::most_events, number(kRate, kPositive), optional,
           "a second and body; more end the run")
      .exactly_one_of({"until", "periods"});
  return run.rule();
}

Rule<Compare> compare_rule() {
  using Reference = Compare::Reference;
  Record<Compare> compare;
  compare
      .key("reference", &Compare::reference,
           choice<Reference>({{"auto", Reference::automatic},
                              {"event", Reference::event},
                              {"contact", Reference::contact},
                              {"steps", Reference::steps}}),
           optional, "solver of the reference; auto: event where all contacts are hard")
      .key("steps_per_contact", &Compare::steps_per_contact, number(kPureNumber, {10, {}, 1e6, {}}),
           optional, "steps in the shortest collision, of the reference steps")
      .whole("engines", engines_rule(), optional,
             "what is held against it; all: every engine that is installed")
      .key("headings", &Compare::headings,
           made_from<std::size_t>(integer(1, kMostHeadings),
                                  [](std::int64_t count) { return std::size_t(count); }),
           optional, "in which engines run the scene, evenly around the vertical")
      .key("scales", &Compare::scales, list(number(kPureNumber, {1e-9, {}, 1e9, {}}), 1), optional,
           "lengths of the similar scenes that engines run, over those of this one")
      .key("tolerance", &Compare::tolerance, tolerances_rule(), optional,
           "largest error of an observable, by its name or by that of its owner too");
  return compare.rule();
}

}  // namespace slipcheck
