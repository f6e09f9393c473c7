#pragma once

#include <nlohmann/json.hpp>

#include "base/json_fields.h"
#include "report/rows/context.h"
#include "scenario/scenario.h"

namespace slipcheck {

// What results of all kinds have in common.

/// What made a file and on which machine, without a date.
template <class Fields>
void describe(Fields& f, Context& context) {
  f.object("slipcheck", [&](auto& made) {
    made("version", context.version);
    made("commit", context.commit);
    made("build", context.build);
  });
  f.object("machine", [&](auto& machine) {
    machine("processor", context.cpu);
    machine("hardware_threads", context.cores);
    machine("system", context.system);
    machine("compiler", context.compiler);
  });
}

/// Puts that of this process into a file.
void put_context(nlohmann::ordered_json& file);

/// The scene with this text; throws BadJson where this version cannot read it or the digest
/// differs.
Scenario scenario_of_text(const FieldReader& scene);

template <class Fields>
void describe(Fields& f, Scenario& scenario) {
  if constexpr (Fields::kReads) {
    scenario = scenario_of_text(f);
  } else {
    f("name", scenario.name);
    f("title", scenario.title);
    f("file", scenario.file);
    f("sha256", scenario.sha256);
    f("text", scenario.text);
  }
}

}  // namespace slipcheck
