#include "reference/steps/grain_solver.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "base/stop_scope.h"
#include "base/thread_team.h"
#include "physics/numbers.h"
#include "reference/steps/grain_blocks.h"
#include "reference/steps/grain_contacts.h"
#include "reference/steps/grain_drive.h"
#include "reference/steps/grain_islands.h"
#include "reference/steps/grain_kernels.h"
#include "reference/steps/grain_look.h"
#include "reference/steps/grain_meetings.h"
#include "reference/steps/grain_neighbours.h"
#include "reference/steps/grain_order.h"
#include "reference/steps/grain_runs.h"
#include "reference/steps/grain_scene.h"
#include "reference/steps/step_solver.h"

namespace slipcheck {
namespace {

double folded(double x, double length, std::int32_t& cell) {
  if (!(length > 0) || (x >= 0 && x < length)) return x;
  const double turns = std::floor(x / length);
  cell += static_cast<std::int32_t>(turns);
  return x - turns * length;
}

}  // namespace

class GrainSolver::Impl {
 public:
  Impl(const ContactScene& scene, std::span<const BodyState> initial, double step,
       std::size_t threads, double slowest_rebound)
      : step_(step),
        kernels_(grain_kernels(scene, initial, std::max(slowest_rebound, scene.hard.gravity * step),
                               grains_.kind)),
        drive_(scene.hard, initial, step),
        contacts_(kernels_, scene.hard.substrate.size()),
        team_(threads) {
    assert(step > 0 && initial.size() == scene.hard.bodies.size());
    const std::size_t n = initial.size();
    std::vector<std::uint32_t> kind = std::move(grains_.kind);
    grains_.resize(n);
    grains_.kind = std::move(kind);
    places_.cell_x.assign(n, 0);
    places_.cell_y.assign(n, 0);
    GrainSpeeds fastest;
    places_.body.reserve(n);
    if (features().is_uneven())
      for (const std::uint32_t k : grains_.kind)
        grains_.radius.push_back(kernels_.kinds()[k].radius);
    if (features().lifts)
      grains_.for_each_lifted([n](std::vector<double>& values) { values.resize(n); });
    for (std::size_t i = 0; i < n; ++i) {
      const BodyState& state = initial[i];
      places_.body.push_back(static_cast<std::uint32_t>(i));
      grains_.x[i] = state.position.x();
      grains_.y[i] = state.position.y();
      grains_.vx[i] = state.velocity.x();
      grains_.vy[i] = state.velocity.y();
      grains_.wx[i] = state.angular_velocity.x();
      grains_.wy[i] = state.angular_velocity.y();
      grains_.wz[i] = state.angular_velocity.z();
      const double R = scene.hard.bodies[i].radius;
      const double round_off = 16 * kEpsilon *
                               (state.velocity.norm() + drive_.velocity_of(0).norm() +
                                R * state.angular_velocity.norm());
      grains_.sticks[i] = drive_.slip(state, i).norm() <= round_off ? 1 : 0;
      const Vector2 speed = state.velocity.head<2>() - drift_of(0);
      fastest.along2 = std::max(fastest.along2, speed.squaredNorm());
      if (features().lifts) fastest.across2 = std::max(fastest.across2, raise(i, state));
    }
    blocks_ = {step, braking_beside_drift(), landing(), features().driven};
    blocks_.set_fastest(fastest);
    find_neighbours(1);
  }

  void advance(std::size_t steps) {
    while (steps > 0) {
      heed_stop();
      if (!(blocks_.fastest() * step_ <= 0.5 * kernels_.plane().smallest))
        throw StepTooLong("bodies move by more than half a radius in a step");
      const std::size_t length = next_block(steps);
      if (length == 0) {
        find_neighbours(std::min(steps, GrainBlocks::kLongest));
        continue;
      }
      if (run_block(length)) {
        steps -= length;
        n_ += length;
      }
    }
  }

  void exchange(StateArchive& archive) {
    archive(grains_, places_.cell_x, places_.cell_y, places_.body, n_, collisions_, blocks_,
            neighbours_, contacts_);
    contacts_.remember(neighbours_);
  }

  double now() const { return static_cast<double>(n_) * step_; }
  std::size_t steps() const { return n_; }
  std::size_t collisions() const { return collisions_; }
  std::size_t touching() const { return contacts_.size(); }
  const GrainFeatures& features() const { return kernels_.features(); }

  bool all_stick(bool rests) const {
    const Vector2 plane = drive_.velocity_of(n_);
    for (std::size_t i = 0; i < grains_.size(); ++i) {
      const std::uint32_t body = places_.body[i];
      const double wx = grains_.wx[features().on_plane ? i : body];
      const double wy = grains_.wy[features().on_plane ? i : body];
      const double wz = grains_.wz[features().rubs ? i : body];
      const bool sticks = features().on_plane
                              ? grains_.sticks[i] > 0
                              : grains_.vx[i] == radius() * wy && grains_.vy[i] == -radius() * wx;
      if (!sticks) return false;
      if (rests && (grains_.vx[i] != plane.x() || grains_.vy[i] != plane.y() || wz != 0))
        return false;
    }
    return true;
  }

