#include "peer_backends/mujoco/mujoco_world.h"

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <array>
#include <stdexcept>

#include "engine/scene_needs.h"
#include "peer_backends/mujoco/mujoco_model.h"
#include "peer_backends/shared/applied.h"
#include "peer_backends/shared/surfaces.h"
#include "peer_backends/shared/touch_list.h"

namespace slipcheck::mujoco {
namespace {

/// Every two bodies are a pair of their own.
constexpr std::size_t kMostBodies = 300;

[[noreturn]] void throw_error(const char* message) { throw std::runtime_error(message); }

/// MuJoCo would write a file of its own; what matters is looked at after the step.
void pass_over(const char*) {}

/// A state that is not finite or beyond 1e10 makes MuJoCo start anew, without a word.
bool started_anew(const mjData& data) {
  for (const int kind : {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC})
    if (data.warning[kind].number > 0) return true;
  return false;
}

}  // namespace

struct MujocoWorld::Parts {
  Parts(const MujocoSetup& made, std::span<const BodyState> states, double time)
      : setup(made),
        time_step(made.time_step / made.settings.substeps),
        start_time(time),
        surfaces(peer::surfaces_of(setup.scene)),
        touches(setup.scene.box.has_value()) {
    mju_user_error = &throw_error;
    mju_user_warning = &pass_over;
    model = compile(mjcf(setup, states));
    data.reset(mj_makeData(model.get()));
    for (std::size_t i = 0; i < states.size(); ++i) set_velocity(states[i], i);
    find_geoms();
    for (std::size_t k = 0; k < setup.scene.surfaces.size(); ++k)
      if (const int joint = mj_name2id(model.get(), mjOBJ_JOINT, beside_name(k).c_str());
          joint >= 0)
        driven.push_back({k, model->jnt_qposadr[joint], model->jnt_dofadr[joint]});
    if (surfaces.empty() || !surfaces.front().moves) return;
    for (const char* axis : {"x", "y", "z"}) {
      const int joint = mj_name2id(model.get(), mjOBJ_JOINT, fmt::format("stage_{}", axis).c_str());
      if (joint >= 0)
        stage.push_back({model->jnt_qposadr[joint], model->jnt_dofadr[joint], axis[0] - 'x'});
    }
  }

  void set_velocity(const BodyState& state, std::size_t i) {
    const int joint = mj_name2id(model.get(), mjOBJ_JOINT, ball_name(i).c_str());
    places.push_back({model->jnt_qposadr[joint], model->jnt_dofadr[joint]});
    mjtNum* v = data->qvel + places.back().velocity;
    if (setup.scene.box) {
      v[0] = state.velocity.x();
      v[1] = state.velocity.z();
      v[2] = state.angular_velocity.y();
      origins.push_back(state.position);
      return;
    }
    for (int k = 0; k < 3; ++k) {
      v[k] = state.velocity[k];
      v[3 + k] = state.angular_velocity[k];  // in the body's axes, which are the world's so far
    }
  }

  void find_geoms() {
    owners.assign(static_cast<std::size_t>(model->ngeom), peer::kFloor);
    const auto at = [&](const std::string& name) -> int& {
      const int geom = mj_name2id(model.get(), mjOBJ_GEOM, name.c_str());
      return owners[static_cast<std::size_t>(geom)];
    };
    for (std::size_t i = 0; i < places.size(); ++i) at(ball_name(i)) = static_cast<int>(i);
    for (std::size_t k = 0; k < surfaces.size(); ++k) at(surface_name(k)) = surfaces[k].index;
    for (std::size_t k = 0; k < setup.scene.surfaces.size(); ++k)
      at(beside_name(k)) = surface_touch(k);
  }

