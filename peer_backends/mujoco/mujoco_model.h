#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <string>

#include "peer_backends/mujoco/mujoco_settings.h"
#include "peer_backends/shared/contact_values.h"
#include "peer_backends/shared/surface_frame.h"
#include "peer_backends/shared/world_engine.h"

namespace slipcheck::mujoco {

using MujocoSetup = peer::Setup<MujocoSettings>;

struct FreeModel {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
using Model = std::unique_ptr<mjModel, FreeModel>;
struct FreeData {
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using Data = std::unique_ptr<mjData, FreeData>;

/// Names of joints and geoms: "ball3", "surface0", "stage_x", "stage_y", "stage_z", and "beside0"
/// of what stands beside the substrate.
std::string ball_name(std::size_t body);
std::string surface_name(std::size_t surface);
std::string beside_name(std::size_t surface);

/// Of the geom of a surface beside the substrate: where it moves or passes by, a plane is a box
/// behind its face.
peer::SurfaceFrame frame_beside(const slipcheck::Surface& surface, double time);

/// The numbers of a contact as MuJoCo has them, lengths as such.
peer::ContactValues values_of(const MujocoSetup& setup, int body, int other);

/// Mass of what surfaces that move are fixed to [kg]: so heavy that no body moves it.
double stage_mass(const Scene& scene);

/// The scene as MJCF. Balls have free joints, or in a box slides along x and z and a hinge about
/// y; every two that can touch are a pair with numbers of their own. What moves is a box on slides,
/// as planes cannot move; a surface beside the substrate that moves or passes by, a free body.
std::string mjcf(const MujocoSetup& setup, std::span<const BodyState> states);

/// Throws Refused with MuJoCo's reason where it does not compile.
Model compile(const std::string& mjcf);

}  // namespace slipcheck::mujoco
