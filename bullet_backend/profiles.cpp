#include "bullet_backend/profiles.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "bullet_backend/coefficients.h"
#include "engine/engine.h"

namespace slipcheck::bullet {
namespace {

const std::map<std::string, Profile>& profiles() {
  static const std::map<std::string, Profile> by_name = {
      {"default", Profile::default_},
      {"naive", Profile::naive},
  };
  return by_name;
}

bool depends_on_speed(const PairContact& pair) {
  return !std::holds_alternative<double>(pair.restitution);
}

bool bounces(const PairContact& pair) {
  return depends_on_speed(pair) || std::get<double>(pair.restitution) > 0;
}

/// Slip is neither kept (β0 = −1) nor just stopped (β0 = 0): Bullet's friction can only stop it.
bool reverses_slip(const PairContact& pair) {
  const double beta0 = pair.tangential_restitution;
  return pair.friction > 0 && beta0 != 0 && beta0 != -1;
}

/// What the scene's bodies need of the engine, each found on any of them.
struct Needs {
  bool static_friction = false, drilling = false, coupled_drilling = false;
  bool rolling = false, rolling_table = false, rolling_only = false;
  bool bounce = false, bounce_law = false, reversed_slip = false, cut_torque = false;
  bool moving_floor = false, far_in_a_step = false;

  void add(const PairContact& pair) {
    bounce |= bounces(pair);
    bounce_law |= depends_on_speed(pair);
    reversed_slip |= reverses_slip(pair);
  }
};

/// Whether a body may go further than its radius in a step, so that it can be on the far side of
/// another before Bullet looks again: by its speed at the start, after a fall to the floor, or on
/// being hit by the floor.
bool can_pass_in_a_step(const HardScene& scene, double time_step) {
  const double floor_speed = scene.box->floor.largest_speed();
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const BodyState& start = scene.initial[i];
    const double fall = std::max(0.0, 2 * scene.gravity * start.position.z());
    const double speed = std::max(floor_speed, std::sqrt(start.velocity.squaredNorm() + fall));
    if (speed * time_step > scene.bodies[i].radius) return true;
  }
  return false;
}

void add_box(Needs& needs, const HardScene& scene, double time_step) {
  const Box& box = *scene.box;
  for (const std::size_t material : scene.material) {
    needs.add(box.on_floor[material]);
    needs.add(box.on_wall[material]);
    if (box.lid) needs.add(box.on_lid[material]);
  }
  needs.moving_floor = !box.floor.is_still();
  needs.far_in_a_step = can_pass_in_a_step(scene, time_step);
}

void add_substrate(Needs& needs, const HardScene& scene, double time_step) {
  const PairCoefficients coefficients(scene, time_step);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const SubstrateContact& ground = scene.on_substrate(i);
    needs.static_friction |= ground.static_friction != ground.kinetic_friction;
    needs.rolling |= !ground.rolling.is_zero();
    needs.rolling_only |= !ground.rolling.is_zero() && !ground.rolling_while_sliding;
    needs.rolling_table |= !ground.rolling.is_constant();
    needs.drilling |= ground.drilling_length > 0;
    needs.coupled_drilling |= ground.coupled_radius > 0;
    needs.bounce |= ground.restitution > 0;
    needs.cut_torque |= coefficients.is_cut(static_cast<int>(i)) &&
                        (!ground.rolling.is_zero() || ground.drilling_length > 0);
  }
}

Needs needs_of(const HardScene& scene, double time_step) {
  Needs needs;
  if (scene.box) {
    add_box(needs, scene, time_step);
  } else {
    add_substrate(needs, scene, time_step);
  }
  for (const auto& [i, j] : material_pairs(scene)) needs.add(scene.between(i, j));
  return needs;
}

}  // namespace

std::vector<std::string> profile_names() {
  std::vector<std::string> names;
  for (const auto& [name, profile] : profiles()) names.push_back(name);
  return names;
}

Profile parse_profile(const std::string& name) {
  const auto found = profiles().find(name);
  if (found != profiles().end()) return found->second;
  const auto contract_names = {"physical", "tuned", "fast"};
  const bool is_in_contract =
      std::find(contract_names.begin(), contract_names.end(), name) != contract_names.end();
  throw Refused(fmt::format("bullet has no profile '{}'{}; it has: {}", name,
                            is_in_contract ? " yet" : "", fmt::join(profile_names(), ", ")));
}

std::vector<std::string> not_represented(const HardScene& scene, Profile profile,
                                         double time_step) {
  const Needs needs = needs_of(scene, time_step);
  const bool naive = profile == Profile::naive;
  std::vector<std::string> missing;
  const auto note = [&](bool condition, const char* what) {
    if (condition) missing.emplace_back(what);
  };
  note(needs.static_friction, "static friction (one coefficient for sticking and sliding)");
  note(needs.coupled_drilling, "coupled drilling (torque and friction are full, each by itself)");
  note(needs.rolling_only, "rolling friction only while rolling (it acts while sliding too)");
  note(needs.rolling, "rolling friction alike in all headings (up to 1.41 times on diagonals)");
  note(needs.bounce, "restitution below 0.2 m/s of approach");
  note(needs.reversed_slip, "tangential restitution (friction only stops the slip)");
  note(scene.confined, "confinement to the plane");
  note(needs.moving_floor,
       "the floor's velocity at the contact (it is the mean over the step before)");
  note(needs.far_in_a_step, "collisions of bodies that pass each other within a step");
  note(needs.rolling_table && naive, "rolling friction that depends on the speed");
  note(needs.bounce_law && naive, "restitution that depends on the impact speed");
  note(needs.cut_torque && naive, "rolling and drilling torque of normal impulses above 1 N s");
  note(needs.cut_torque && !naive, "rolling and drilling torque of a load other than the weight");
  return missing;
}

}  // namespace slipcheck::bullet
