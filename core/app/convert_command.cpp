// The units of an engine in place of the coefficients of a scene, and back.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/commands.h"
#include "app/output.h"
#include "base/json_node.h"
#include "base/not_finite.h"
#include "convert/combine_rules.h"
#include "convert/engine_contact.h"
#include "convert/rolling_length.h"
#include "report/rows/text_table.h"
#include "report/terminal/table_style.h"
#include "scenario/units.h"

namespace slipcheck {
namespace {

using Json = nlohmann::ordered_json;

constexpr Dimension kDamping{"damping", 1, 0, -1, 0, "N s/m", "dyn s/cm", "2 N s/m"};

/// One number that is told, SI.
struct ConvertedRow {
  std::string of, name;
  std::optional<double> value;
  std::string unit, formula, source;
};

/// What both outputs show.
class Conversion {
 public:
  void add(ConvertedRow row) { rows_.push_back(std::move(row)); }

  void show(const std::string& what, const std::string& json_path, bool quiet) const {
    write_json(json_path, [&] { return json(what).dump(2) + "\n"; });
    if (!quiet && json_path != "-") fmt::print("{}", terminal_table(table(), table_style(), 0));
  }

 private:
  Json json(const std::string& what) const {
    Json all{{"schema", "slipcheck-conversion/1"}, {"what", what}, {"rows", Json::array()}};
    for (const auto& [of, name, value, unit, formula, source] : rows_) {
      Json row{{"of", of}, {"name", name}};
      put_number(row, "value", value.value_or(NAN), formula);
      row["unit"] = unit;
      row["formula"] = formula;
      row["source"] = source;
      all["rows"].push_back(std::move(row));
    }
    return all;
  }

  TextTable table() const {
    TextTable table;
    table.columns = {{"of"}, {"quantity"}, {"value", true}, {"unit"}, {""}, {"source", false, 1}};
    for (const auto& [of, name, value, unit, formula, source] : rows_)
      table.rows.push_back({{of},
                            {name},
                            {value ? fmt::format("{:.6g}", *value) : "–"},
                            {unit},
                            {formula},
                            {source, Tone::faint}});
    const bool has_units =
        std::ranges::any_of(rows_, [](const ConvertedRow& row) { return !row.unit.empty(); });
    if (!has_units) return table.with({0, 1, 2, 4, 5});
    return table;
  }

