#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "figures/box_runs.h"
#include "figures/columns.h"
#include "figures/paper_figure.h"
#include "reference/events/planar_solver.h"

namespace slipcheck {
namespace {

/// Two spheres in L's box, without gravity and far from the walls.
Scene scene_of(const PairContact& contact) {
  VibratedBox box;
  box.count = 2;
  box.spread = 0;
  box.width = 100;
  box.pair = contact;
  Scene scene = box.scene();
  scene.gravity = 0;
  scene.box->floor.amplitude = 0;
  return scene;
}

/// Ψ2 = −u_t'/u_n of one collision with Ψ1 = −u_t/u_n as the event-driven solver performs it; the
/// direction of the contact, and how much of u_t comes from the spins, are `random`.
double psi_2(Scene& scene, double psi_1, std::mt19937_64& random) {
  constexpr double kApproach = 1;   // −u_n [m/s]
  constexpr double kBefore = 1e-3;  // [s]
  const auto share = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  const double radius = scene.bodies[0].radius;
  const double angle = 2 * std::numbers::pi * share();
  const Vector3 n(std::cos(angle), 0, std::sin(angle));
  const Vector3 t(n.z(), 0, -n.x());
  const double spins = (share() - 0.5) * psi_1 * kApproach;
  const double first = share();

  BodyState &i = scene.initial[0], &j = scene.initial[1];
  const Vector3 middle(50e-3, 0, 50e-3);
  i.velocity = -kApproach * n + (psi_1 * kApproach + spins) * t;
  j.velocity = Vector3::Zero();
  i.angular_velocity.y() = first * spins / radius;
  j.angular_velocity.y() = (1 - first) * spins / radius;
  j.position = middle - radius * n;
  i.position = middle + radius * n - kBefore * i.velocity;

  PlanarSolver solver(scene, scene.initial);
  const double end = 2 * kBefore;
  if (solver.run(until_time(end), nullptr).collisions != 1)
    throw std::runtime_error("L2: the spheres did not collide");
  const std::vector<BodyState> after = solver.states();
  const double u_t = (after[0].velocity - after[1].velocity).dot(t) -
                     radius * (after[0].angular_velocity.y() + after[1].angular_velocity.y());
  return u_t / kApproach;
}

}  // namespace

PaperFigure figure_l2() {
  PaperFigure figure;
  figure.name = "L2";
  figure.title = "Tangential velocity after a collision over that before it";
  struct Shown {
    PairContact contact;
    const char* label;
    Ink ink;
    Marker marker;
  };
  const Shown all[] = {
      {{0.9, 0.1, 0.4}, "μ = 0.1, β_0 = 0.4", Ink::blue, Marker::circle},
      {{0.9, 0.25, 0.4}, "μ = 0.25, β_0 = 0.4", Ink::vermilion, Marker::triangle},
      {{0.9, 0.25, 0}, "μ = 0.25, β_0 = 0", Ink::green, Marker::square},
  };
  const std::vector<double> psi_1 = equally_spaced(0, 4, 81);
  std::vector<double> angle;  // γ of L, from head on to grazing
  for (double psi : psi_1) angle.push_back(std::numbers::pi - std::atan(psi));
  figure.table.add("Psi_1 [-]", psi_1);
  figure.table.add("gamma [rad]", angle);
  Panel a{"(a) tangential restitution",
          {"γ/π [-]", false, 0.55, 1},
          {"β = −u_t'/u_t [-]", false, -1, 0.5}};
  Panel b{
      "(b) tangential velocities", {"Ψ_1 = −u_t/u_n [-]", false, 0, 4}, {"Ψ_2 = −u_t'/u_n [-]"}};
  b.curves.push_back({"Ψ_2 = Ψ_1, μ = 0", {Ink::grey, Line::dotted}, {0, 4}, {0, 4}});
  std::mt19937_64 random(1995);
  double most = 0;
  for (const Shown& shown : all) {
    const PairContact& contact = shown.contact;
    Scene scene = scene_of(contact);
    const double q = scene.bodies[0].shape_factor;
    const double lost = (1 + 1 / q) * (1 + std::get<double>(contact.restitution)) *
                        std::get<double>(contact.friction);
    std::vector<double> performed, derived, restitution, derived_restitution;
    for (double psi : psi_1) {
      performed.push_back(psi_2(scene, psi, random));
      derived.push_back(std::max(-contact.tangential_restitution * psi, psi - lost));
      restitution.push_back(-performed.back() / psi);
      derived_restitution.push_back(-derived.back() / psi);
    }
    const std::string of =
        fmt::format("mu = {:g}, beta0 = {:g}", std::get<double>(contact.friction),
                    contact.tangential_restitution);
    const std::vector<double> residual = difference(performed, derived);
    for (double each : residual) most = std::max(most, std::abs(each));
    figure.table.add(fmt::format("Psi_2 event driven {} [-]", of), performed);
    figure.table.add(fmt::format("Psi_2 closed form {} [-]", of), derived);
    figure.table.add(fmt::format("residual {} [-]", of), residual);
    figure.table.add(fmt::format("beta event driven {} [-]", of), restitution);
    const std::vector<double> share = scaled(angle, 1 / std::numbers::pi);
    a.curves.push_back({"", {shown.ink, Line::solid}, share, derived_restitution});
    a.curves.push_back({"", {shown.ink, Line::none, shown.marker}, share, restitution, 4, 2});
    b.curves.push_back({"", {shown.ink, Line::solid}, psi_1, derived});
    b.curves.push_back(
        {shown.label, {shown.ink, Line::none, shown.marker}, psi_1, performed, 4, 2});
  }
  figure.panels = {a, b};
  figure.statements = {{"largest difference of a performed Ψ2 from (11), (12) [-]", "0", 0, 1e-9,
                        most, 0, "The difference is rounding."}};
  figure.caption = fmt::format(
      "Two equal solid spheres (q = 2/5, e = 0.9) that meet with the relative velocity u_n < 0 "
      "along the line of their centres and u_t across it at the contact point, in a direction and "
      "with spins that are drawn at random. Points: as the event-driven solver performs the "
      "collision. Lines: Ψ_2 = Ψ_1 − (1 + 1/q)(1 + e) μ where they slide (11), Ψ_2 = −β_0 Ψ_1 "
      "where "
      "they stick (12), whichever is larger; they differ by {:.0e} at most. (a) The same as β over "
      "the impact angle, −tan γ = Ψ_1; a head-on collision has γ = π. The paper's sketch has no "
      "numbers; these μ and β_0 are chosen here. L Fig. 2.",
      most);
  return figure;
}

}  // namespace slipcheck