  BodyState state(std::size_t i) const {
    const mjtNum* q = data->qpos + places[i].position;
    const mjtNum* v = data->qvel + places[i].velocity;
    if (setup.scene.box)
      return {origins[i] + Vector3(q[0], 0, q[1]), {v[0], 0, v[1]}, {0, v[2], 0}};
    mjtNum turned[3];
    mju_rotVecQuat(turned, v + 3, q + 3);
    return {{q[0], q[1], q[2]}, {v[0], v[1], v[2]}, {turned[0], turned[1], turned[2]}};
  }

  /// Surfaces that move have their velocity now, and the acceleration that gives them the one at
  /// the end of the step.
  void move_stage() {
    if (stage.empty()) return;
    const Scene& scene = setup.scene;
    const double now = start_time + static_cast<double>(steps) * time_step;
    const peer::Surface& surface = surfaces.front();
    const Vector3 place = surface.displacement(scene, now), velocity = surface.velocity(scene, now);
    const Vector3 change = surface.velocity(scene, now + time_step) - velocity;
    const Vector3 gravity(scene.downhill.x(), scene.downhill.y(), -scene.gravity);
    for (const Slide& slide : stage) {
      data->qpos[slide.position] = place[slide.axis];
      data->qvel[slide.velocity] = velocity[slide.axis];
      data->qfrc_applied[slide.velocity] =
          stage_mass(scene) * (change[slide.axis] / time_step - gravity[slide.axis]);
    }
  }

  /// Likewise; a belt begins each step where it is.
  void move_beside() {
    const double now = start_time + static_cast<double>(steps) * time_step;
    for (const Driven& each : driven) {
      const slipcheck::Surface& surface = setup.scene.surfaces[each.surface];
      const peer::SurfaceFrame frame = frame_beside(surface, now);
      const Eigen::Quaterniond turn = frame.turn();
      const Vector3 velocity = surface.motion.velocity(now, frame.centre);
      const Vector3 then =
          surface.motion.velocity(now + time_step, frame_beside(surface, now + time_step).centre);
      const Vector3 force =
          stage_mass(setup.scene) * ((then - velocity) / time_step - setup.scene.gravity_vector());
      const Vector3 rate = frame.axes.transpose() * surface.motion.rate();  // along its own axes
      const std::array<double, 4> q = {turn.w(), turn.x(), turn.y(), turn.z()};
      for (int k = 0; k < 3; ++k) {
        data->qpos[each.position + k] = frame.centre[k];
        data->qvel[each.velocity + k] = velocity[k];
        data->qvel[each.velocity + 3 + k] = rate[k];
        data->qfrc_applied[each.velocity + k] = force[k];
      }
      for (int k = 0; k < 4; ++k)
        data->qpos[each.position + 3 + k] = q[static_cast<std::size_t>(k)];
    }
  }

  void step() {
    move_stage();
    move_beside();
    mj_step(model.get(), data.get());
    if (started_anew(*data))
      throw std::runtime_error("mujoco: a state that is not finite or beyond 1e10: it starts anew");
    ++steps;
    for (int k = 0; k < data->ncon; ++k) {
      const mjContact& contact = data->contact[k];
      if (contact.efc_address < 0) continue;
      mjtNum force[6];
      mj_contactForce(model.get(), data.get(), k, force);
      touches.add(owners[static_cast<std::size_t>(contact.geom1)],
                  owners[static_cast<std::size_t>(contact.geom2)], force[0] * time_step);
    }
  }

  struct Place {
    int position, velocity;  // in qpos and qvel
  };
  struct Slide {
    int position, velocity, axis;
  };
  struct Driven {
    std::size_t surface;
    int position, velocity;
  };

