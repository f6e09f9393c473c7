#pragma once

#include <cstddef>
#include <vector>

#include "physics/frame.h"
#include "scene/scene.h"

namespace slipcheck {

/// What the collisions of a gas on a substrate come to over a stretch of time.
struct GasWindow {
  double time = 0;             ///< mean of the collisions' times [s]
  std::size_t collisions = 0;  ///< that the averages are over
  double restitution = 0;      ///< Σ g'/Σ g right after the collisions [-]
  double effective = 0;  ///< Σ g'/Σ g when sliding ends or one of the two collides again [-]
  double isolated = 0;   ///< the same if nothing ever interrupted the sliding [-]
  double effective_error = 0;   ///< standard error of `effective`
  double sliding_distance = 0;  ///< s, mean over the bodies, if nothing interrupted it [m]
  double free_path = 0;         ///< l, mean way of a body between two collisions [m]
  double uninterrupted = 0;     ///< share of collisions after which both bodies ceased to slide
};

/// K's conjecture, measured: follows each collision of a gas of spheres until neither body slides,
/// or one of them collides again, and compares the pair's relative velocity along the line of
/// centres then, g', with that before the collision, g.
///
/// For frames of EventSolver on a level, still substrate without rolling friction, where a body
/// left alone slides for t^s = |u^f|/((1+A) μ_k g), ends with v^s = v^f − u^f/(1+A) and is
/// displaced by (v^f + v^s) t^s/2 (closed_forms.h).
class GasRestitution final : public FrameSink {
 public:
  /// Averages over so many collisions each, > 0; slip below `resting_slip` [m/s] counts as none.
  /// `scene` must outlive this.
  GasRestitution(const Scene& scene, std::size_t collisions_in_window, double resting_slip);

  void take(double time, const Frame& frame) override;

  /// The windows that are full, collisions that have not ended left out.
  std::vector<GasWindow> windows() const;

 private:
  /// One collision that is followed.
  struct Followed {
    double time = 0;
    std::size_t first = 0, second = 0;
    Vector3 n = Vector3::Zero();                 ///< from the second to the first
    double before = 0, after = 0, isolated = 0;  ///< relative velocity along n [m/s]
    double end = 0;
    double sliding_distance = 0, free_path = 0;  ///< mean of both bodies [m]
    bool interrupted = false, ended = false;
  };

  bool slides(const Frame& frame, std::size_t i) const;
  void start(double time, const Frame& frame, const Touch& touch);
  void end(Followed& collision, const Frame& frame, bool interrupted);

  const Scene* scene_;
  std::size_t window_;
  double resting_slip_;
  Frame before_;
  std::vector<double> way_;             ///< of each body since its last collision [m]
  std::vector<std::size_t> following_;  ///< of each body, its collision; kNone
  std::vector<std::size_t> open_;       ///< collisions that have not ended
  std::vector<Followed> collisions_;
};

}  // namespace slipcheck
