#include "peer_backends/ode/ode_world.h"

#include <ode/ode.h>

#include <deque>

#include "engine/scene_needs.h"
#include "peer_backends/ode/ode_contacts.h"
#include "peer_backends/ode/ode_surfaces.h"
#include "peer_backends/shared/applied.h"
#include "peer_backends/shared/surfaces.h"
#include "peer_backends/shared/touch_list.h"
#include "physics/solid.h"

namespace slipcheck::ode {
namespace {

Vector3 from_ode(const dReal* v) { return {v[0], v[1], v[2]}; }

/// ODE's globals, once for the process.
void start_ode() {
  static const bool started = dInitODE2(0) != 0 && dAllocateODEDataForThread(dAllocateMaskAll) != 0;
  if (!started) throw std::runtime_error("ODE does not start");
}

/// Bodies count from 0, surfaces from −1 down.
void tag(dGeomID geom, std::intptr_t place) { dGeomSetData(geom, reinterpret_cast<void*>(place)); }
std::intptr_t tag_of(dGeomID geom) { return reinterpret_cast<std::intptr_t>(dGeomGetData(geom)); }

}  // namespace

struct OdeWorld::Parts {
  struct Point {
    dContact contact;
    int body;
    std::intptr_t place;  // as tag_of()
    dJointFeedback feedback;
  };

  Parts(const OdeSetup& made, std::span<const BodyState> states, double time)
      : setup(made),
        time_step(made.time_step / made.settings.substeps),
        start_time(time),
        rules(setup.scene, setup.settings, time_step),
        surfaces(peer::surfaces_of(setup.scene)),
        touches(setup.scene.box.has_value()) {
    start_ode();
    dRandSetSeed(0);  // dWorldQuickStep shuffles its rows
    world = dWorldCreate();
    space = dSimpleSpaceCreate(nullptr);
    contacts = dJointGroupCreate(0);
    const Scene& scene = setup.scene;
    dWorldSetGravity(world, scene.downhill.x(), scene.downhill.y(), -scene.gravity);
    set_world();
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) add_ball(scene.bodies[i], states[i], i);
    for (std::size_t k = 0; k < surfaces.size(); ++k) {
      const peer::Surface& surface = surfaces[k];
      const Vector3& n = surface.normal;
      planes.push_back(dCreatePlane(space, n.x(), n.y(), n.z(), surface.offset));
      tag(planes.back(), -1 - static_cast<std::intptr_t>(k));
    }
    for (const Surface& surface : scene.surfaces) {
      beside.push_back(make_geom(space, surface.shape));
      lay(beside.back(), surface, start_time);
      tag(beside.back(), -1 - static_cast<std::intptr_t>(planes.size() + beside.size() - 1));
    }
  }

  ~Parts() {
    dJointGroupDestroy(contacts);
    dSpaceDestroy(space);
    dWorldDestroy(world);
  }

  void set_world() {
    const OdeSettings& chosen = setup.settings;
    dWorldSetERP(world, chosen.erp);
    dWorldSetCFM(world, chosen.cfm);
    dWorldSetQuickStepNumIterations(world, chosen.quick_step_iterations);
    dWorldSetQuickStepW(world, chosen.quick_step_w);
    if (chosen.contact_max_correcting_vel < 1e18)
      dWorldSetContactMaxCorrectingVel(world, chosen.contact_max_correcting_vel);
    dWorldSetContactSurfaceLayer(world, chosen.contact_surface_layer);
    dWorldSetAutoDisableFlag(world, chosen.auto_disable);
    dWorldSetAutoDisableLinearThreshold(world, chosen.auto_disable_linear_threshold);
    dWorldSetAutoDisableAngularThreshold(world, chosen.auto_disable_angular_threshold);
    dWorldSetAutoDisableTime(world, chosen.auto_disable_time);
    dWorldSetAutoDisableSteps(world, chosen.auto_disable_steps);
    if (chosen.linear_damping > 0 || chosen.angular_damping > 0)
      dWorldSetDamping(world, chosen.linear_damping, chosen.angular_damping);
  }

  const Extent* extent_of(std::size_t i) const {
    const auto& extents = setup.scene.extents;
    return extents.empty() || !extents[i] ? nullptr : &*extents[i];
  }

  static std::array<dReal, 4> to_ode(const Eigen::Quaterniond& q) {
    return {q.w(), q.x(), q.y(), q.z()};
  }

  /// ODE's cylinders lie along z.
  dGeomID geom_of(const Sphere& body, const Extent* extent) const {
    if (!extent) return dCreateSphere(space, body.radius);
    const Vector3& size = extent->size;
    return body.shape == Shape::block ? dCreateBox(space, size.x(), size.y(), size.z())
                                      : dCreateCylinder(space, body.radius, size.x());
  }

