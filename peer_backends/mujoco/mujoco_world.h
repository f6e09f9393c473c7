#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/engine.h"
#include "peer_backends/mujoco/mujoco_settings.h"
#include "peer_backends/shared/world_engine.h"

namespace slipcheck::mujoco {

/// One MuJoCo model with its data: the scene's spheres on a plane, or in a box, where they stay in
/// the plane y = 0 and spin about y alone. SI.
class MujocoWorld {
 public:
  using Chosen = MujocoSettings;
  static constexpr bool kShowsParts = false;

  static EngineInfo info();
  static Chosen read(const Settings& chosen) { return read_settings(chosen); }
  static std::string refusal(const peer::Setup<Chosen>& setup);
  static std::vector<Lack> lacks(const peer::Setup<Chosen>& setup);

  /// The states are those at `time` [s]. `setup` has to outlive this.
  MujocoWorld(const peer::Setup<Chosen>& setup, std::span<const BodyState> states, double time);
  ~MujocoWorld();

  void step();
  void forget_touches();
  void look(Frame& frame) const;
  Settings applied() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace slipcheck::mujoco
