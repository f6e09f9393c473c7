#include "reference/steps/grain_solver.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "base/stop_scope.h"
#include "base/thread_team.h"
#include "physics/numbers.h"
#include "reference/steps/grain_blocks.h"
#include "reference/steps/grain_drive.h"
#include "reference/steps/grain_islands.h"
#include "reference/steps/grain_kernels.h"
#include "reference/steps/grain_meetings.h"
#include "reference/steps/grain_neighbours.h"
#include "reference/steps/grain_order.h"
#include "reference/steps/grain_scene.h"
#include "reference/steps/step_solver.h"

namespace slipcheck {
namespace {

double folded(double x, double length, std::int64_t& image) {
  if (!(length > 0) || (x >= 0 && x < length)) return x;
  const double turns = std::floor(x / length);
  image += static_cast<std::int64_t>(turns);
  return x - turns * length;
}

}  // namespace

class GrainSolver::Impl {
 public:
  Impl(const ContactScene& scene, std::span<const BodyState> initial, double step,
       std::size_t threads)
      : scene_(&scene),
        step_(step),
        kernels_(grain_kernels(scene, initial, grains_.kind)),
        drive_(scene.hard, initial, step),
        team_(threads) {
    assert(step > 0 && initial.size() == scene.hard.bodies.size());
    const std::size_t n = initial.size();
    std::vector<std::uint32_t> kind = std::move(grains_.kind);
    grains_.resize(n);
    grains_.kind = std::move(kind);
    image_x_.assign(n, 0);
    image_y_.assign(n, 0);
    double fastest2 = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const BodyState& state = initial[i];
      body_.push_back(static_cast<std::uint32_t>(i));
      grains_.x[i] = state.position.x();
      grains_.y[i] = state.position.y();
      grains_.vx[i] = state.velocity.x();
      grains_.vy[i] = state.velocity.y();
      grains_.wx[i] = state.angular_velocity.x();
      grains_.wy[i] = state.angular_velocity.y();
      grains_.wz[i] = state.angular_velocity.z();
      const double R = radius();
      const double round_off = 16 * kEpsilon *
                               (state.velocity.norm() + drive_.velocity_of(0).norm() +
                                R * state.angular_velocity.norm());
      grains_.sticks[i] = drive_.slip(state, i).norm() <= round_off ? 1 : 0;
      const Vector2 speed = state.velocity.head<2>() - drift_of(0);
      fastest2 = std::max(fastest2, speed.squaredNorm());
    }
    blocks_ = {step, features().driven ? drive_.most(braking()) : braking()};
    blocks_.set_fastest(std::sqrt(fastest2));
    find_neighbours(1);
  }

