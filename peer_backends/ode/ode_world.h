#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/engine.h"
#include "peer_backends/ode/ode_settings.h"
#include "peer_backends/shared/world_engine.h"

namespace slipcheck::ode {

/// One ODE world: the scene's spheres on a plane, or in a box, where they stay in the plane y = 0,
/// because nothing ever pushes them out of it: every term of a row across it is exactly 0. SI.
class OdeWorld {
 public:
  using Chosen = OdeSettings;
  static constexpr bool kShowsParts = true;
  using OdeSetup = peer::Setup<Chosen>;

  static EngineInfo info();
  static Chosen read(const Settings& chosen) { return read_settings(chosen); }
  static std::string refusal(const OdeSetup& setup);
  static std::vector<Lack> lacks(const OdeSetup& setup);

  /// The states are those at `time` [s]. `setup` has to outlive this.
  OdeWorld(const OdeSetup& setup, std::span<const BodyState> states, double time);
  ~OdeWorld();

  void step();
  void forget_touches();
  void look(Frame& frame) const;
  Settings applied() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace slipcheck::ode
