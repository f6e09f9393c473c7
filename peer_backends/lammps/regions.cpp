#include "peer_backends/lammps/regions.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <numbers>
#include <variant>

#include "engine/engine.h"
#include "peer_backends/shared/surface_frame.h"

namespace slipcheck::lammps {
namespace {

/// Of a plate, of the shorter of its half sides.
constexpr double kThickness = 1e-9;

std::string triple(const Vector3& v) {
  return fmt::format("{} {} {}", exact(v.x()), exact(v.y()), exact(v.z()));
}

/// A block or cylinder along z around `centre`, with the box's axes.
std::string upright(const Vector3& centre, const Vector3& half) {
  std::string text = "block";
  for (int k = 0; k < 3; ++k)
    text += fmt::format(" {} {}", exact(centre[k] - half[k]), exact(centre[k] + half[k]));
  return text;
}

struct StyleOf {
  Vector3 centre;
  std::string operator()(const PlaneShape& plane) const {
    return fmt::format("plane {} {} side in", triple(plane.point), triple(plane.normal));
  }
  std::string operator()(const RectangleShape& plate) const {
    return upright(centre, peer::half_sizes(plate, kThickness)) + " side out";
  }
  std::string operator()(const RodShape& rod) const {
    const double half = 0.5 * (rod.end - rod.begin).norm();
    return fmt::format("cylinder z {} {} {} {} {} side out", exact(centre.x()), exact(centre.y()),
                       exact(rod.radius), exact(centre.z() - half), exact(centre.z() + half));
  }
  std::string operator()(const BallShape& ball) const {
    return fmt::format("sphere {} {} side out", triple(ball.centre), exact(ball.radius));
  }
};

/// x_S along one direction as LAMMPS's formula of the time since its start.
std::string formula(const SubstrateMotion& course, int direction, double start) {
  const std::string time = fmt::format("({}+step*dt)", exact(start));
  if (course.kind() == SubstrateMotion::Kind::constant)
    return fmt::format("{}*{}", exact(course.velocity(0)[direction]), time);
  return fmt::format("{}*sin({}*{}+{})", exact(course.vector()[direction]),
                     exact(2 * std::numbers::pi * course.frequency()), time, exact(course.phase()));
}

struct Placed {
  std::string variables, words;  // before the region, and at its end
};

Placed moved(const SurfaceMotion& motion, std::size_t k, double start) {
  Placed placed;
  placed.words = " move";
  for (int axis = 0; axis < 3; ++axis) {
    placed.variables +=
        fmt::format("variable way{}_{} equal \"{}*{}+{}*{}\"\n", k, axis,
                    exact(motion.first()[axis]), formula(motion.course(), 0, start),
                    exact(motion.second()[axis]), formula(motion.course(), 1, start));
    placed.words += fmt::format(" v_way{}_{}", k, axis);
  }
  return placed;
}

Placed turned(std::size_t k, const std::string& angle, const Vector3& about, const Vector3& axis) {
  return {fmt::format("variable turn{} equal \"{}\"\n", k, angle),
          fmt::format(" rotate v_turn{} {} {}", k, triple(about), triple(axis))};
}

void refuse(std::size_t k, const char* what) {
  throw Refused(fmt::format("lammps: surface {} {}", k, what));
}

Placed placed(const slipcheck::Surface& surface, std::size_t k, double start) {
  const SurfaceMotion& motion = surface.motion;
  const bool plane = std::holds_alternative<PlaneShape>(surface.shape);
  const bool round = std::holds_alternative<BallShape>(surface.shape);
  Placed all;
  if (!motion.is_still() && motion.rate().isZero(0)) {
    if (motion.is_belt() && !plane)
      refuse(k, "is a belt, and a region that is no plane moves with its matter");
    if (motion.course().kind() == SubstrateMotion::Kind::table)
      refuse(k, "moves by a table, and a region by formulas");
    all = moved(motion, k, start);
  }
  if (!motion.rate().isZero(0)) {
    if (!plane && !round) refuse(k, "turns, and its region is turned into its place already");
    const std::string angle =
        fmt::format("{}*({}+step*dt)", exact(motion.rate().norm()), exact(start));
    return turned(k, angle, motion.pivot(), motion.rate());
  }
  if (plane || round) return all;
  const peer::SurfaceFrame frame = peer::frame_at({surface.shape, {}}, 0);
  const Eigen::AngleAxisd turn(frame.axes);
  if (turn.angle() == 0) return all;
  const Placed put = turned(k, exact(turn.angle()), frame.centre, turn.axis());
  return {all.variables + put.variables, all.words + put.words};
}

}  // namespace

std::string exact(double value) { return fmt::format("{:.17g}", value); }

std::string region_name(std::size_t surface) { return fmt::format("beside{}", surface); }

std::string region_commands(const Scene& scene, double time) {
  std::string text;
  for (std::size_t k = 0; k < scene.surfaces.size(); ++k) {
    const slipcheck::Surface& surface = scene.surfaces[k];
    const Vector3 centre = peer::frame_at({surface.shape, {}}, 0).centre;
    const Placed where = placed(surface, k, time);
    text += fmt::format("{}region {} {} units box{}\n", where.variables, region_name(k),
                        std::visit(StyleOf{centre}, surface.shape), where.words);
  }
  return text;
}

}  // namespace slipcheck::lammps
