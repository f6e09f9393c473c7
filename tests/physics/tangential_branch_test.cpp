#include "physics/contact/tangential_branch.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace slipcheck {
namespace {

constexpr double kRounding = 4e-16;

const ViscousForce kViscous{3.0, 0.4};
const AsperityForce kPrinted{0.4, 1e-6, AsperityForce::Form::printed};
const AsperityForce kPassive{0.4, 1e-6, AsperityForce::Form::passive};

std::vector<TangentialBranch> all_branches() {
  std::vector<TangentialBranch> all;
  for (const double sign : {-1.0, 1.0})
    for (const bool flag : {false, true})
      for (const double broken : {0.0, 3.0}) all.push_back({sign, flag, flag, broken});
  return all;
}

TEST(TangentialBranch, ALawIsTheSameInAPlaneAndInSpace) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> any(-1, 1);
  const Vector3 axis = Vector3(2, -1, 2) / 3;
  for (const TangentialForce& law :
       {TangentialForce(NoTangentialForce{}), TangentialForce(kViscous), TangentialForce(kPrinted),
        TangentialForce(kPassive)})
    for (const TangentialBranch& branch : all_branches()) {
      const double normal = any(random), slip = any(random), bend = 1e-6 * any(random);
      const double plane = tangential_force(law, branch, normal, slip, bend);
      const Vector3 space =
          tangential_force(law, branch, normal, Vector3(slip * axis), Vector3(bend * axis));
      EXPECT_LE((space - plane * axis).norm(), kRounding * std::abs(plane));
      const auto* asperity = std::get_if<AsperityForce>(&law);
      if (!asperity) continue;
      const double rate = bend_rate(*asperity, branch, normal, slip);
      EXPECT_LE((bend_rate(*asperity, branch, normal, Vector3(slip * axis)) - rate * axis).norm(),
                kRounding * std::abs(rate));
    }
}

/// The laws as tangential_force.h writes them down, at once and without branches.
TEST(TangentialBranch, ItsPiecesMakeUpTheLaw) {
  for (const double normal : {-2.0, 0.5, 2.0})
    for (const double slip : {-1.0, -0.1, 0.1, 1.0}) {
      TangentialBranch branch;
      follow(kViscous, normal, std::abs(slip), branch);
      const double most = std::min(3.0 * std::abs(slip), 0.4 * std::abs(normal));
      EXPECT_DOUBLE_EQ(tangential_force(kViscous, branch, normal, slip, 0.0),
                       slip > 0 ? -most : most);
    }
  for (const double bend : {-2.3e-6, -0.3e-6, 0.3e-6, 2.3e-6}) {
    const TangentialBranch branch{.broken = std::floor(std::abs(bend) / 1e-6)};
    const double size = std::abs(bend) / 1e-6;
    const double force = 0.4 * 5 * (size - std::floor(size));
    EXPECT_NEAR(tangential_force(kPrinted, branch, 5.0, 0.0, bend), bend > 0 ? -force : force,
                1e-15);
  }
}

struct Edges {
  std::vector<TangentialEdge> edges;
  std::vector<int> directions;
};

Edges edges_of(const TangentialForce& law, const TangentialBranch& branch, ContactEnd end) {
  Edges found;
  for_each_edge(law, branch, end, [&](TangentialEdge edge, int direction) {
    found.edges.push_back(edge);
    found.directions.push_back(direction);
  });
  return found;
}

