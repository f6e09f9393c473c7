#include "bullet_backend/bullet_settings.h"

#include <limits>
#include <utility>

#include "engine/setting_rows.h"

namespace slipcheck::bullet {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

using S = BulletSettings;
using Make = SettingRows<S>;
using Row = Make::Row;

Row flag(std::string name, bool S::*member) { return Make::flag(std::move(name), member); }
Row number(std::string name, std::string unit, double S::*member) {
  return Make::number(std::move(name), std::move(unit), member);
}
Row count(std::string name, int S::*member) { return Make::count(std::move(name), member); }
template <class Enum>
Row word(std::string name, Enum S::*member, std::vector<std::string> words) {
  return Make::word(std::move(name), member, std::move(words));
}

std::vector<Row> kinds_and_coefficients() {
  return {
      word("body", &S::body, {"rigid", "multibody"})
          .about("btRigidBody, or btMultiBody without links, whose friction can be a true cone"),
      word("coefficients", &S::coefficients, {"fields", "pair", "pair_and_slip"})
          .about("the scene's coefficients straight in the bodies' fields; mapped exactly, pair by "
                 "pair, through the combine callbacks; likewise, but with static friction where a "
                 "contact does not slip and rolling friction only there"),
      number("friction_factor", "", &S::friction_factor)
          .within(0, 10)
          .search(0.8, 1.25)
          .about("on every coefficient of sliding friction"),
      number("restitution_factor", "", &S::restitution_factor)
          .within(0, 10)
          .search(0.8, 1.25)
          .about("on every coefficient of restitution"),
      number("rolling_friction_factor", "", &S::rolling_friction_factor)
          .within(0, 10)
          .search(0.8, 1.25)
          .about("on every rolling friction"),
      number("spinning_friction_factor", "", &S::spinning_friction_factor)
          .within(0, 10)
          .search(0.8, 1.25)
          .about("on every spinning friction"),
  };
}

std::vector<Row> solver_rows() {
  return {
      word("solver", &S::solver, {"sequential_impulse", "nncg", "dantzig", "pgs", "lemke"})
          .about("btSequentialImpulseConstraintSolver, btNNCGConstraintSolver (rigid bodies only), "
                 "or btMLCPSolver with one of the three"),
      count("solver_iterations", &S::solver_iterations)
          .within(1, 10000)
          .try_each({1.0, 4.0, 10.0, 20.0})
          .about("m_numIterations"),
      number("sor", "", &S::sor)
          .within(0.1, 1.9)
          .search(0.8, 1.2)
          .about("m_sor, over-relaxation of every row"),
      number("residual_threshold", "", &S::residual_threshold)
          .about("m_leastSquaresResidualThreshold at which the iterations end early"),
      flag("warm_starting", &S::warm_starting)
          .about("contacts start from the impulse of the step before"),
      number("warm_starting_factor", "", &S::warm_starting_factor)
          .within(0, 1)
          .about("m_warmstartingFactor, how much of it"),
      flag("articulated_warm_starting", &S::articulated_warm_starting)
          .about("the same for multibodies (SOLVER_USE_ARTICULATED_WARMSTARTING)"),
      flag("two_friction_directions", &S::two_friction_directions)
          .about("two rows of friction for each contact; multibodies need it for anything but a "
                 "friction along one fixed axis"),
      flag("velocity_dependent_friction", &S::velocity_dependent_friction)
          .about("the first row lies along the slip (rigid bodies); off: along fixed axes"),
      flag("friction_direction_caching", &S::friction_direction_caching)
          .try_each({})
          .about("SOLVER_ENABLE_FRICTION_DIRECTION_CACHING"),
      flag("friction_cone", &S::friction_cone)
          .about("multibodies with two directions: a true cone for friction and rolling friction; "
                 "off: SOLVER_DISABLE_IMPLICIT_CONE_FRICTION, which loses spinning friction too"),
      flag("interleave_friction", &S::interleave_friction)
          .about("each contact's friction right after its normal row"),
      flag("randomize_order", &S::randomize_order).try_each({}).about("SOLVER_RANDMIZE_ORDER"),
      count("minimum_batch_size", &S::minimum_batch_size)
          .within(1, 1e6)
          .about("m_minimumSolverBatchSize, rows solved together over several islands"),
  };
}

std::vector<Row> contact_rows() {
  return {
      number("erp2", "", &S::erp2)
          .within(0, 1)
          .try_each({0.0, 0.2})
          .search(0, 0.4)
          .about("part of an overlap that is pushed out in a step, as velocity unless it is split "
                 "off: the push becomes part of the rebound"),
      number("global_cfm", "1/(N s)", &S::global_cfm)
          .within(0, 1e6)
          .about("m_globalCfm, softness of normal rows"),
      number("friction_cfm", "1/(N s)", &S::friction_cfm)
          .within(0, 1e6)
          .about("m_frictionCFM, softness of friction rows"),
      flag("friction_anchor", &S::friction_anchor)
          .try_each({})
          .about("CF_HAS_FRICTION_ANCHOR: contact points pull back to where they began"),
      number("friction_erp", "", &S::friction_erp)
          .within(0, 1)
          .about("m_frictionERP, of such anchors"),
      flag("split_impulse", &S::split_impulse)
          .about("overlaps deeper than the threshold are pushed out without adding velocity (rigid "
                 "bodies only)"),
      number("split_impulse_threshold", "m", &S::split_impulse_threshold)
          .within(-kInfinity, kInfinity)
          .try_each({-0.04, 0.0})
          .about("distance below which an overlap is split off: absolute, so spheres of a few "
                 "centimetres never reach Bullet's own"),
      number("split_impulse_turn_erp", "", &S::split_impulse_turn_erp)
          .within(0, 1)
          .about("m_splitImpulseTurnErp"),
      number("linear_slop", "m", &S::linear_slop)
          .within(-1e3, 1e3)
          .about("added to every distance; negative: a gap up to it counts as touching and is not "
                 "taken from the rebound"),
      number("restitution_velocity_threshold", "m/s", &S::restitution_velocity_threshold)
          .try_each({0.0, 0.2})
          .about("approach below which nothing bounces"),
      number("contact_processing_threshold", "m", &S::contact_processing_threshold)
          .within(0, 1e18)
          .try_each({1e18, 1e-9, 1e-7})
          .about("gap up to which a contact point is solved at all; 0 loses resting contacts to "
                 "rounding"),
      number("breaking_threshold", "", &S::breaking_threshold)
          .within(0, 1e3)
          .try_each({0.02, 0.002})
          .about("gContactBreakingThreshold: gap and drift at which a point is given up, and the "
                 "margin of bounding boxes"),
      flag("relative_breaking_threshold", &S::relative_breaking_threshold)
          .try_each({})
          .about("that gap in units of the smaller shape's extent; off: a length"),
      number("contact_stiffness", "N/m", &S::contact_stiffness)
          .within(0, 1e18)
          .about("with the next > 0 contact springs (CF_HAS_CONTACT_STIFFNESS_DAMPING)"),
      number("contact_damping", "N s/m", &S::contact_damping)
          .within(0, 1e18)
          .about("of contact springs"),
      flag("ccd", &S::ccd).try_each({}).about("m_useContinuous, for bodies with a threshold"),
      number("ccd_motion_threshold", "m", &S::ccd_motion_threshold)
          .within(0, 1e18)
          .about("way in a step from which a rigid body is swept and stopped where it hits; 0: "
                 "never"),
      number("ccd_swept_radius", "", &S::ccd_swept_radius)
          .within(0, 1)
          .about("radius of the swept sphere over the body's own"),
      flag("speculative_restitution", &S::speculative_restitution)
          .try_each({})
          .about("restitution for the contacts that a sweep predicts"),
  };
}

std::vector<Row> motion_rows() {
  return {
      flag("sleeping", &S::sleeping).about("bodies that stay slow are put to sleep"),
      number("sleeping_time", "s", &S::sleeping_time).about("gDeactivationTime, slow for so long"),
      number("linear_sleeping_threshold", "m/s", &S::linear_sleeping_threshold)
          .about("slow is below this"),
      number("angular_sleeping_threshold", "rad/s", &S::angular_sleeping_threshold)
          .about("and below this"),
      number("multibody_sleeping_threshold", "", &S::multibody_sleeping_threshold)
          .about("a multibody is slow below this square of all its velocities"),
      number("linear_damping", "", &S::linear_damping)
          .within(0, 1)
          .about("part of the velocity that a rigid body loses in a second"),
      number("angular_damping", "", &S::angular_damping)
          .within(0, 1)
          .about("part of the angular velocity likewise"),
      number("multibody_linear_damping", "1/s", &S::multibody_linear_damping)
          .try_each({0.04, 0.0})
          .about("of a multibody"),
      number("multibody_angular_damping", "1/s", &S::multibody_angular_damping)
          .try_each({0.04, 0.0})
          .about("of a multibody"),
      number("multibody_velocity_limit", "m/s, rad/s", &S::multibody_velocity_limit)
          .try_each({100.0, 1e18})
          .about("at which each velocity of a multibody is cut"),
      count("substeps", &S::substeps)
          .within(1, 10000)
          .try_each({1.0, 2.0, 4.0})
          .about("equal steps of Bullet's in each step"),
      count("splits_at_contacts", &S::splits_at_contacts)
          .within(0, 1000)
          .try_each({0.0, 8.0})
          .about("up to so many times a step ends where two balls, or a ball and a surface, touch "
                 "by their present velocities, and a new one begins there"),
      number("reach", "R", &S::reach)
          .within(0, 1e6)
          .about("approach of two balls in a step, over the smaller radius, up to which the "
                 "profile is meant to be right; 0: no limit"),
      word("beyond_reach", &S::beyond_reach, {"tell", "refuse"})
          .try_each({})
          .about("what happens to a scene that starts beyond"),
      number("scale_radius_to", "", &S::scale_radius_to)
          .within(0, 1e6)
          .try_each({0.0, 1.0})
          .about("length units of Bullet's that the smallest radius becomes; 0: metres"),
      number("scale_mass_to", "", &S::scale_mass_to)
          .within(0, 1e6)
          .about("mass units that the largest mass becomes; 0: kilograms"),
      number("scale_gravity_to", "", &S::scale_gravity_to)
          .within(0, 1e6)
          .about("length units per square of time units that gravity becomes; 0: seconds"),
      word("tilt", &S::tilt, {"gravity", "plane"})
          .try_each({})
          .about("what of a tilted scene tilts in Bullet"),
      word("surface_velocity", &S::surface_velocity, {"step_before", "this_step", "step_end"})
          .about("velocity of a moving substrate, floor or wall as contacts feel it: mean of the "
                 "step before (a motion state's), of this one, or that at its end"),
      flag("flush_denormals", &S::flush_denormals)
          .try_each({})
          .about("denormal numbers are flushed to zero"),
      flag("leaves_out", &S::leaves_out)
          .try_each({})
          .about("work that the scene does not need is left out of a step; off: as Bullet ships"),
      flag("update_all_aabbs", &S::update_all_aabbs)
          .try_each({})
          .about("bounding boxes of sleeping and static bodies too"),
  };
}

const std::vector<Row>& rows() {
  static const std::vector<Row> all = [] {
    std::vector<Row> joined;
    for (const auto& part :
         {kinds_and_coefficients(), solver_rows(), contact_rows(), motion_rows()})
      joined.insert(joined.end(), part.begin(), part.end());
    return joined;
  }();
  return all;
}

}  // namespace

const std::vector<SettingInfo>& setting_table() {
  static const std::vector<SettingInfo> table = infos_of(rows());
  return table;
}

BulletSettings read_settings(const Settings& chosen) { return read_rows(rows(), chosen); }

Settings write_settings(const BulletSettings& settings) { return write_rows(rows(), settings); }

}  // namespace slipcheck::bullet
