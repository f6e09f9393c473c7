#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "reference/gas/gas.h"
#include "reference/gas/mean_field.h"

namespace slipcheck {

/// A number and its standard error, NaN where there is none.
struct Measured {
  double value = std::numeric_limits<double>::quiet_NaN();
  double error = std::numeric_limits<double>::quiet_NaN();
};

/// The gas at one time.
struct GasSample {
  double time = 0;        ///< [s]
  double collisions = 0;  ///< of a particle
  Measured translation;   ///< T [J]
  Measured rotation;      ///< T_rot [J]
  Measured ratio;         ///< T_rot/T [-]
  Measured a2;            ///< of the velocities [-]
  GasTemperatures mean_field;
};

/// Something measured beside what theory says of it.
struct GasStatement {
  std::string name;
  Measured measured;
  double theory = std::numeric_limits<double>::quiet_NaN();
  std::string source = {};  ///< of the theory
};

/// How a gas cooled.
struct GasRun {
  std::vector<GasSample> samples;
  std::vector<GasStatement> statements;
  std::size_t collisions = 0;
  std::size_t cells = 0;
  std::size_t overtaken = 0;  ///< pairs faster than the majorant; their rate was too small
  bool interrupted = false;   ///< by StopScope, before the end
};

struct GasOptions {
  GasSetup setup;
  double collisions = 100;    ///< of a particle, > 0
  std::size_t samples = 100;  ///< evenly over these, >= 8
  /// GasOfScene's: the exponent −2/(1 + p) of T(t) is then what theory says.
  std::optional<double> speed_exponent;
  /// Told the collisions of a particle so far.
  std::function<void(double)> progress = [](double) {};
};

/// Errors are those of parts of the particles. Statements are of the second half of the samples,
/// when the gas has forgotten its start; the rate of cooling between two of them is independent of
/// the others, as nothing drives T back, and gives their errors.
GasRun run_gas(const GasOptions& options, const GasLaw& law);

}  // namespace slipcheck
