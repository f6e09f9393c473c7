#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "scenario/scenario.h"
#include "studies/gas/gas_of_scene.h"
#include "studies/gas/gas_run.h"

namespace slipcheck {

/// A cooling gas: what it is of, its series and its statements; docs/gas.md. SI.
nlohmann::ordered_json json_of(const Scenario& scenario, const GasOfScene& gas,
                               const GasOptions& options, const GasRun& run);

/// The series, a row for each sample.
std::string gas_csv(const GasRun& run);

}  // namespace slipcheck
