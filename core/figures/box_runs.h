#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "figures/effort.h"
#include "harness/observe/blocking.h"
#include "report/charts/chart.h"
#include "scene/scene.h"

namespace slipcheck {

/// L's vertical box over a vibrating floor, Sec. III, as the paper has it where it says nothing
/// else: spheres of many sizes, rough to each other, in an elastic smooth box.
struct VibratedBox {
  std::size_t count = 50;           ///< N, > 0
  double diameter = 1e-3;           ///< d0, the spheres' mean [m], > 0
  double spread = 0.1;              ///< w0, diameters lie evenly in d0 ± w0 [d0], in [0, 1)
  double width = 10;                ///< L [d0], >= 2
  double shape_factor = 0.4;        ///< q, > 0
  double frequency = 100;           ///< f [Hz], > 0
  double speed = 1;                 ///< V = 2π f A0, of the floor at its fastest [m/s], > 0
  PairContact pair{0.9, 0.2, 0.5};  ///< of two spheres
  PairContact floor{1.0, 0, 0};     ///< of a sphere and the floor, and the lid
  PairContact wall{1.0, 0, 0};      ///< and a side wall
  bool moving_walls = false;        ///< go up and down with the floor
  std::optional<double> lid;        ///< its height over the floor [m], > 0; open without

  /// All three contacts alike: restitution e, friction μ, β0.
  void set_contacts(double e, double friction, double tangential_restitution);

  /// Steel spheres whose diameters are the N middles of equal parts of d0 ± w0, so that their mean
  /// is d0, in an order drawn at random; at the start in rows over the floor, with velocities of
  /// one size in directions that do not depend on the machine.
  Scene scene() const;
};

/// What one run shows, at phase zero of the floor. Errors are standard errors of the mean.
struct BoxMeans {
  double height = 0, height_error = 0;  ///< H [m]
  double ratio = 0, ratio_error = 0;    ///< K/R; NaN where nothing spins
  /// Mean energy of translation over that of height, mgH; 1 where they are equal. L's K/H, whose K
  /// lacks the factor m/2, is 2g times this.
  double kinetic_share = 0, kinetic_share_error = 0;
  bool steady = false;  ///< as BoxObservables::steady
};

/// One run for each box, side by side on all cores; the results do not depend on how many. Each
/// leaves out 2.5 s, or ten times the flight time 2V/g or 0.05 s/μ if that is longer, and then
/// looks for 15 s or 60 flight times, and `longer` times that. Throws std::runtime_error with the
/// reason for a run that did not come to its end.
std::vector<BoxMeans> run_boxes(std::span<const VibratedBox> boxes, double longer = 1);

/// How many times longer than the shortest run_boxes() a figure's runs are.
double times_longer(Effort effort);

/// Vertical bars y ± error, for the same x, as a curve without a label.
Curve error_bars(Ink ink, const std::vector<double>& x, const std::vector<double>& y,
                 const std::vector<double>& error);

/// One number of each run.
std::vector<double> column(std::span<const BoxMeans> runs, double BoxMeans::*member);

}  // namespace slipcheck
