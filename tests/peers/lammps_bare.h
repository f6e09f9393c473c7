#pragma once

#include <string>
#include <utility>
#include <vector>

#include "physics/sphere.h"
#include "scene/contact_scene.h"

// LAMMPS as somebody types it who has no adapter: input files of its own language.

namespace slipcheck::test {

/// A law as LAMMPS takes it: coefficients of gran/hooke/history or gran/hertz/history.
struct HistoryLaw {
  bool hertz = false;
  double k_n = 0, k_t = 0;          // [N/m], or [Pa]
  double gamma_n = 0, gamma_t = 0;  // [1/s], or [1/(m s)]
  double friction = 0;

  /// Behind its style.
  std::string words() const;
  const char* style() const { return hertz ? "hertz/history" : "hooke/history"; }

  /// The same here, between two that have this reduced mass and effective radius.
  SoftContact contact(double mass, double radius) const;
};

/// Units, the box between two corners [m] and all bodies of a scene where they start.
std::string bare_atoms(const Scene& scene, const std::pair<Vector3, Vector3>& box);

/// What `lmp` makes of an input in so many steps of a length [s]: the states of all bodies in the
/// first frame and each `every` steps.
std::vector<std::vector<BodyState>> bare_lammps(const std::string& input, double step, int steps,
                                                int every, std::size_t bodies);

}  // namespace slipcheck::test