  const MujocoSetup& setup;
  double time_step, start_time;  // of MuJoCo's own [s]
  std::size_t steps = 0;
  std::vector<peer::Surface> surfaces;
  Model model;
  Data data;
  std::vector<Place> places;
  std::vector<Vector3> origins;  // of bodies in a box, from which their slides count
  std::vector<int> owners;       // of geoms
  std::vector<Slide> stage;      // what moves, where something does
  std::vector<Driven> driven;    // what moves of the surfaces beside the substrate
  peer::TouchList touches;
};

EngineInfo MujocoWorld::info() {
  return {"mujoco",
          mj_versionString(),
          "double",
          setting_table(),
          {scene_part::kBlock, scene_part::kCylinder, scene_part::kSurfaces}};
}

std::string MujocoWorld::refusal(const MujocoSetup& setup) {
  if (setup.scene.bodies.size() > kMostBodies)
    return fmt::format("every two bodies are a pair with numbers of its own, for up to {} bodies",
                       kMostBodies);
  return "";
}

std::vector<Lack> MujocoWorld::lacks(const MujocoSetup& setup) {
  const SceneNeeds needs = needs_of(setup.scene, setup.time_step);
  const MujocoSettings& chosen = setup.settings;
  const bool fields = chosen.coefficients == CoefficientMap::fields;
  const bool pyramid = chosen.cone == Cone::pyramidal;
  const auto without = [&](int condim) { return chosen.condim > 0 && chosen.condim < condim; };
  LackList missing;
  missing.note(needs.static_friction, lack::kStaticFriction,
               "one coefficient for sticking and sliding");
  missing.note(needs.friction && without(3), "friction", "condim leaves it out");
  missing.note(needs.friction && pyramid, lack::kFrictionHeadings,
               "a pyramid, weaker on its faces");
  missing.note(needs.drilling && without(4), lack::kDrilling, "condim leaves it out");
  missing.note(needs.rolling && without(6), lack::kRolling, "condim leaves it out");
  missing.note(needs.coupled_drilling, lack::kCoupledDrilling, "one cone of friction and torque");
  missing.note(needs.rolling_only && !without(6), lack::kRollingOnly, "it acts while sliding too");
  missing.note(needs.rolling && pyramid && !without(6), lack::kRollingHeadings,
               "a pyramid, which shares it with the friction");
  missing.note(needs.bounce && chosen.restitution == RestitutionMap::none, lack::kRestitution,
               "contacts are dampers, all with one solref");
  missing.note(needs.reversed_slip, lack::kTangentialRestitution, "friction only stops the slip");
  missing.note(setup.scene.confined, lack::kConfinement);
  missing.note(needs.far_in_a_step, lack::kPassing);
  missing.note(needs.through_in_a_step, lack::kThrough);
  missing.note(needs.rolling && fields && !without(6), lack::kRolling,
               "mu_r in the place of a length");
  missing.note(needs.rolling_table, lack::kRollingTable);
  missing.note(needs.bounce_law && chosen.restitution == RestitutionMap::spring,
               lack::kRestitutionLaw);
  return missing.take();
}

MujocoWorld::MujocoWorld(const MujocoSetup& setup, std::span<const BodyState> states, double time)
    : parts_(std::make_unique<Parts>(setup, states, time)) {}

MujocoWorld::~MujocoWorld() = default;

void MujocoWorld::step() { parts_->step(); }

void MujocoWorld::forget_touches() { parts_->touches.clear(); }

void MujocoWorld::look(Frame& frame) const {
  frame.bodies.clear();
  for (std::size_t i = 0; i < parts_->places.size(); ++i) frame.bodies.push_back(parts_->state(i));
  parts_->touches.write(frame.touches);
}

Settings MujocoWorld::applied() const {
  const Parts& parts = *parts_;
  Settings settings = write_settings(parts.setup.settings);
  settings["iterations"] = double(parts.model->opt.iterations);
  settings["impratio"] = parts.model->opt.impratio;
  peer::add_world(settings, parts.setup.scene, parts.time_step);
  peer::add_coefficients(settings, parts.setup.scene, peer::SlipRule::ignored,
                         [&](int body, int other) { return values_of(parts.setup, body, other); });
  return settings;
}

}  // namespace slipcheck::mujoco