TEST(TangentialBranch, EachPieceHasItsEdges) {
  using Edge = TangentialEdge;
  using enum ContactEnd;
  EXPECT_TRUE(edges_of(NoTangentialForce{}, {}, zero_overlap).edges.empty());
  EXPECT_EQ(edges_of(kViscous, {}, zero_force).edges, std::vector{Edge::cap});
  EXPECT_EQ(edges_of(kViscous, {}, zero_overlap).edges, (std::vector{Edge::force_sign, Edge::cap}));
  EXPECT_EQ(edges_of(kPrinted, {}, zero_force).edges, std::vector{Edge::break_forward});
  EXPECT_EQ(edges_of(kPrinted, {.broken = 2}, zero_force).edges,
            (std::vector{Edge::break_forward, Edge::break_back}));
  EXPECT_EQ(edges_of(kPassive, {}, zero_force).directions, (std::vector{1, -1}));
  EXPECT_EQ(edges_of(kPassive, {.growing = false}, zero_force).directions, (std::vector{1, 1}));
  // What an attraction does not bend does not break either.
  EXPECT_EQ(edges_of(kPassive, {.force_sign = -1}, zero_overlap).edges,
            std::vector{Edge::force_sign});
}

TEST(TangentialBranch, AtAnEdgeTheForceIsContinuousOrStartsAnew) {
  const auto force = [](const TangentialForce& law, const TangentialBranch& branch, double normal,
                        double slip,
                        double bend) { return tangential_force(law, branch, normal, slip, bend); };
  // The cap: 3 |u| = 0.4 F_N.
  TangentialBranch branch;
  double bend = 0;
  const double slip = 0.4 * 1.5 / 3;
  EXPECT_NEAR(edge_value(TangentialEdge::cap, kViscous, branch, 1.5, 0, slip, 0), 0, 1e-16);
  const double below = force(kViscous, branch, 1.5, slip, 0);
  cross(TangentialEdge::cap, true, kViscous, 1.5, branch, bend);
  EXPECT_NEAR(force(kViscous, branch, 1.5, slip, 0), below, 1e-15);

  // F_N stops to grow: the bend goes on from F_N times itself.
  branch = {};
  bend = 1.5 * 0.7e-6;
  const double growing = force(kPassive, branch, 1.5, 0, bend);
  cross(TangentialEdge::growth, false, kPassive, 1.5, branch, bend);
  EXPECT_NEAR(bend, 0.7e-6, 1e-21);
  EXPECT_NEAR(force(kPassive, branch, 1.5, 0, bend), growing, 1e-16);
  cross(TangentialEdge::growth, true, kPassive, 1.2, branch, bend);
  EXPECT_NEAR(bend, 1.2 * 0.7e-6, 1e-21);

  // It breaks at ζ0, whose state is F_N ζ0 while F_N grows.
  EXPECT_NEAR(edge_value(TangentialEdge::break_forward, kPassive, branch, 1.2, 0, 0, 1.2e-6), 0,
              1e-21);
  cross(TangentialEdge::break_forward, true, kPassive, 1.2, branch, bend);
  EXPECT_EQ(force(kPassive, branch, 1.2, 0, bend), 0);

  // The saw-tooth falls from μ F_N to 0, and back.
  branch = {};
  bend = 1e-6;
  EXPECT_NEAR(force(kPrinted, branch, 2, 0, bend), -0.8, 1e-15);
  cross(TangentialEdge::break_forward, true, kPrinted, 2, branch, bend);
  EXPECT_NEAR(force(kPrinted, branch, 2, 0, bend), 0, 1e-15);
  EXPECT_NEAR(edge_value(TangentialEdge::break_back, kPrinted, branch, 2, 0, 0, bend), 0, 1e-21);
  cross(TangentialEdge::break_back, false, kPrinted, 2, branch, bend);
  EXPECT_EQ(branch.broken, 0);

  // An attraction lets the asperity go.
  branch = {.growing = false};
  bend = 0.5e-6;
  cross(TangentialEdge::force_sign, false, kPassive, 0, branch, bend);
  EXPECT_EQ(force(kPassive, branch, -0.1, 0, 0.5e-6), 0);
  EXPECT_EQ(bend_rate(kPassive, branch, -0.1, 1.0), 0);
  cross(TangentialEdge::force_sign, true, kPassive, 0, branch, bend);
  EXPECT_TRUE(branch.growing);
  EXPECT_EQ(bend, 0);
}

}  // namespace
}  // namespace slipcheck
