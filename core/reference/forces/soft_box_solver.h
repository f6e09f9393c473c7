#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "physics/frame.h"
#include "reference/solver.h"
#include "scene/contact_scene.h"

namespace slipcheck {

struct SoftBoxSettings {
  /// Steps in which a contact is resolved [-], >= 10. With 25 the restitution is right to 1e-5 for
  /// spring and dashpot, and the error falls with the fourth power; laws that begin like a root of
  /// the time get shorter steps at both ends of a contact and are right to 5e-5.
  double steps_per_contact = 25;
  std::size_t max_steps = 2'000'000'000;
};

/// L's vibrated box with contacts that last: the forces of ContactScene between spheres and with
/// the floor, walls and lid (ContactScene::soft_box).
///
/// Bodies that touch nothing fly on exact parabolas. Those that touch are integrated together by
/// the classical Runge-Kutta scheme of fourth order, whose step is a fraction of the shortest
/// contact; steps end where a contact begins or ends, where its force ceases to push
/// (ContactEnd::zero_force) or an asperity breaks, and at the corners of the tangential laws, so
/// that no force jumps within one. A step costs O(N) at most, and where few bodies touch, as in a
/// dilute box, what it costs is those few.
class SoftBoxSolver final : public Solver {
 public:
  /// The scene must outlive the solver; the bodies move in the plane y = 0 and spin about y. Throws
  /// Unsupported, which says where, if the scene has no box or a contact in it is hard.
  SoftBoxSolver(const ContactScene& scene, std::span<const BodyState> initial,
                const SoftBoxSettings& settings = {});
  ~SoftBoxSolver() override;
  SoftBoxSolver(SoftBoxSolver&&) noexcept;

  /// Throws Unsupported for Run::Until::rolling and rest. Shows `sink`, where given, the states
  /// now, at each multiple of end.sample_interval, and at the end. Frames name no touches. What is
  /// shown does not change the run. The run counts from time 0; its steps are those of bodies that
  /// touch something.
  SolvedRun run(const RunEnd& end, FrameSink* sink) override;

  std::vector<BodyState> states() const override;
  double now() const override;
  std::vector<std::string> features() const override {
    return {"free flight, and steps for bodies that touch"};
  }
  std::size_t body_steps() const;  ///< steps so far times the bodies that took part
  /// Kinetic energy and that of gravity and of the overlaps, now [J].
  double energy() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace slipcheck
