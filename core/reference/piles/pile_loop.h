#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/state_archive.h"
#include "base/thread_team.h"
#include "physics/frame.h"
#include "reference/piles/pile_body.h"
#include "reference/piles/pile_law.h"

namespace slipcheck {

/// What the loop runs, at the instant n.
struct PileWorld {
  const ContactScene* scene = nullptr;
  const PileLaws* laws = nullptr;
  double step = 0;                    ///< h [s], > 0
  std::uint64_t n = 0;                ///< steps since time 0
  bool started = false;               ///< velocities lie half a step before the positions
  Vector3 gravity = Vector3::Zero();  ///< [m/s²]
  double drag = 0;                    ///< rate at which all motion dies out [1/s], >= 0
  bool dilates = false;               ///< hard contacts that slide press themselves open, below
  /// Somebody asks for touches: what has ended is kept until then.
  bool watched = false;
  ThreadTeam* team = nullptr;  ///< null: this thread alone
  /// In an order of the loop's own, in which neighbours are near in memory; and of each scene's
  /// body its place among them. add() keeps both.
  PileBodies bodies;
  std::vector<std::uint32_t> place;
  PileLedger ledger;
  std::size_t collisions = 0;  ///< contacts of two bodies that have begun
  bool slid = false;           ///< a contact slid, since somebody looked

  /// So many steps from now [s].
  double time(std::size_t later = 0) const { return static_cast<double>(n + later) * step; }
  PileBody& add() {
    place.push_back(static_cast<std::uint32_t>(bodies.size()));
    return bodies.emplace_back();
  }
  PileBody& body(std::size_t i) { return bodies[place[i]]; }
  const PileBody& body(std::size_t i) const { return bodies[place[i]]; }
  /// A body at the time of the positions, once its forces are known.
  BodyState state(std::size_t i) const {
    const PileBody& b = body(i);
    const double half = started ? 0.5 * step : 0;
    return {b.position, b.velocity + half * (b.force / b.mass + b.load * gravity),
            b.angular_velocity + half / b.inertia * b.torque};
  }
};

/// Velocity Verlet with contacts that remember, for one kind of scene:
///   x_{n+1} = x_n + h v_{n+1/2},  v_{n+1/2} = v_{n−1/2} + (h/m) F(x_n, ṽ_n),
///   ṽ_n = v_{n−1/2} + ½ (v_{n−1/2} − v_{n−3/2}).
/// What a contact remembers goes on by h times the slip half a step before, seen along the mean of
/// the directions at both ends. A contact that begins or ends within a step has the impulse of its
/// part of the step by the trapezoidal rule. So all is of second order, but for where it changes
/// within a step to slide with less friction than held it, which is then known to a step.
///
/// Where contacts dilate, one that is cut back by s also gets an offset μ s: an associated law, by
/// which a pile under growing weights comes to an equilibrium whenever there is one (the limit
/// theorems of plasticity; Drucker, Q. Appl. Math. 11, 381 (1954), on why Coulomb's law itself need
/// not). What it then remembers is within the caps of Coulomb's law, which holds it from there on.
///
/// Many bodies are kept in the order of where they are, and what is near each other is shared out
/// into slabs (PileSlabs), which several threads take: the same bits on any number of them.
///
/// The ledger counts for each contact what its dashpots, its sliding springs and the springs that
/// it drops take, each as force times way by the trapezoidal rule.
class PileLoop {
 public:
  virtual ~PileLoop() = default;
  /// The forces of now. Throws StepTooLong where bodies are deeper in each other than meant, or
  /// their speed is no number.
  virtual void find_forces(PileWorld& world) = 0;
  virtual void advance(PileWorld& world, std::size_t steps) = 0;
  /// What has touched since this was asked before, with its impulses.
  virtual void take_touches(std::vector<Touch>& touches) = 0;
  /// Normal impulses go on as they are for so long [s], with nothing else.
  virtual void wait(double time) = 0;
  virtual double elastic_energy() const = 0;  ///< of all springs, now [J]
  virtual bool bodies_touch() const = 0;      ///< a body touches another one, or a surface
  /// All of so many bodies touch the substrate and do not slide on it.
  virtual bool rolls_on_substrate(std::size_t bodies) const = 0;
  virtual std::vector<std::string> features() const = 0;
  /// What it goes on with, beside the world.
  virtual void exchange(StateArchive& archive) = 0;
};

/// The loop without what the scene lacks; `general`: with all there is. Both must outlive it.
/// ordered_from: as of PileSlabs.
std::unique_ptr<PileLoop> make_pile_loop(const PileLaws& laws, const ContactScene& scene,
                                         bool general, std::size_t ordered_from);

}  // namespace slipcheck
