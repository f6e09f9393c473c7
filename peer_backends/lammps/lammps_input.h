#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/engine_scene.h"
#include "peer_backends/lammps/lammps_settings.h"

namespace slipcheck::lammps {

/// How LAMMPS steps: `count` steps of `length` [s] in each step of the engine's.
struct InnerSteps {
  int count = 1;
  double length = 0;
};
InnerSteps inner_steps(const EngineScene& scene, const LammpsSettings& settings, double time_step);

/// The commands that make a fresh world of these states at `time` [s], as seen from the substrate,
/// up to the run that finds the first forces. Nothing is left of an earlier one. Throws Refused.
std::string input(const EngineScene& scene, std::span<const BodyState> states, double time,
                  const LammpsSettings& settings, double inner_step);

/// The command for the file or pipe to which snapshots go, named `frames`: id, place, velocity and
/// angular velocity with all digits.
std::string dump_command(const Scene& scene, const std::string& file);

/// What is in force, SI.
Settings applied(const EngineScene& scene, const LammpsSettings& settings, const InnerSteps& steps);

}  // namespace slipcheck::lammps
