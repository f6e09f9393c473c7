#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "physics/frame.h"
#include "reference/run_end.h"
#include "scene/contact_scene.h"

namespace slipcheck {

struct SoftBoxSettings {
  /// Steps in which a contact is resolved [-], >= 10. With 25 the restitution is right to 1e-5 for
  /// spring and dashpot, and the error falls with the fourth power; laws that begin like a root of
  /// the time get shorter steps at both ends of a contact and are right to 5e-5.
  double steps_per_contact = 25;
  std::size_t max_steps = 2'000'000'000;
};

struct SoftBoxRun {
  double end_time = 0;         ///< [s]
  bool reached = false;        ///< the time that was asked for
  std::string reason;          ///< why not
  std::size_t steps = 0;       ///< of bodies that touch something, since time 0
  std::size_t body_steps = 0;  ///< these times the bodies that took part
  std::size_t collisions = 0;  ///< contacts of two bodies that began
  std::size_t bounces = 0;     ///< contacts with floor, walls and lid that began
  double work = 0;             ///< of floor, walls and lid on the bodies [J]
  double dissipated = 0;       ///< what the contacts took and did not store in their overlap [J]
  /// E − E(0) − work + dissipated over the largest of these four; 0 but for errors.
  double energy_error = 0;
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
class SoftBoxSolver {
 public:
  /// The scene must outlive the solver; the bodies move in the plane y = 0 and spin about y. Throws
  /// Unsupported, which says where, if the scene has no box or a contact in it is hard.
  SoftBoxSolver(const ContactScene& scene, std::span<const BodyState> initial,
                const SoftBoxSettings& settings = {});
  ~SoftBoxSolver();
  SoftBoxSolver(SoftBoxSolver&&) noexcept;

  /// Runs from time 0, or from now when called again, to the time `end` asks for; throws
  /// Unsupported for Run::Until::rolling and rest. Shows `sink`, where given, the states now, at
  /// each multiple of sample_interval [s], > 0, or none where it is 0, and at the end. Frames name
  /// no touches. What is shown does not change the run.
  SoftBoxRun run(const RunEnd& end, FrameSink* sink, double sample_interval = 0);

  /// All bodies' states now.
  std::vector<BodyState> states() const;
  double now() const;              ///< [s]
  std::size_t collisions() const;  ///< contacts of two bodies that have begun
  /// Kinetic energy and that of gravity and of the overlaps, now [J].
  double energy() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace slipcheck
