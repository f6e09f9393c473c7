#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/engine.h"
#include "peer_backends/dart/dart_settings.h"
#include "peer_backends/shared/world_engine.h"

namespace slipcheck::dart_engine {

/// One DART world: the scene's spheres on a plane. It counts lengths in units of its own.
class DartWorld {
 public:
  using Chosen = DartSettings;
  static constexpr bool kShowsParts = true;
  using DartSetup = peer::Setup<Chosen>;

  static EngineInfo info();
  static Chosen read(const Settings& chosen) { return read_settings(chosen); }
  static std::string refusal(const DartSetup& setup);
  static std::vector<Lack> lacks(const DartSetup& setup);

  /// The states are those at `time` [s]. `setup` has to outlive this.
  DartWorld(const DartSetup& setup, std::span<const BodyState> states, double time);
  ~DartWorld();

  void step();
  void forget_touches();
  void look(Frame& frame) const;
  Settings applied() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace slipcheck::dart_engine
