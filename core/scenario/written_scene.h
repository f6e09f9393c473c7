#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scenario/scenario.h"

namespace slipcheck {

// A scene as it is written, its values in SI but nothing resolved: what the rules read into.

struct WrittenContact {
  std::vector<std::string> between;  ///< two names
  bool on_substrate = false;         ///< of the form that a contact with the substrate has
  BodyContact body;                  ///< where neither is the substrate
  MaterialOnSubstrate substrate;     ///< where one is
  std::string path;
  bool complete = false;  ///< read without a fault
};

enum class SpinKind { none, rolling, given };
struct WrittenSpin {
  SpinKind kind = SpinKind::none;
  std::vector<double> values;  ///< one (about y) or three [rad/s]
};

/// A length, or a part of the ball's radius.
struct Offset {
  double value = 0;
  bool of_radius = true;
};
/// A cue's stroke in place of velocity and spin. Exactly one of speed and impulse; with the speed
/// the mass.
struct Cue {
  std::optional<double> speed;                  ///< before it strikes [m/s], > 0
  std::optional<double> impulse;                ///< [N s], > 0
  std::optional<double> mass;                   ///< [kg], > 0
  double restitution = 1;                       ///< [-], in [0, 1]
  std::vector<Offset> offset = {Offset{}, {}};  ///< to the right of the centre, and above it
  double elevation = 0;                         ///< [rad], in [0, π/2)
  double heading = 0;                           ///< [rad], from x towards y
  double tip_friction = 0.6;                    ///< of a chalked tip on the ball [-], >= 0
};

struct WrittenBody {
  std::string name;
  std::string material;
  Sphere sphere;                 ///< its mass is not yet known
  std::optional<Extent> extent;  ///< of a block or cylinder; its axis is not yet known
  std::optional<Cue> cue;
  std::optional<double> mass;             ///< [kg], > 0
  std::vector<double> position;           ///< two or three [m]
  std::optional<std::string> on;          ///< a surface that it touches
  std::vector<double> velocity = {0, 0};  ///< two or three [m/s]; none with a cue
  WrittenSpin spin;
  std::string path;
  bool complete = false;  ///< read without a fault
};

/// Many bodies in an area.
struct Fill {
  enum class Arrange { random, lattice };
  std::string prefix;      ///< of the names, followed by 1, 2, …
  std::int64_t count = 0;  ///< > 0
  std::string material;
  double least_radius = 0;  ///< [m], > 0
  double most_radius = 0;   ///< [m], >= least_radius
  double shape_factor = Sphere{}.shape_factor;
  std::vector<double>
      area;  ///< [x0, y0, x1, y1] of the centres [m]; z in place of y in a container
  std::optional<Vector2> heights;  ///< of the centres, where they fill a space [m]
  double speed = 0;                ///< of each in a random direction [m/s], >= 0
  Arrange arrange = Arrange::random;
  SpinKind spin = SpinKind::none;  ///< none or rolling
  std::int64_t seed = 1;           ///< >= 0
  std::string path;
  bool complete = false;  ///< read without a fault
};

/// A box is a plate for each of its closed sides.
struct BoxOfPlates {
  enum class Side { left, right, front, back, bottom, top };
  Vector3 from = Vector3::Zero(),
          to = Vector3::Zero();  ///< corners, from below to in each direction
  std::vector<Side> open;
};
template <>
inline constexpr std::array kNamesOf<BoxOfPlates::Side> = {"left", "right",  "front",
                                                           "back", "bottom", "top"};

struct WrittenSurface {
  std::string name, material;
  std::variant<SurfaceShape, BoxOfPlates> shape;
  SurfaceMotionModel motion;
  std::string path;
  bool complete = false;  ///< read without a fault
};

struct WrittenRun {
  std::optional<Run::Until> until;
  double time = 0;
  std::optional<double> limit;
  std::optional<std::int64_t> periods, discard;
  bool discard_until_steady = false;
  std::optional<bool> sample_phase_zero;
  CollapseModel collapse = Run{}.collapse;
  double most_events = Run{}.most_events;
};

struct WrittenScene {
  std::string name, title, source;
  double gravity = Scenario{}.gravity.norm();  ///< [m/s²], >= 0
  std::map<std::string, Material> materials;
  std::vector<WrittenContact> contacts;
  std::optional<Substrate> substrate;
  std::optional<Container> container;
  std::vector<WrittenSurface> surfaces;
  std::vector<std::variant<WrittenBody, Fill>> bodies;
  std::vector<Fill> fill;
  WrittenRun run;
  Compare compare;
};

}  // namespace slipcheck
