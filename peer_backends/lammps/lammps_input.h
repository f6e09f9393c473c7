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

/// From so many bodies on a world is read from a file: a command for each costs 25 us of LAMMPS's
/// time and all ranks', a line of a file a tenth of that.
inline constexpr std::size_t kReadFrom = 1000;
/// Whether input() names a file for `read_data`.
inline bool is_read(const Scene& scene) { return scene.bodies.size() >= kReadFrom; }

/// The commands that make a fresh world of these states at `time` [s], as seen from the substrate,
/// up to the run that finds the first forces. Nothing is left of an earlier one. Where is_read(),
/// the bodies come from `data_file`, which holds data_text(). Throws Refused.
std::string input(const EngineScene& scene, std::span<const BodyState> states, double time,
                  const LammpsSettings& settings, double inner_step, const std::string& data_file);

/// Box, places and velocities as `read_data` takes them: what input() otherwise says body by body,
/// to the last bit.
std::string data_text(const Scene& scene, std::span<const BodyState> states);

/// The command for the file or pipe to which snapshots go, named `frames`: id, place, velocity and
/// angular velocity with all digits.
std::string dump_command(const Scene& scene, const std::string& file);

/// What is in force, SI.
Settings applied(const EngineScene& scene, const LammpsSettings& settings, const InnerSteps& steps);

}  // namespace slipcheck::lammps