  void show(Frame& frame) {
    if (!blocks_.cover(1)) find_neighbours(1);
    if (features().driven) drive_.find_half(n_, driving_);
    runs_.forget();
    const GrainSteps half{step_, n_ > 0 ? 0.5 * step_ : 0, 1, false, n_ > 0, &driving_};
    GrainLook(kernels_, grains_, places_, neighbours_, contacts_, half)
        .show(blocks_.margin(1), islands_, team_, frame);
    islands_ = {};
  }

 private:
  double radius() const { return kernels_.plane().radius; }

  /// Walls are taken for planes up to their top.
  void require_below_walls(double height) const {
    for (const GrainWall& wall : kernels_.plane().walls)
      if (height > wall.top)
        throw StepTooLong("a body comes over a wall, which only the general loop follows");
  }

  /// Where the speeds of grains count from [m/s].
  Vector2 drift_of(std::size_t n) const {
    return features().driven ? drive_.drift_of(n) : Vector2::Zero();
  }

  /// The largest acceleration of a grain by friction of the plane [m/s²]: μ_k g, or μ_s g where
  /// that holds what the plane carries along, and that of rolling friction.
  double braking() const {
    double most = 0;
    if (features().on_plane)
      for (const GrainKind& kind : kernels_.kinds()) {
        const double held_by = features().driven ? kind.static_friction : 0;
        most = std::max(most, (std::max(held_by, kind.kinetic_friction) + kind.rolling_friction) *
                                  kind.weight * kind.inverse_mass);
      }
    return most;
  }

  /// What blocks reckon with: beside the drift, and with landings, of which several may follow each
  /// other. In a time t the substrate gives a grain no more than m (2 |v_z| + 3 g t).
  double braking_beside_drift() const {
    return (features().driven ? drive_.most(braking()) : braking()) +
           1.5 * landing() * kernels_.plane().gravity;
  }

  /// 2 μ, by which a landing changes the speed along the plane for the one towards it at most; of
  /// sliding or, once a grain rolls, of rolling.
  double landing() const {
    double most = 0;
    if (features().lifts)
      for (const GrainKind& kind : kernels_.kinds())
        most = std::max({most, 2 * kind.kinetic_friction, 2 * kind.rolling_friction});
    return most;
  }

  /// Puts grain `i` at its height. Returns v_z² [m²/s²].
  double raise(std::size_t i, const BodyState& state) {
    const double R = grains_.radius[i], z = state.position.z(), vz = state.velocity.z();
    const bool flies = vz > 0 || z > R * (1 + 4 * kEpsilon);
    grains_.flies[i] = flies ? 1 : 0;
    grains_.z[i] = flies ? z : R;
    grains_.vz[i] = flies ? vz : 0;
    if (flies) grains_.sticks[i] = 0;
    return grains_.vz[i] * grains_.vz[i];
  }

  /// 0 where the list of neighbours no longer covers one step.
  std::size_t next_block(std::size_t steps) const {
    if (n_ == 0) return 1;  // its kick is half as long
    return blocks_.next(steps, grains_.size(), neighbours_.first().size(), contacts_.size());
  }

  void find_neighbours(std::size_t length) {
    blocks_.renew(length, 2 * kernels_.plane().mean, density());
    if (grains_.size() > kMany) runs_.forget();
    GrainArrays& g = grains_;
    team_.run_shares(g.size(), [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        g.x[i] = folded(g.x[i], kernels_.plane().length_x, places_.cell_x[i]);
        g.y[i] = folded(g.y[i], kernels_.plane().length_y, places_.cell_y[i]);
      }
    });
    reorder(neighbours_.sort(g, kernels_.plane(), 2 * radius() + blocks_.skin(), team_));
    neighbours_.find(g, kernels_.plane(), blocks_.skin(), team_);
    contacts_.find(neighbours_, team_);
  }

  /// ρ [1/m²] of a periodic plane, else that of grains side by side.
  double density() const {
    const GrainPlane& plane = kernels_.plane();
    const double area = plane.length_x * plane.length_y, d = 2 * plane.mean;
    return area > 0 ? static_cast<double>(grains_.size()) / area : 1 / (d * d);
  }

  void reorder(const std::vector<std::uint32_t>& order) {
    std::vector<GrainOrder::Quantity> all;
    grains_.for_each_changing(features(),
                              [&](std::vector<double>& values) { all.push_back(&values); });
    all.insert(all.end(), {&places_.cell_x, &places_.cell_y, &places_.body});
    if (features().is_uneven()) all.push_back(&grains_.radius);
    if (kernels_.kinds().size() > 1) all.push_back(&grains_.kind);
    order_.apply(order, all, team_);
    if (grains_.size() > kMany) order_.forget();
    contacts_.reorder(neighbours_, team_);
  }