  std::vector<ConvertedRow> rows_;
};

struct ConvertOutput {
  std::string json;
  bool quiet = false;
};

void add_outputs(CLI::App& command, ConvertOutput& output) {
  command.add_option("--json", output.json, "The same as JSON, values in SI; - for stdout");
  command.add_flag("-q,--quiet", output.quiet, "Say nothing but what --json asks for");
}

/// "5 mm", or a bare number in SI, within [low, high].
double quantity_of(const char* option, const std::string& text, const Dimension& dimension,
                   double low, double high = HUGE_VAL) {
  const char* unit = dimension.si;
  double value = 0;
  try {
    value = parse_quantity(text, dimension).value;
  } catch (const BadQuantity& bad) {
    throw BadOption(fmt::format("{}: {}, got {}", option, bad.what(), text));
  }
  if (value < low || value > high) {
    const std::string limit = low == kTiny ? "> 0" : fmt::format(">= {:g}", low);
    const std::string most = std::isfinite(high) ? fmt::format(" and <= {:g}", high) : "";
    throw BadOption(fmt::format("{}: must be {}{} {}, got {}", option, limit, most, unit, text));
  }
  return value;
}

// --- contacts ------------------------------------------------------------------------------------

struct ContactArguments {
  std::string restitution, collision_time, stiffness, damping, mass = "1 kg", other_mass,
                                                               time_step = "1 ms";
  std::vector<std::string> solref;
  ConvertOutput output;
};

/// m, or m₁m₂/(m₁ + m₂) [kg].
double reduced_mass_of(const ContactArguments& arguments) {
  const double mass = quantity_of("--mass", arguments.mass, kMass, kTiny);
  if (arguments.other_mass.empty()) return mass;
  const double other = quantity_of("--other-mass", arguments.other_mass, kMass, kTiny);
  return mass / (mass + other) * other;
}

LinearContact contact_of(const ContactArguments& arguments, double reduced_mass, double time_step) {
  constexpr auto kEnd = LinearContact::End::zero_force;
  const bool has_e = !arguments.restitution.empty(), has_t = !arguments.collision_time.empty(),
             has_k = !arguments.stiffness.empty(), has_c = !arguments.damping.empty(),
             has_solref = !arguments.solref.empty();
  const bool good = has_solref ? !has_e && !has_t && !has_k && !has_c
                    : has_e    ? has_t != has_k && !has_c
                               : has_k && has_c && !has_t;
  if (!good)
    throw BadOption(
        "must be given --restitution with --collision-time or --stiffness, or --stiffness with "
        "--damping, or --solref");
  if (has_solref) {
    if (arguments.solref.size() != 2)
      throw BadOption("--solref: must be two numbers, separated by a comma");
    const auto number = [](const std::string& text) {
      return quantity_of("--solref", text, kPureNumber, -HUGE_VAL);
    };
    const SolRef solref{number(arguments.solref[0]), number(arguments.solref[1])};
    const bool by_time = solref.first > 0 && solref.second > 0;
    const bool by_stiffness = solref.first < 0 && solref.second <= 0;
    if (!by_time && !by_stiffness)
      throw BadOption(
          "--solref: must be timeconst > 0 and dampratio > 0, or -stiffness < 0 and -damping <= 0");
    return contact_of_solref(solref, reduced_mass, time_step);
  }
  const auto stiffness = [&] {
    return quantity_of("--stiffness", arguments.stiffness, kStiffness, kTiny);
  };
  if (!has_e) {
    const double c = quantity_of("--damping", arguments.damping, kDamping, 0);
    return {reduced_mass, stiffness(), c / reduced_mass, kEnd};
  }
  const double e = quantity_of("--restitution", arguments.restitution, kPureNumber, kTiny, 1);
  if (has_k) return LinearContact::with_stiffness(reduced_mass, e, stiffness(), kEnd);
  const double t = quantity_of("--collision-time", arguments.collision_time, kTime, kTiny);
  return LinearContact::with_collision_time(reduced_mass, e, t, kEnd);
}

void add_rebounds(Conversion& rows, const char* engine, const LinearContact& contact,
                  ContactStep step, double time_step) {
  const ReboundRange e = rebounds(contact, step, time_step);
  rows.add({engine, "e in steps", e.median, "",
            fmt::format("{:.4f} … {:.4f} over phases", e.least, e.most), "docs/conversions.md"});
}

/// Whether --solref has a timeconst that MuJoCo's refsafe takes for two steps.
bool is_raised_solref(const ContactArguments& arguments, double time_step) {
  if (arguments.solref.empty()) return false;
  const double timeconst = parse_number(arguments.solref[0]);
  return timeconst > 0 && timeconst < 2 * time_step;
}

void convert_contact(const ContactArguments& arguments) {
  const double time_step = quantity_of("--time-step", arguments.time_step, kTime, kTiny);
  const double mass = reduced_mass_of(arguments);
  const LinearContact contact = contact_of(arguments, mass, time_step);
  const char* kondic = "Kondic 1999 (2)";
  Conversion rows;
  rows.add({"contact", "e", contact.restitution(), "", "exp(-γ t_col/2)", kondic});
  rows.add({"contact", "t_col", contact.collision_time(), "s", "until the force is zero", kondic});
  rows.add({"contact", "γ", contact.damping_rate(), "1/s", "c/m", kondic});
  rows.add({"contact", "ω0", contact.contact_frequency(), "1/s", "√(k/m)", kondic});
  rows.add({"contact", "m", mass, "kg", "reduced mass", kondic});
  rows.add({"spring", "k", contact.stiffness(), "N/m", "m ω0²", kondic});
  rows.add({"spring", "c", damping_constant(contact), "N s/m", "m γ", kondic});

  const SolRef by_time = time_solref(contact), by_stiffness = stiffness_solref(contact);
  // Either MuJoCo will raise it, or it has been raised already.
  const bool raised = by_time.first < 2 * time_step || is_raised_solref(arguments, time_step);
  const char* mujoco = "MuJoCo documentation";
  rows.add({"mujoco", "solref timeconst", by_time.first, "s",
            std::isinf(by_time.first) ? "none without damping"
            : raised                  ? "2/γ; RAISED to two steps"
                                      : "2/γ",
            mujoco});
  rows.add({"mujoco", "solref dampratio", by_time.second, "", "γ/(2 ω0)", mujoco});
  rows.add(
      {"mujoco", "solref -stiffness", by_stiffness.first, "1/s2", "-ω0², of any mass", mujoco});
  rows.add({"mujoco", "solref -damping", by_stiffness.second, "1/s", "-γ, of any mass", mujoco});
  add_rebounds(rows, "mujoco", contact, ContactStep::force_at_start, time_step);

  const ErpCfm both = erp_cfm(contact, time_step);
  const char* ode = "ODE manual";
  rows.add({"ode", "soft_erp", both.erp, "", "h k/(h k + c)", ode});
  rows.add({"ode", "soft_cfm", both.cfm, "s/kg", "1/(h k + c)", ode});
  add_rebounds(rows, "ode", contact, ContactStep::force_at_end, time_step);

  const char* bullet = "btManifoldResult";
  rows.add({"bullet", "contact stiffness", contact.stiffness(), "N/m", "pair's: 1/(1/k1 + 1/k2)",
            bullet});
  rows.add(
      {"bullet", "contact damping", damping_constant(contact), "N s/m", "pair's: c1 + c2", bullet});
  add_rebounds(rows, "bullet", contact, ContactStep::foreseen, time_step);
  rows.show("contact", arguments.output.json, arguments.output.quiet);
}

// --- rolling friction ----------------------------------------------------------------------------

struct RollingArguments {
  std::string radius, shape_factor = "0.4", coefficient, length;
  ConvertOutput output;
};

void convert_rolling(const RollingArguments& arguments) {
  if (arguments.coefficient.empty() == arguments.length.empty())
    throw BadOption("must be given one of --coefficient and --length");
  Sphere sphere{quantity_of("--radius", arguments.radius, kLength, kTiny), 1,
                quantity_of("--shape-factor", arguments.shape_factor, kPureNumber, kTiny)};
  const bool by_length = !arguments.length.empty();
  const double mu_r =
      by_length ? rolling_coefficient(sphere, quantity_of("--length", arguments.length, kLength, 0))
                : quantity_of("--coefficient", arguments.coefficient, kPureNumber, 0);
  const double rho = rolling_length(sphere, mu_r);
  constexpr double kLeastOfMuJoCo = 1e-5;
  Conversion rows;
  rows.add({"scene", "rolling", mu_r, "", "μ_r, slows what rolls by μ_r g", "Kondic 1999 (16)"});
  rows.add({"bullet", "setRollingFriction", rho, "m", "(1 + q) μ_r R, of the pair: r1 f2 + r2 f1",
            "btManifoldResult"});
  rows.add({"ode", "rho", rho, "m", "(1 + q) μ_r R", "dContactRolling"});
  rows.add({"mujoco", "friction[2]", rho, "m",
            rho < kLeastOfMuJoCo ? "(1 + q) μ_r R; is RAISED to 1e-5" : "(1 + q) μ_r R",
            "condim 6"});
  rows.show("rolling", arguments.output.json, arguments.output.quiet);
}

// --- coefficients of pairs -----------------------------------------------------------------------

struct CombineArguments {
  std::string first, second, pair, quantity = "friction";
  ConvertOutput output;
};

void convert_pair(const CombineArguments& arguments) {
  const auto number = [&](const char* option, const std::string& text) {
    return quantity_of(option, text, kPureNumber, 0);
  };
  const int given = !arguments.first.empty() + !arguments.second.empty() + !arguments.pair.empty();
  const bool needs_first = !arguments.second.empty() && arguments.first.empty();
  if (given == 0 || given == 3 || needs_first || (given == 1 && arguments.pair.empty()))
    throw BadOption("must be given --pair, --pair and --first, or --first and --second");
  Conversion rows;
  for (const EngineRules& engine : engine_rules()) {
    const std::optional<CombineRule> rule =
        arguments.quantity == "friction" ? engine.friction : engine.restitution;
    const auto add = [&](const char* name, std::optional<double> value, const char* formula) {
      rows.add({engine.engine, name, value, "", formula, engine.source});
    };
    if (!rule) {
      add("of a body", std::nullopt, "bodies have none");
    } else if (arguments.pair.empty()) {
      const double first = number("--first", arguments.first);
      add("of the pair", combined(*rule, first, number("--second", arguments.second)),
          formula_of(*rule));
    } else if (arguments.first.empty()) {
      add("of both bodies", both_of_pair(*rule, number("--pair", arguments.pair)),
          formula_of(*rule));
    } else {
      const auto other = other_of_pair(*rule, number("--first", arguments.first),
                                       number("--pair", arguments.pair));
      add("of the other", other, other ? formula_of(*rule) : "no value does");
    }
  }
  rows.show("pair", arguments.output.json, arguments.output.quiet);
}

// --- commands ------------------------------------------------------------------------------------

void add_contact(CLI::App& parent, int& exit_code) {
  CLI::App* command = parent.add_subcommand("contact",
                                            "Restitution, spring and dashpot, MuJoCo's solref, "
                                            "ODE's ERP and CFM, Bullet's contact stiffness");
  auto arguments = std::make_shared<ContactArguments>();
  command->add_option("--restitution", arguments->restitution, "e in (0, 1]");
  command->add_option("--collision-time", arguments->collision_time, "As in \"1 ms\"");
  command->add_option("--stiffness", arguments->stiffness, "As in \"1e5 N/m\"");
  command->add_option("--damping", arguments->damping, "As in \"2 N s/m\"");
  command->add_option("--solref", arguments->solref, "MuJoCo's two numbers, --solref=-1e4,-20")
      ->delimiter(',');
  command->add_option("--mass", arguments->mass, "Of the sphere")->capture_default_str();
  command->add_option("--other-mass", arguments->other_mass,
                      "Of the other sphere; else it meets a plane");
  command->add_option("--time-step", arguments->time_step, "Of the engine")->capture_default_str();
  add_outputs(*command, arguments->output);
  command->footer(
      "Example:\n"
      "  slipcheck convert contact --restitution 0.8 --collision-time \"20 ms\" --mass \"5 g\"");
  command->callback([arguments, &exit_code] {
    check_output("--json", arguments->output.json, false);
    convert_contact(*arguments);
    exit_code = kWithinTolerance;
  });
}

void add_rolling(CLI::App& parent, int& exit_code) {
  CLI::App* command =
      parent.add_subcommand("rolling", "Rolling friction as a coefficient and as a length");
  auto arguments = std::make_shared<RollingArguments>();
  command->add_option("--radius", arguments->radius, "Of the sphere, as in \"5 mm\"")->required();
  command->add_option("--coefficient", arguments->coefficient, "The scene's, mu_r");
  command->add_option("--length", arguments->length, "An engine's, as in \"70 um\"");
  command->add_option("--shape-factor", arguments->shape_factor, "q = I/(m R^2)")
      ->capture_default_str();
  add_outputs(*command, arguments->output);
  command->footer("Example:\n  slipcheck convert rolling --radius \"5 mm\" --coefficient 0.01");
  command->callback([arguments, &exit_code] {
    check_output("--json", arguments->output.json, false);
    convert_rolling(*arguments);
    exit_code = kWithinTolerance;
  });
}

void add_pair(CLI::App& parent, int& exit_code) {
  CLI::App* command = parent.add_subcommand(
      "pair", "A coefficient of a pair and those of its bodies, by each engine's rule");
  auto arguments = std::make_shared<CombineArguments>();
  command->add_option("--quantity", arguments->quantity, "friction or restitution")
      ->check(CLI::IsMember({"friction", "restitution"}))
      ->capture_default_str();
  command->add_option("--first", arguments->first, "One body's");
  command->add_option("--second", arguments->second, "The other's");
  command->add_option("--pair", arguments->pair, "The pair's");
  add_outputs(*command, arguments->output);
  command->footer(
      "Examples:\n"
      "  slipcheck convert pair --first 0.5 --second 0.8\n"
      "  slipcheck convert pair --quantity restitution --pair 0.8");
  command->callback([arguments, &exit_code] {
    check_output("--json", arguments->output.json, false);
    convert_pair(*arguments);
    exit_code = kWithinTolerance;
  });
}

}  // namespace

void add_convert_command(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("convert", "A scene's coefficients in the units of engines, and back");
  command->require_subcommand(1);
  accept_quiet(*command);
  add_contact(*command, exit_code);
  add_rolling(*command, exit_code);
  add_pair(*command, exit_code);
  command->footer(
      "Example:\n"
      "  slipcheck convert rolling --radius \"5 mm\" --coefficient 0.01");
}

}  // namespace slipcheck