  void add_ball(const Sphere& sphere, const BodyState& state, std::size_t i) {
    const dBodyID ball = dBodyCreate(world);
    const Extent* extent = extent_of(i);
    const Vector3 inertia = extent ? moments_of_inertia(sphere, *extent)
                                   : Vector3(Vector3::Constant(sphere.moment_of_inertia()));
    dMass mass;
    dMassSetZero(&mass);
    dMassSetParameters(&mass, sphere.mass, 0, 0, 0, inertia.x(), inertia.y(), inertia.z(), 0, 0, 0);
    dBodySetMass(ball, &mass);
    if (extent) dBodySetQuaternion(ball, to_ode(turn_of(*extent)).data());
    const Vector3 &x = state.position, &v = state.velocity, &w = state.angular_velocity;
    dBodySetPosition(ball, x.x(), x.y(), x.z());
    dBodySetLinearVel(ball, v.x(), v.y(), v.z());
    dBodySetAngularVel(ball, w.x(), w.y(), w.z());
    const dGeomID geom = geom_of(sphere, extent);
    dGeomSetBody(geom, ball);
    if (sphere.shape == Shape::cylinder)
      dGeomSetOffsetQuaternion(geom, to_ode(turn_of_z_to_x()).data());
    tag(geom, static_cast<std::intptr_t>(i));
    balls.push_back(ball);
  }

  BodyState state(std::size_t i) const {
    return {from_ode(dBodyGetPosition(balls[i])), from_ode(dBodyGetLinearVel(balls[i])),
            from_ode(dBodyGetAngularVel(balls[i]))};
  }

  double now() const { return start_time + static_cast<double>(steps) * time_step; }

  void move_surfaces() {
    for (std::size_t k = 0; k < beside.size(); ++k)
      if (!setup.scene.surfaces[k].motion.is_still())
        lay(beside[k], setup.scene.surfaces[k], now());
    if (!setup.scene.box) return;
    for (std::size_t k = 0; k < surfaces.size(); ++k) {
      const peer::Surface& surface = surfaces[k];
      if (!surface.moves) continue;
      const Vector3& n = surface.normal;
      const double offset = surface.offset + n.dot(surface.displacement(setup.scene, now()));
      dGeomPlaneSetParams(planes[k], n.x(), n.y(), n.z(), offset);
    }
  }

  /// Of a surface by its place: its number as another that a body touches.
  int index_of(std::intptr_t place) const {
    const auto k = static_cast<std::size_t>(-1 - place);
    return k < surfaces.size() ? surfaces[k].index : surface_touch(k - surfaces.size());
  }

  /// A surface's velocity where it is touched, at the end of the step, which is what a row of ODE's
  /// asks for.
  Partner surface_partner(const Point& point) const {
    const auto k = static_cast<std::size_t>(-1 - point.place);
    Partner partner{index_of(point.place), {}};
    partner.state.velocity = k < surfaces.size()
                                 ? surfaces[k].velocity(setup.scene, now() + time_step)
                                 : setup.scene.surfaces[k - surfaces.size()].motion.velocity(
                                       now() + time_step, from_ode(point.contact.geom.pos));
    return partner;
  }

  static void near(void* self, dGeomID first, dGeomID second) {
    static_cast<Parts*>(self)->meet(first, second);
  }

  void meet(dGeomID first, dGeomID second) {
    if (!dGeomGetBody(first)) std::swap(first, second);
    if (!dGeomGetBody(first)) return;  // two planes
    constexpr int kMostPoints = 8;     // of a block, whose corners are eight
    dContact found[kMostPoints] = {};
    const int most = setup.scene.extents.empty() ? 1 : kMostPoints;
    const int count = dCollide(first, second, most, &found[0].geom, sizeof(dContact));
    for (int k = 0; k < count; ++k)
      points.push_back({found[k], static_cast<int>(tag_of(first)), tag_of(second), {}});
    if (count == 0) return;
    const dContact& contact = found[0];
    const Vector3 normal = from_ode(contact.geom.normal);
    const Point& point = points.back();
    if (point.place < 0) return;
    const auto other = static_cast<std::size_t>(point.place);
    const auto body = static_cast<std::size_t>(point.body);
    if (normal.dot(state(body).velocity - state(other).velocity) < 0) hit[body] = hit[other] = true;
  }

  void join(Point& point) {
    const auto body = static_cast<std::size_t>(point.body);
    const bool on_surface = point.place < 0;
    const auto place = static_cast<std::size_t>(point.place);
    rules.fill(
        point.contact, {point.body, state(body), hit[body]},
        on_surface ? surface_partner(point) : Partner{static_cast<int>(place), state(place)});
    const dJointID joint = dJointCreateContact(world, contacts, &point.contact);
    dJointAttach(joint, balls[body], on_surface ? nullptr : balls[place]);
    dJointSetFeedback(joint, &point.feedback);
  }

