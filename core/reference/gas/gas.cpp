#include "reference/gas/gas.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/in_parallel.h"
#include "base/stop_scope.h"
#include "physics/granular_gas.h"

namespace slipcheck {
namespace {

constexpr std::size_t kColumns = 16;
constexpr std::size_t kGroupsOfCell = 256;
// Streams of random numbers beside those of the cells.
constexpr std::uint64_t kInitialStream = ~std::uint64_t{0};
constexpr std::uint64_t kTurnStream = kInitialStream - 1;

}  // namespace

Gas::Gas(const GasSetup& setup, const GasLaw& law)
    : setup_(setup),
      law_(law),
      layout_{static_cast<std::size_t>(setup.dimensions), law.rough()},
      groups_(setup.particles / kGasGroup),
      particles_(groups_ * (layout_.stride() / kGasGroup)),
      turns_(setup.seed, kTurnStream),
      rate_(collisions_on_the_way(setup.dimensions, setup.filled, 2 * setup.sphere.radius)),
      mean_square_(setup.speed * setup.speed) {
  const std::size_t cells = std::max<std::size_t>(1, groups_ / kGroupsOfCell);
  for (std::size_t k = 0; k < cells; ++k) cells_.push_back({GasRandom(setup.seed, k)});
  GasRandom random(setup.seed, kInitialStream);
  fill(0, layout_.dimensions, mean_square_, random);
  // T_rot = q m ⟨w²⟩/D_rot.
  const auto of_spin = static_cast<double>(layout_.spin_components());
  fill(layout_.dimensions, layout_.dimensions + layout_.spin_components(),
       setup.rotation * of_spin * mean_square_ /
           (setup.sphere.shape_factor * static_cast<double>(setup.dimensions)),
       random);
}

/// Components that are normally distributed, without a mean, and with this mean square of their
/// sum.
void Gas::fill(std::size_t from, std::size_t to, double mean_square, GasRandom& random) {
  if (from == to) return;
  const std::size_t n = setup_.particles;
  double sum = 0;
  for (std::size_t c = from; c < to; ++c) {
    double mean = 0;
    for (std::size_t k = 0; k < n; k += 2) {
      if (k % 65536 == 0) heed_stop();
      const auto words = random.next();
      const auto number = [&](std::size_t w) {
        return (static_cast<double>(words[w] >> 11) + 0.5) * 0x1p-53;
      };
      const double size = std::sqrt(-2 * std::log(number(0)));
      const double angle = 2 * std::numbers::pi * number(1);
      mean += component(k, c) = size * std::cos(angle);
      mean += component(k + 1, c) = size * std::sin(angle);
    }
    mean /= static_cast<double>(n);
    for (std::size_t k = 0; k < n; ++k) {
      component(k, c) -= mean;
      sum += component(k, c) * component(k, c);
    }
  }
  const double scale = std::sqrt(mean_square * static_cast<double>(n) / sum);
  for (std::size_t c = from; c < to; ++c)
    for (std::size_t k = 0; k < n; ++k) component(k, c) *= scale;
}

/// Each cell gets a piece of every column.
void Gas::deal() {
  const std::size_t cells = cells_.size(), pieces = kColumns * cells;
  for (Cell& cell : cells_) cell.groups.clear();
  std::array<std::uint64_t, kGasGroup> words{};
  for (std::size_t c = 0; c < kColumns; ++c) {
    if (c % kGasGroup == 0) words = turns_.next();
    const std::size_t turn = words[c % kGasGroup] % cells;
    for (std::size_t b = 0; b < cells; ++b) {
      const std::size_t piece = c * cells + (b + turn) % cells;
      const std::size_t first = piece * groups_ / pieces, last = (piece + 1) * groups_ / pieces;
      for (std::size_t g = first; g < last; ++g)
        cells_[b].groups.push_back(static_cast<std::uint32_t>(g));
    }
  }
}

void Gas::visit(Cell& cell, double time) {
  GasVisit visit{particles_.data()->at, cell.groups};
  const GasSquares squares = squares_of(layout_, visit);
  cell.square_sum = squares.sum;
  visit.majorant = 2 * std::sqrt(squares.largest);
  // Of the N n χ σ_T G Δt/2 pairs eight are chosen at once.
  cell.rest += 0.5 * static_cast<double>(cell.groups.size()) * rate_ * visit.majorant * time;
  visit.candidates = static_cast<std::size_t>(cell.rest);
  cell.rest -= static_cast<double>(visit.candidates);
  visit_cell(layout_, law_, setup_.sphere.shape_factor, cell.random, visit);
  cell.collisions = visit.collisions;
  cell.overtaken = visit.overtaken;
}

void Gas::advance() {
  heed_stop();
  const double temperature_by_mass = mean_square_ / setup_.dimensions;
  const double time =
      setup_.step / (rate_ * mean_relative_speed(setup_.dimensions, temperature_by_mass));
  deal();
  in_parallel(cells_.size(), setup_.threads, [&](std::size_t k) { visit(cells_[k], time); });
  double sum = 0;
  for (const Cell& cell : cells_) {
    collisions_ += cell.collisions;
    overtaken_ += cell.overtaken;
    sum += cell.square_sum;
  }
  mean_square_ = sum / static_cast<double>(setup_.particles);
  now_ += time;
}

std::vector<GasMoments> Gas::moments() const {
  std::vector<GasMoments> batches(kBatches);
  in_parallel(kBatches, setup_.threads, [&](std::size_t batch) {
    GasMoments& sums = batches[batch];
    const std::size_t n = setup_.particles;
    for (std::size_t k = batch * n / kBatches; k < (batch + 1) * n / kBatches; ++k) {
      double v2 = 0, w2 = 0;
      for (std::size_t c = 0; c < layout_.dimensions; ++c) v2 += component(k, c) * component(k, c);
      for (std::size_t c = 0; c < layout_.spin_components(); ++c) {
        const double w = component(k, layout_.dimensions + c);
        w2 += w * w;
      }
      sums.particles += 1;
      sums.v2 += v2;
      sums.v4 += v2 * v2;
      sums.w2 += w2;
    }
  });
  return batches;
}

BodyState Gas::particle(std::size_t k) const {
  BodyState state;
  for (std::size_t c = 0; c < layout_.dimensions; ++c)
    state.velocity[static_cast<Eigen::Index>(c)] = component(k, c);
  const std::size_t spins = layout_.spin_components();
  for (std::size_t c = 0; c < spins; ++c)
    state.angular_velocity[static_cast<Eigen::Index>(3 - spins + c)] =
        component(k, layout_.dimensions + c) / setup_.sphere.radius;
  return state;
}

}  // namespace slipcheck
