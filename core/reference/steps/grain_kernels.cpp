// Compiled once for each instruction set by Google Highway. The loops over grains are plain, for
// the compiler to vectorise; without contraction and reductions, so that every set gives the same
// bits.
#include "reference/steps/grain_kernels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <initializer_list>

#include "reference/steps/step_body.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reference/steps/grain_kernels.cpp"
#if defined(SLIPCHECK_SANITIZE)  // which know what plain loads do, and nothing of wider gathers
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX2 | HWY_AVX3 | HWY_AVX3_DL)
#else
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
#endif
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "reference/steps/grain_loops-inl.h"

#if HWY_ONCE
namespace slipcheck {

HWY_EXPORT(FindNear);
HWY_EXPORT(Glide);
HWY_EXPORT(Run);
HWY_EXPORT(Target);

void GrainBatch::hold(GrainArrays& in, std::size_t first, std::size_t grain_count,
                      std::size_t count_of_pairs, const GrainFeatures& has) {
  count = grain_count;
  pair_count = count_of_pairs;
  if (pairs.size() < pair_count) pairs.resize(pair_count), acting.resize(pair_count);
  const std::size_t places = count + 1;
  in.hold(first + places, has);
  in_ = &in;
  first_ = first;
  grains = {in, first};
  if (fx.size() >= places) return;
  const auto each = [places](std::initializer_list<std::vector<double>*> all) {
    for (std::vector<double>* values : all) values->resize(places);
  };
  each({&fx, &fy, &fastest, &inverse_mass});
  if (has.rubs) each({&tz});
  if (has.rubs || has.on_plane) each({&inverse_inertia});
  if (has.on_plane) each({&fz, &tx, &ty, &load, &weight, &share, &turn, &mu_s, &mu_k});
  if (has.is_uneven()) each({&radius});
  if (has.rolls) each({&mu_r, &drilling});
  if (has.lifts) kind.resize(places);
}

void GrainBatch::take(const GrainArrays& from, std::span<const std::uint32_t> which,
                      const std::vector<GrainKind>& kinds, const GrainFeatures& has) {
  in_->gather(first_, from, which, has);
  std::fill_n(fastest.begin(), which.size(), 0.0);
  if (kinds.size() > 1 || has.walls) {
    for (std::size_t k = 0; k < which.size(); ++k) take_kind(k, kinds[from.kind[which[k]]], has);
  } else {
    for (; of_one_kind_ < which.size(); ++of_one_kind_) take_kind(of_one_kind_, kinds.front(), has);
  }
}

void GrainBatch::take_kind(std::size_t k, const GrainKind& of, const GrainFeatures& has) {
  inverse_mass[k] = of.inverse_mass;
  if (has.rubs || has.on_plane) inverse_inertia[k] = of.inverse_inertia;
  if (!has.on_plane) return;
  weight[k] = of.weight;
  share[k] = of.share;
  turn[k] = of.turn;
  mu_s[k] = of.static_friction;
  mu_k[k] = of.kinetic_friction;
  if (has.is_uneven()) radius[k] = of.radius;
  if (has.rolls) mu_r[k] = of.rolling_friction, drilling[k] = of.drilling_length;
  if (has.lifts) kind[k] = &of;
}

void GrainBatch::take_wall(const GrainFeatures& has) {
  in_->for_each_changing(has, [this](auto& values) { values[first_ + count] = 0; });
  for (auto* values : {&fx, &fy, &fz, &tx, &ty, &tz, &weight, &radius}) (*values)[count] = 0;
}

void land_grain(const GrainKind& kind, const GrainPlane& plane, const GrainPush& push,
                const GrainView& grains, std::size_t i) {
  const GrainView& g = grains;
  if (!(g.z[i] < kind.radius && g.vz[i] < 0)) return;
  StepKind of;
  of.inverse_mass = kind.inverse_mass;
  of.sphere = *kind.sphere;
  of.contact = kind.contact;
  StepSurroundings around;
  around.velocity = {push.plane_x, push.plane_y};
  StepBody body;
  body.position = {g.x[i], g.y[i], g.z[i]};
  body.radius = kind.radius;
  body.velocity = {g.vx[i], g.vy[i], g.vz[i]};
  body.angular_velocity = {g.wx[i], g.wy[i], g.wz[i]};
  land_after_drift(body, of, around, plane.slowest_rebound);
  g.z[i] = body.position.z();
  g.vx[i] = body.velocity.x(), g.vy[i] = body.velocity.y(), g.vz[i] = body.velocity.z();
  g.wx[i] = body.angular_velocity.x(), g.wy[i] = body.angular_velocity.y();
  g.wz[i] = body.angular_velocity.z();
  g.dvx[i] = g.dvy[i] = g.dvz[i] = g.dwx[i] = g.dwy[i] = g.dwz[i] = 0;
  g.flies[i] = body.supported ? 0 : 1;
  g.sticks[i] = body.sticks ? 1 : 0;
  g.bounced[i] = double{body.bounced};
}

std::string GrainKernels::instruction_set() {
  return hwy::TargetName(HWY_DYNAMIC_DISPATCH(Target)());
}

void GrainKernels::find_near(const GrainArrays& grains, std::span<const std::uint32_t> first,
                             std::span<const std::uint32_t> second, double margin,
                             std::vector<std::uint32_t>& near) const {
  HWY_DYNAMIC_DISPATCH(FindNear)(features_, grains, plane_, first, second, margin, near);
}

GrainSpeeds GrainKernels::glide(GrainArrays& grains, std::size_t first, std::size_t last,
                                const GrainSteps& steps) const {
  return HWY_DYNAMIC_DISPATCH(Glide)(features_, grains, first, last, kinds_, plane_, steps);
}

std::size_t GrainKernels::run(GrainBatch& batch, const GrainSteps& steps) const {
  const bool walls = features_.walls && batch.pair_count > 0;
  if (walls) batch.take_wall(features_);
  const std::size_t begun = HWY_DYNAMIC_DISPATCH(Run)(features_, batch, laws_, plane_, steps);
  if (walls) batch.take_wall(features_);  // no forces are left
  return begun;
}

}  // namespace slipcheck
#endif
