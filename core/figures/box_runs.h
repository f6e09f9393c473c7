#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "harness/observe/blocking.h"
#include "report/charts/chart.h"
#include "scene/scene.h"

namespace slipcheck {

/// L's vertical box over a vibrating floor, Sec. III. The diameter, the width, the count and the
/// frequency are the paper's; the contacts are this project's, as the paper's text is not at hand.
struct VibratedBox {
  std::size_t count = 50;        ///< N, > 0
  double diameter = 1e-3;        ///< d0 [m], > 0
  double width = 10;             ///< of the box [d0], >= 2
  double shape_factor = 0.4;     ///< q, > 0
  double frequency = 100;        ///< f [Hz], > 0
  double speed = 1;              ///< V = 2π f A0, of the floor at its fastest [m/s], > 0
  PairContact pair{0.9, 0, 0};   ///< of two spheres
  PairContact floor{0.9, 0, 0};  ///< of a sphere and the floor
  PairContact wall{0.9, 0, 0};   ///< and a side wall
  bool moving_walls = false;     ///< go up and down with the floor

  /// All three contacts alike: restitution e, friction μ, β0.
  void set_contacts(double e, double friction, double tangential_restitution);

  /// Steel spheres, at the start in rows over the floor, with velocities of one size in directions
  /// that do not depend on the machine.
  Scene scene() const;
};

/// What one run shows, at phase zero of the floor. Errors are standard errors of the mean.
struct BoxMeans {
  double height = 0, height_error = 0;  ///< H [m]
  double ratio = 0, ratio_error = 0;    ///< K/R; not finite where nothing spins
  double collision_rate = 0;            ///< of two spheres, all together [1/s]
  double kinetic_energy = 0;            ///< K [J]
  bool steady = false;                  ///< as BoxObservables::steady
};

/// One run for each box, side by side on all cores; the results do not depend on how many. Each
/// leaves out ten times the flight time 2V/g and then looks for sixty, or 250 and 1500 periods if
/// that is longer, and `longer` times that. Throws std::runtime_error with the reason for a run
/// that did not come to its end.
std::vector<BoxMeans> run_boxes(std::span<const VibratedBox> boxes, double longer = 1);

/// Vertical bars y ± error, for the same x, as a curve without a label.
Curve error_bars(Ink ink, const std::vector<double>& x, const std::vector<double>& y,
                 const std::vector<double>& error);

/// One number of each run.
std::vector<double> column(std::span<const BoxMeans> runs, double BoxMeans::*member);

}  // namespace slipcheck
