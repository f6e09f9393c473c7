#include "bullet_backend/leave_outs.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bullet_backend/vertical_plane.h"

namespace slipcheck::bullet {
namespace {

bool is_solved_by_mlcp(const BulletSettings& settings) {
  return settings.solver != SolverKind::sequential_impulse && settings.solver != SolverKind::nncg;
}

/// Whether any contact with the substrate or a surface is such.
template <class IsSuch>
bool has_lasting_contact(const Scene& scene, const IsSuch& is_such) {
  const bool on_substrate = !scene.box && scene.has_substrate;
  return (on_substrate && std::ranges::any_of(scene.substrate, is_such)) ||
         std::ranges::any_of(scene.on_surfaces, is_such, &SurfaceContact::lasting);
}

bool has_rolling_friction(const Scene& scene) {
  return has_lasting_contact(
      scene, [](const SubstrateContact& ground) { return !ground.rolling.is_zero(); });
}

bool has_drilling_friction(const Scene& scene) {
  return has_lasting_contact(
      scene, [](const SubstrateContact& ground) { return ground.drilling_length > 0; });
}

bool has_finite_surface(const Scene& scene) {
  return std::ranges::any_of(scene.surfaces, [](const Surface& surface) {
    return !std::holds_alternative<PlaneShape>(surface.shape);
  });
}

bool has_pair_friction(const Scene& scene) {
  return scene.bodies.size() > 1 && std::ranges::any_of(scene.pairs, [](const PairContact& pair) {
           return has_friction(pair.friction) && pair.tangential_restitution != -1;
         });
}

/// Whether one row of friction can do what the cone does. Bullet lays it along -y on a level plane
/// and across the motion between two balls (btPlaneSpace1 in convertMultiBodyContact), and without
/// the cone it solves no rows of rolling friction.
bool may_lose_a_friction_direction(const Scene& scene, const BulletSettings& settings) {
  const bool cone = settings.body == BodyKind::multibody && settings.two_friction_directions &&
                    settings.friction_cone && settings.solver == SolverKind::sequential_impulse;
  const bool turned = settings.tilt == Tilt::plane && scene.downhill != Vector2::Zero();
  return cone && !turned && !scene.box && scene.surfaces.empty() && !has_rolling_friction(scene) &&
         !has_pair_friction(scene);
}

int most_pairs(const Scene& scene) {
  constexpr double kShipped = 4096;  // of btDefaultCollisionConstructionInfo
  const auto bodies = static_cast<double>(scene.bodies.size());
  const double beside = static_cast<double>(scene.surfaces.size());
  const double surfaces = !scene.box ? 1 + beside : (scene.box->lid ? 4 : 3);
  return static_cast<int>(std::min(kShipped, bodies * (surfaces + (bodies - 1) / 2)));
}

}  // namespace

LeaveOuts find_leave_outs(const Scene& scene, std::span<const BodyState> states,
                          const BulletSettings& settings) {
  LeaveOuts leaves;
  if (!settings.leaves_out) return leaves;
  const bool rigid = settings.body == BodyKind::rigid;
  // What follows is of spheres, which look alike from all sides.
  const bool round = scene.extents.empty();
  leaves.broadphase = round && scene.bodies.size() == 1 && !has_finite_surface(scene);
  leaves.predictions =
      round && (!rigid || (settings.linear_damping == 0 && settings.angular_damping == 0));
  leaves.sweeps = !rigid || !settings.ccd || settings.ccd_motion_threshold == 0;
  leaves.most_pairs = most_pairs(scene);
  if (round && may_lose_a_friction_direction(scene, settings))
    leaves.line = line_of_motion(scene, states);
  return leaves;
}

std::vector<std::string> left_out(const LeaveOuts& leaves, const Scene& scene,
                                  const BulletSettings& settings) {
  std::vector<std::string> texts;
  const auto note = [&](bool condition, std::string what) {
    if (condition) texts.push_back(std::move(what));
  };
  // Bullet makes none where the coefficient is 0; a rigid body's come together.
  const bool rolling = has_rolling_friction(scene), drilling = has_drilling_friction(scene);
  const bool together = settings.body == BodyKind::rigid;
  if (!is_solved_by_mlcp(settings)) {
    note(!rolling && !(together && drilling), "rolling rows (no rolling friction)");
    note(!drilling && !(together && rolling), "spinning rows (no drilling friction)");
  }
  note(leaves.line.has_value(), "second friction direction (all moves in one vertical plane)");
  note(leaves.sweeps, "sweep for CCD (no body has a threshold)");
  note(leaves.predictions, "orientations ahead of a step (bounding boxes of spheres need none)");
  note(leaves.broadphase, "broadphase (one body, and surfaces have no end)");
  if (leaves.most_pairs)
    note(true, fmt::format("memory for more contacts (there {} {} pair{})",
                           *leaves.most_pairs == 1 ? "is" : "are", *leaves.most_pairs,
                           *leaves.most_pairs == 1 ? "" : "s"));
  return texts;
}

}  // namespace slipcheck::bullet
