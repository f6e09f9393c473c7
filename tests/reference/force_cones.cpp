#include "force_cones.h"

#include <glpk.h>

#include <cmath>
#include <numbers>

namespace slipcheck::test {
namespace {

constexpr int kSides = 24;

/// What one unknown adds to the balance of forces and torques of two spheres.
struct Column {
  std::vector<int> row{0};  // GLPK counts from 1
  std::vector<double> value{0};

  void add(int at, double amount) {
    if (amount == 0) return;
    row.push_back(at);
    value.push_back(amount);
  }
  void add(std::span<const Vector3> centres, const ConeContact& contact, const Vector3& push) {
    const auto on = [&](int sphere, const Vector3& force) {
      const Vector3 torque =
          (contact.point - centres[static_cast<std::size_t>(sphere)]).cross(force);
      for (int k = 0; k < 3; ++k) {
        add(6 * sphere + k + 1, force[k]);
        add(6 * sphere + k + 4, torque[k]);
      }
    };
    on(contact.first, push);
    if (contact.second >= 0) on(contact.second, -push);
  }
};

}  // namespace

bool can_stand(std::span<const Vector3> centres, std::span<const double> weights,
               std::span<const ConeContact> contacts, Pyramid pyramid) {
  const int balances = 6 * static_cast<int>(centres.size());
  const int caps = static_cast<int>(contacts.size());
  glp_prob* lp = glp_create_prob();
  glp_term_out(GLP_OFF);
  glp_add_rows(lp, balances + caps);
  for (int row = 1; row <= balances; ++row) {
    const bool vertical = (row - 1) % 6 == 2;
    const double load = vertical ? weights[static_cast<std::size_t>((row - 1) / 6)] : 0;
    glp_set_row_bnds(lp, row, GLP_FX, load, load);
  }
  const double wide = pyramid == Pyramid::outside ? 1 / std::cos(std::numbers::pi / kSides) : 1;
  for (int c = 0; c < caps; ++c) {
    const ConeContact& contact = contacts[static_cast<std::size_t>(c)];
    const int cap = balances + c + 1;
    glp_set_row_bnds(lp, cap, GLP_UP, 0, 0);  // Σ λ − μ N <= 0
    const auto add = [&](const Vector3& push, double in_cap) {
      Column column;
      column.add(centres, contact, push);
      column.add(cap, in_cap);
      const int at = glp_add_cols(lp, 1);
      glp_set_col_bnds(lp, at, GLP_LO, 0, 0);
      glp_set_mat_col(lp, at, static_cast<int>(column.row.size()) - 1, column.row.data(),
                      column.value.data());
    };
    add(contact.normal, -wide * contact.friction);
    const Vector3 across = contact.normal.unitOrthogonal(), other = contact.normal.cross(across);
    for (int k = 0; k < kSides; ++k) {
      const double angle = 2 * std::numbers::pi * k / kSides;
      add(std::cos(angle) * across + std::sin(angle) * other, 1);
    }
  }
  glp_smcp how;
  glp_init_smcp(&how);
  how.presolve = GLP_ON;
  how.msg_lev = GLP_MSG_OFF;
  const bool stands = glp_simplex(lp, &how) == 0 && glp_get_status(lp) == GLP_OPT;
  glp_delete_prob(lp);
  return stands;
}

}  // namespace slipcheck::test