  void advance(std::size_t steps) {
    while (steps > 0) {
      heed_stop();
      if (!(blocks_.fastest() * step_ <= 0.5 * radius()))
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
    archive(grains_, image_x_, image_y_, body_, n_, collisions_, blocks_, neighbours_, touching_,
            parted_);
    remember_contacts();
  }

  double now() const { return static_cast<double>(n_) * step_; }
  std::size_t steps() const { return n_; }
  std::size_t collisions() const { return collisions_; }
  std::size_t touching() const { return touching_.size(); }
  const GrainFeatures& features() const { return kernels_.features(); }

  bool all_stick(bool rests) const {
    const Vector2 plane = drive_.velocity_of(n_);
    for (std::size_t i = 0; i < grains_.size(); ++i) {
      const auto [wx, wy, wz] = spin(grains_, i);
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
    // All grains in one batch get the half kick from their velocities' time to that of positions.
    GrainBatch batch = batch_of_all();
    std::vector<std::uint32_t> near;
    kernels_.find_near(grains_, neighbours_.first(), neighbours_.second(), blocks_.margin(1), near);
    batch.pairs.resize(near.size());
    for (std::size_t p = 0; p < near.size(); ++p) take_pair(near[p], batch.pairs[p]);
    const GrainGroup all = {0, grains_.size(), 0, batch.pairs.size()};
    if (features().driven) drive_.find_half(n_, driving_);
    kernels_.run(batch, all, {step_, n_ > 0 ? 0.5 * step_ : 0, 1, false, n_ > 0, &driving_});
    frame.bodies.resize(grains_.size());
    frame.touches.clear();
    const GrainArrays& g = batch.grains;
    for (std::size_t i = 0; i < grains_.size(); ++i) {
      const double x = grains_.x[i] + static_cast<double>(image_x_[i]) * kernels_.plane().length_x;
      const double y = grains_.y[i] + static_cast<double>(image_y_[i]) * kernels_.plane().length_y;
      const auto [wx, wy, wz] = spin(g, i);
      frame.bodies[body_[i]] = {{x, y, radius()}, {g.vx[i], g.vy[i], 0}, {wx, wy, wz}};
      const double impulse = features().on_plane ? 2 * batch.load[i]
                             : n_ > 0            ? kernels_.kinds()[grains_.kind[i]].weight * step_
                                                 : 0;
      if (impulse > 0) frame.touches.push_back({static_cast<int>(body_[i]), kSubstrate, impulse});
    }
    for (const GrainPair& pair : batch.pairs) {
      const double impulse = std::abs(pair.normal_force) * step_;
      if (!pair.touching || !(impulse > 0)) continue;
      const auto [i, j] = std::minmax(body_[pair.a], body_[pair.b]);
      frame.touches.push_back({static_cast<int>(i), static_cast<int>(j), impulse});
    }
  }

 private:
  /// A pair of the list in contact at the end of a block, by grain.
  struct Contact {
    std::uint32_t listed = 0;
    GrainPair pair;
  };
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  /// What a group's steps came to.
  struct Ended {
    std::size_t begun = 0, touching = 0;
    std::size_t touching_before = 0;  ///< of the groups before it
    double fastest2 = 0;
    std::vector<std::uint32_t> parted;  ///< a grain of each two that did in the last step
  };

  double radius() const { return kernels_.plane().radius; }

  /// Ω of grain `i`, of which `now` has what changes [rad/s].
  std::array<double, 3> spin(const GrainArrays& now, std::size_t i) const {
    const std::uint32_t body = body_[i];  // what does not change stays in the scene's order
    return {features().on_plane ? now.wx[i] : grains_.wx[body],
            features().on_plane ? now.wy[i] : grains_.wy[body],
            features().rubs ? now.wz[i] : grains_.wz[body]};
  }

  /// Where the speeds of grains count from [m/s].
  Vector2 drift_of(std::size_t n) const {
    return features().driven ? drive_.drift_of(n) : Vector2::Zero();
  }

  /// The largest acceleration of a grain by friction of the plane [m/s²]: μ_k g, and μ_s g where
  /// that holds what the plane carries along.
  double braking() const {
    double most = 0;
    if (features().on_plane)
      for (const GrainKind& kind : kernels_.kinds()) {
        const double held_by = features().driven ? kind.static_friction : 0;
        most = std::max(most,
                        std::max(held_by, kind.kinetic_friction) * kind.weight * kind.inverse_mass);
      }
    return most;
  }

  /// 0 where the list of neighbours no longer covers one step.
  std::size_t next_block(std::size_t steps) const {
    if (n_ == 0) return 1;  // its kick is half as long
    return blocks_.next(steps, grains_.size(), neighbours_.first().size(), touching_.size());
  }

  void find_neighbours(std::size_t length) {
    blocks_.renew(length, 2 * radius(), density());
    GrainArrays& g = grains_;
    team_.run_shares(g.size(), [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        g.x[i] = folded(g.x[i], kernels_.plane().length_x, image_x_[i]);
        g.y[i] = folded(g.y[i], kernels_.plane().length_y, image_y_[i]);
      }
    });
    reorder(neighbours_.sort(g, kernels_.plane(), 2 * radius() + blocks_.skin(), team_));
    neighbours_.find(g, kernels_.plane(), blocks_.skin(), team_);
    for (Contact& contact : touching_)
      contact.listed = neighbours_.place_of(contact.pair.a, contact.pair.b);
    remember_contacts();
  }

  /// Where the contact of a listed pair is found.
  void remember_contacts() {
    contact_of_.assign(neighbours_.first().size(), kNone);
    for (std::uint32_t c = 0; c < touching_.size(); ++c) contact_of_[touching_[c].listed] = c;
  }

  /// ρ [1/m²] of a periodic plane, else that of grains side by side.
  double density() const {
    const GrainPlane& plane = kernels_.plane();
    const double area = plane.length_x * plane.length_y, d = 2 * radius();
    return area > 0 ? static_cast<double>(grains_.size()) / area : 1 / (d * d);
  }

  void reorder(const std::vector<std::uint32_t>& order) {
    for (std::uint32_t& i : parted_) i = neighbours_.sorted(i);
    std::vector<GrainOrder::Quantity> all;
    grains_.for_each_changing(features(),
                              [&](std::vector<double>& values) { all.push_back(&values); });
    all.insert(all.end(), {&image_x_, &image_y_, &body_});
    if (kernels_.kinds().size() > 1) all.push_back(&grains_.kind);
    order_.apply(order, all, team_);
    for (Contact& contact : touching_) {
      GrainPair& pair = contact.pair;
      pair.a = neighbours_.sorted(pair.a);
      pair.b = neighbours_.sorted(pair.b);
      if (pair.a < pair.b) continue;
      std::swap(pair.a, pair.b);
      const GrainPair::Force& f = pair.force;
      pair.force = {-f.x, -f.y, -f.z, -f.across_x, -f.across_y};
    }
  }

  /// All grains, each in its own place.
  GrainBatch batch_of_all() const {
    GrainBatch batch;
    batch.hold(grains_.size(), 0, features());
    for (std::size_t i = 0; i < grains_.size(); ++i)
      batch.take(i, grains_, i, kernels_.kinds(), features());
    return batch;
  }

  /// A pair of the list, by grain, with what it remembers if in contact.
  void take_pair(std::uint32_t listed, GrainPair& pair) const {
    const GrainPlane& plane = kernels_.plane();
    const std::uint32_t contact = contact_of_[listed];
    pair.touching = false;
    if (contact != kNone) pair = touching_[contact].pair;
    pair.parted_in = 0;
    const std::uint32_t i = neighbours_.first()[listed], j = neighbours_.second()[listed];
    pair.a = i;
    pair.b = j;
    pair.shift_x = shift_to_nearest_image(grains_.x[i] - grains_.x[j], plane.length_x);
    pair.shift_y = shift_to_nearest_image(grains_.y[i] - grains_.y[j], plane.length_y);
    pair.law = static_cast<std::uint32_t>(kernels_.kinds()[grains_.kind[i]].material *
                                              scene_->hard.substrate.size() +
                                          kernels_.kinds()[grains_.kind[j]].material);
  }

  /// So many steps, or none where a grain got faster than foreseen.
  bool run_block(std::size_t length) {
    const GrainPairs listed = {neighbours_.first(), neighbours_.second()};
    const GrainMeetings meetings(kernels_, grains_, listed, blocks_.margin(length),
                                 step_ * static_cast<double>(length), braking(), step_);
    // A grain that touches another one is hit whatever their ways; and what has just acted on one
    // that parted counts in the next step.
    hit_ = parted_;
    for (const Contact& contact : touching_) hit_.push_back(contact.pair.a);
    islands_.find(
        grains_.size(), listed, hit_,
        [&](std::size_t first, std::size_t last, GrainNear& found) {
          meetings.find(first, last, found);
        },
        team_);
    batch_.hold(islands_.grain_places(), islands_.pair_count(), features());
    if (features().driven) drive_.find(n_, length, kernels_.kinds(), driving_);
    // Groups share no grain: whoever takes them, each does the same.
    const std::vector<GrainIslandGroup>& groups = islands_.groups();
    ended_.resize(groups.size());
    team_.run_own_first(groups.size(),
                        [&](std::size_t k) { ended_[k] = run_group(groups[k], length); });
    Ended all;
    for (Ended& each : ended_) {
      each.touching_before = all.touching;
      all.begun += each.begun;
      all.touching += each.touching;
      all.fastest2 = std::max(all.fastest2, each.fastest2);
    }
    if (std::sqrt(all.fastest2) > blocks_.bound(length)) {
      blocks_.set_fastest(std::sqrt(all.fastest2));
      return false;
    }
    const double still2 = end_block(length, all.touching);
    collisions_ += all.begun;
    blocks_.took(length, islands_.grain_count(), all.touching,
                 std::sqrt(std::max(all.fastest2, still2)));
    return true;
  }

  /// The next ones; the first kick of all is half as long.
  GrainSteps steps_of(std::size_t length) const {
    return {step_, n_ == 0 ? 0.5 * step_ : step_, length, true, n_ > 0, &driving_};
  }

  /// Takes a group's grains and pairs and does its steps.
  Ended run_group(const GrainIslandGroup& islands, std::size_t length) {
    const GrainGroup& group = islands.batch;
    for (std::size_t k = 0; k < islands.grains.size(); ++k)
      batch_.take(group.first_grain + k, grains_, islands.grains[k], kernels_.kinds(), features());
    for (std::size_t p = 0; p < islands.pairs.size(); ++p) {
      GrainPair& pair = batch_.pairs[group.first_pair + p];
      take_pair(islands.pairs[p], pair);
      pair.a = islands_.place(pair.a) + islands.shift;
      pair.b = islands_.place(pair.b) + islands.shift;
    }
    Ended ended;
    ended.begun = kernels_.run(batch_, group, steps_of(length));
    for (std::size_t k = group.first_grain; k < group.last_grain; ++k)
      ended.fastest2 = std::max(ended.fastest2, batch_.fastest[k]);
    for (std::size_t p = group.first_pair; p < group.last_pair; ++p)
      ended.touching += batch_.pairs[p].touching ? 1 : 0;
    return ended;
  }

  /// Grains that met none glide; the others, and contacts, are taken back from the batch. Returns
  /// the square of the largest speed of those that glided.
  double end_block(std::size_t length, std::size_t touching) {
    for (const Contact& contact : touching_) contact_of_[contact.listed] = kNone;
    touching_.resize(touching);
    // The first kick is half as long, and without friction there is none.
    const bool begins = n_ == 0 && features().on_plane;
    std::vector<double> still2(team_.size(), begins ? begin_gliding() : 0);
    team_.run_shares(grains_.size(), [&](std::size_t own, std::size_t first, std::size_t last) {
      if (!begins) still2[own] = kernels_.glide(grains_, first, last, steps_of(length));
      const auto take_back = [&](const GrainIslandGroup& group, bool is_between) {
        for (std::size_t k = 0; k < group.grains.size(); ++k) {
          const std::uint32_t i = group.grains[k];
          if (!is_between || (first <= i && i < last))
            grains_.take(i, batch_.grains, group.batch.first_grain + k, features());
        }
      };
      for (const GrainIslandGroup& group : islands_.groups_of(own)) take_back(group, false);
      for (const GrainIslandGroup& group : islands_.groups_of(team_.size())) take_back(group, true);
      const auto [group, end] = team_.share_of(ended_.size(), own);
      for (std::size_t k = group; k < end; ++k) keep_contacts(k, length);
    });
    parted_.clear();
    for (const Ended& each : ended_)
      parted_.insert(parted_.end(), each.parted.begin(), each.parted.end());
    return *std::max_element(still2.begin(), still2.end());
  }

  void keep_contacts(std::size_t k, std::size_t length) {
    const GrainIslandGroup& group = islands_.groups()[k];
    ended_[k].parted.clear();
    auto c = static_cast<std::uint32_t>(ended_[k].touching_before);
    for (std::size_t p = 0; p < group.pairs.size(); ++p) {
      const GrainPair& pair = batch_.pairs[group.batch.first_pair + p];
      const std::uint32_t listed = group.pairs[p];
      if (pair.parted_in == length) ended_[k].parted.push_back(neighbours_.first()[listed]);
      if (!pair.touching) continue;
      Contact& contact = touching_[c];
      contact = {listed, pair};
      contact.pair.a = neighbours_.first()[listed];
      contact.pair.b = neighbours_.second()[listed];
      contact_of_[listed] = c++;
    }
  }

  /// The first step with its half kick.
  double begin_gliding() {
    GrainBatch batch = batch_of_all();
    kernels_.run(batch, {0, grains_.size(), 0, 0}, steps_of(1));
    for (std::size_t i = 0; i < grains_.size(); ++i) grains_.take(i, batch.grains, i, features());
    return *std::max_element(batch.fastest.begin(), batch.fastest.end());
  }

  const ContactScene* scene_;
  double step_;
  GrainArrays grains_;
  GrainKernels kernels_;
  GrainDrive drive_;
  GrainDriving driving_;                         ///< of the block
  std::vector<std::int64_t> image_x_, image_y_;  ///< cells between a grain's path and its place
  std::vector<std::uint32_t> body_;              ///< of the scene
  GrainOrder order_;
  std::size_t n_ = 0, collisions_ = 0;
  GrainBlocks blocks_;
  GrainNeighbours neighbours_;
  GrainIslands islands_;
  std::vector<std::uint32_t> hit_;
  std::vector<Ended> ended_;
  ThreadTeam team_;
  GrainBatch batch_;
  std::vector<Contact> touching_;
  std::vector<std::uint32_t> parted_;      ///< a grain of each two that did in the last step
  std::vector<std::uint32_t> contact_of_;  ///< of a listed pair, in touching_ or kNone
};

GrainSolver::GrainSolver(const ContactScene& scene, std::span<const BodyState> initial, double step,
                         std::size_t threads)
    : impl_(std::make_unique<Impl>(scene, initial, step, threads)) {}
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