  /// So many steps, or none where a grain got faster than foreseen.
  bool run_block(std::size_t length) {
    const GrainPairs listed = {neighbours_.first(), neighbours_.second()};
    const GrainMeetings meetings(kernels_, grains_, neighbours_, blocks_.margin(length),
                                 step_ * static_cast<double>(length), step_, braking(), landing());
    contacts_.find_hit(hit_);
    islands_.find(
        grains_.size(), listed, hit_,
        [&](std::size_t first, std::size_t last, GrainNear& found) {
          meetings.find(first, last, found);
        },
        team_);
    if (features().driven) drive_.find(n_, length, kernels_.kinds(), driving_);
    GrainRuns::Total all = runs_.run(grains_, contacts_, steps_of(length), team_);
    if (std::sqrt(all.fastest.along2) > blocks_.bound(length)) {
      all.fastest.add(blocks_.speeds());
      blocks_.set_fastest(all.fastest);
      return false;
    }
    all.fastest.add(end_block(length, all.touching));
    require_below_walls(all.fastest.height);
    collisions_ += all.begun;
    blocks_.took(length, islands_.grain_count(), all.touching, all.fastest);
    return true;
  }

  /// The next ones; the first kick of all is half as long.
  GrainSteps steps_of(std::size_t length) const {
    return {step_, n_ == 0 ? 0.5 * step_ : step_, length, true, n_ > 0, &driving_};
  }

  /// Grains that met none glide; the others, and contacts, get what came of them. Returns
  /// the speeds of those that glided.
  GrainSpeeds end_block(std::size_t length, std::size_t touching) {
    contacts_.renew(touching);
    // The first kick is half as long, and without friction there is none; of rolling friction on a
    // plane that carries grains along no sum is known.
    const bool alone = (n_ == 0 && features().on_plane) || (features().driven && features().rolls);
    std::vector<GrainSpeeds> gliding(team_.size());
    team_.run_shares(grains_.size(), [&](std::size_t own, std::size_t first, std::size_t last) {
      if (features().driven) runs_.let_roll(own, first, last, team_, grains_);
      gliding[own] = alone ? step_alone(first, last, length)
                           : kernels_.glide(grains_, first, last, steps_of(length));
      runs_.give_back(own, first, last, team_, grains_, contacts_);
    });
    runs_.give_back_parted(contacts_);
    GrainSpeeds fastest;
    for (const GrainSpeeds& each : gliding) fastest.add(each);
    return fastest;
  }

  /// Of grains that meet none, one by one.
  GrainSpeeds step_alone(std::size_t begin, std::size_t end, std::size_t length) {
    GrainArrays after;
    GrainBatch batch;
    std::vector<std::uint32_t> these;
    GrainSpeeds fastest;
    for (std::size_t first = begin; first < end; first += these.size()) {
      these.resize(std::min(GrainBatch::kAtOnce, end - first));
      std::iota(these.begin(), these.end(), static_cast<std::uint32_t>(first));
      batch.hold(after, 0, these.size(), 0, features());
      batch.take(grains_, these, kernels_.kinds(), features());
      kernels_.run(batch, steps_of(length));
      grains_.scatter(these, after, 0, features());
      fastest.add(fastest_of(batch, features()));
    }
    return fastest;
  }

  /// So many give their memory back before a search, which needs some too.
  static constexpr std::size_t kMany = 100'000;

  double step_;
  GrainArrays grains_;
  GrainKernels kernels_;
  GrainDrive drive_;
  GrainDriving driving_;  ///< of the block
  GrainContacts contacts_;
  GrainPlaces places_;
  GrainOrder order_;
  std::size_t n_ = 0, collisions_ = 0;
  GrainBlocks blocks_;
  GrainNeighbours neighbours_;
  GrainIslands islands_;
  std::vector<std::uint32_t> hit_;
  GrainRuns runs_{kernels_, islands_, neighbours_};
  ThreadTeam team_;
};

GrainSolver::GrainSolver(const ContactScene& scene, std::span<const BodyState> initial, double step,
                         std::size_t threads, double slowest_rebound)
    : impl_(std::make_unique<Impl>(scene, initial, step, threads, slowest_rebound)) {}
GrainSolver::~GrainSolver() = default;
GrainSolver::GrainSolver(GrainSolver&&) noexcept = default;

void GrainSolver::advance(std::size_t steps) { impl_->advance(steps); }
double GrainSolver::now() const { return impl_->now(); }
std::size_t GrainSolver::steps() const { return impl_->steps(); }
std::size_t GrainSolver::collisions() const { return impl_->collisions(); }
std::size_t GrainSolver::touching() const { return impl_->touching(); }
bool GrainSolver::all_stick(bool rests) const { return impl_->all_stick(rests); }
std::string GrainSolver::instruction_set() { return GrainKernels::instruction_set(); }
void GrainSolver::show(Frame& frame) { impl_->show(frame); }
void GrainSolver::exchange(StateArchive& archive) { impl_->exchange(archive); }

}  // namespace slipcheck