  void count(const Point& point) {
    const int other = point.place < 0 ? index_of(point.place) : static_cast<int>(point.place);
    const Vector3 normal = from_ode(point.contact.geom.normal);
    touches.add(point.body, other, from_ode(point.feedback.f1).dot(normal) * time_step);
  }

  void step() {
    move_surfaces();
    points.clear();
    hit.assign(balls.size(), false);
    dSpaceCollide(space, this, &near);
    for (Point& point : points) join(point);
    if (setup.settings.stepper == Stepper::step) {
      dWorldStep(world, time_step);
    } else {
      dWorldQuickStep(world, time_step);
    }
    for (const Point& point : points) count(point);
    dJointGroupEmpty(contacts);
    ++steps;
  }

  const OdeSetup& setup;
  double time_step, start_time;  // of ODE's own [s]
  std::size_t steps = 0;
  ContactRules rules;
  std::vector<peer::Surface> surfaces;
  dWorldID world;
  dSpaceID space;
  dJointGroupID contacts;
  std::vector<dBodyID> balls;
  std::vector<dGeomID> planes;  // of `surfaces`
  std::vector<dGeomID> beside;  // of the scene's surfaces
  std::vector<bool> hit;        // by another body, in this step
  std::deque<Point> points;     // of the last step; ODE keeps the address of their feedback
  peer::TouchList touches;
};

EngineInfo OdeWorld::info() {
  return {"ode",
          SLIPCHECK_ODE_VERSION,
          "double",
          setting_table(),
          {scene_part::kBlock, scene_part::kCylinder, scene_part::kSurfaces}};
}

std::string OdeWorld::refusal(const OdeSetup&) { return ""; }

std::vector<Lack> OdeWorld::lacks(const OdeSetup& setup) {
  const SceneNeeds needs = needs_of(setup.scene, setup.time_step);
  const OdeSettings& chosen = setup.settings;
  const bool by_slip = chosen.coefficients == CoefficientMap::pair_and_slip;
  const bool fields = chosen.coefficients == CoefficientMap::fields;
  const bool axes = chosen.friction_direction == FrictionDirection::axes;
  LackList missing;
  missing.note(needs.static_friction && !by_slip, lack::kStaticFriction,
               "one coefficient for sticking and sliding");
  missing.note(needs.friction && !chosen.approx1, "the limit of friction",
               "without dContactApprox1 mu is a force in N");
  missing.note(needs.friction && axes, lack::kFrictionHeadings, "up to 1.41 times on diagonals");
  missing.note(needs.coupled_drilling, lack::kCoupledDrilling,
               "torque and friction are full, each by itself");
  missing.note(needs.rolling_only && !by_slip, lack::kRollingOnly, "it acts while sliding too");
  missing.note(needs.rolling && axes, lack::kRollingHeadings, "up to 1.41 times on diagonals");
  missing.note_threshold(needs.bounce, chosen.bounce_vel);
  missing.note(needs.reversed_slip, lack::kTangentialRestitution, "friction only stops the slip");
  missing.note(setup.scene.confined, lack::kConfinement);
  missing.note(needs.far_in_a_step, lack::kPassing);
  missing.note(needs.through_in_a_step, lack::kThrough);
  missing.note(needs.rolling && fields, "rolling friction", "mu_r in the place of a length");
  missing.note(needs.rolling_table && fields, lack::kRollingTable);
  missing.note(needs.bounce_law && fields, lack::kRestitutionLaw);
  return missing.take();
}

OdeWorld::OdeWorld(const OdeSetup& setup, std::span<const BodyState> states, double time)
    : parts_(std::make_unique<Parts>(setup, states, time)) {}

OdeWorld::~OdeWorld() = default;

void OdeWorld::step() { parts_->step(); }

void OdeWorld::forget_touches() { parts_->touches.clear(); }

void OdeWorld::look(Frame& frame) const {
  frame.bodies.clear();
  for (std::size_t i = 0; i < parts_->balls.size(); ++i) frame.bodies.push_back(parts_->state(i));
  parts_->touches.write(frame.touches);
}

Settings OdeWorld::applied() const {
  const Parts& parts = *parts_;
  const OdeSettings& chosen = parts.setup.settings;
  Settings settings = write_settings(chosen);
  settings["erp"] = dWorldGetERP(parts.world);
  settings["cfm"] = dWorldGetCFM(parts.world);
  settings["auto_disable"] = dWorldGetAutoDisableFlag(parts.world) != 0;
  peer::add_world(settings, parts.setup.scene, parts.time_step);
  const bool told_apart = chosen.coefficients == CoefficientMap::pair_and_slip;
  peer::add_coefficients(settings, parts.setup.scene,
                         told_apart ? peer::SlipRule::told_apart : peer::SlipRule::ignored,
                         [&](int body, int other) { return parts.rules.values(body, other, {}); });
  return settings;
}

}  // namespace slipcheck::ode
