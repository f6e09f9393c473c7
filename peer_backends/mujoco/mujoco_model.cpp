#include "peer_backends/mujoco/mujoco_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>
#include <variant>

#include "peer_backends/mujoco/restitution_spring.h"
#include "peer_backends/shared/surfaces.h"
#include "physics/solid.h"

namespace slipcheck::mujoco {
namespace {

using Text = fmt::memory_buffer;

template <class... Args>
void put(Text& text, fmt::format_string<Args...> format, Args&&... args) {
  fmt::format_to(std::back_inserter(text), format, std::forward<Args>(args)...);
}

/// Half the width of a box that stands for a plane which moves, and its thickness [m].
constexpr double kHalfWidth = 1e4, kThickness = 1;

std::string vector_text(const Vector3& v) { return fmt::format("{} {} {}", v.x(), v.y(), v.z()); }

template <class Enum>
const char* word(Enum value, std::initializer_list<const char*> words) {
  return words.begin()[static_cast<std::size_t>(value)];
}

bool has_stage(const Scene& scene) {
  return std::ranges::any_of(peer::surfaces_of(scene), &peer::Surface::moves) ||
         std::ranges::any_of(scene.surfaces, [](const slipcheck::Surface& each) {
           return !each.motion.is_still();
         });
}

void put_options(Text& text, const MujocoSetup& setup) {
  const MujocoSettings& chosen = setup.settings;
  const Scene& scene = setup.scene;
  put(text,
      "<option timestep=\"{}\" gravity=\"{} {} {}\" cone=\"{}\" impratio=\"{}\" solver=\"{}\" "
      "iterations=\"{}\" tolerance=\"{}\" noslip_iterations=\"{}\" integrator=\"{}\"/>\n",
      setup.time_step / chosen.substeps, scene.downhill.x(), scene.downhill.y(), -scene.gravity,
      word(chosen.cone, {"pyramidal", "elliptic"}), chosen.impratio,
      word(chosen.solver, {"PGS", "CG", "Newton"}), chosen.iterations, chosen.tolerance,
      chosen.noslip_iterations, word(chosen.integrator, {"Euler", "RK4", "implicit"}));
  // The solver's tolerance is relative to a mean inertia, in which a stage would be all.
  if (has_stage(scene)) put(text, "<statistic meaninertia=\"{}\"/>\n", scene.bodies.front().mass);
}

std::string quaternion_text(const Eigen::Quaterniond& q) {
  return fmt::format("quat=\"{} {} {} {}\" ", q.w(), q.x(), q.y(), q.z());
}

/// The shape and inertia of a body, turned in it: its axes are the world's at the start.
void put_solid(Text& text, const Sphere& body, const Extent& extent, const std::string& name) {
  const Vector3 half = extent.size / 2;
  const bool is_block = body.shape == Shape::block;
  const Eigen::Quaterniond turn = turn_of(extent);
  put(text, "<inertial pos=\"0 0 0\" mass=\"{}\" {}diaginertia=\"{}\"/>\n", body.mass,
      quaternion_text(turn), vector_text(moments_of_inertia(body, extent)));
  put(text, "<geom name=\"{}\" type=\"{}\" size=\"{}\" {}contype=\"0\" conaffinity=\"0\"/>\n", name,
      is_block ? "box" : "cylinder",
      is_block ? vector_text(half) : fmt::format("{} {}", half.y(), half.x()),
      quaternion_text(is_block ? turn : turn * turn_of_z_to_x()));
  put(text, "</body>\n");
}

void put_ball(Text& text, const Scene& scene, const BodyState& state, std::size_t i) {
  const Sphere& sphere = scene.bodies[i];
  const std::string name = ball_name(i);
  put(text, "<body pos=\"{}\">\n", vector_text(state.position));
  if (scene.box) {
    put(text, "<joint name=\"{}\" type=\"slide\" axis=\"1 0 0\"/>\n", name);
    put(text, "<joint type=\"slide\" axis=\"0 0 1\"/><joint type=\"hinge\" axis=\"0 1 0\"/>\n");
  } else {
    put(text, "<freejoint name=\"{}\"/>\n", name);
  }
  if (!scene.extents.empty() && scene.extents[i])
    return put_solid(text, sphere, *scene.extents[i], name);
  const double moment = sphere.moment_of_inertia();
  put(text, "<inertial pos=\"0 0 0\" mass=\"{}\" diaginertia=\"{} {} {}\"/>\n", sphere.mass, moment,
      moment, moment);
  put(text, "<geom name=\"{}\" type=\"sphere\" size=\"{}\" contype=\"0\" conaffinity=\"0\"/>\n",
      name, sphere.radius);
  put(text, "</body>\n");
}

void put_surface(Text& text, const peer::Surface& surface, std::size_t k) {
  const double depth = surface.moves ? kThickness / 2 : 0;
  const Vector3 place = (surface.offset - depth) * surface.normal;
  put(text, "<geom name=\"{}\" type=\"{}\" size=\"{}\" pos=\"{}\" zaxis=\"{}\" ", surface_name(k),
      surface.moves ? "box" : "plane",
      surface.moves ? fmt::format("{0} {0} {1}", kHalfWidth, depth) : "0 0 1", vector_text(place),
      vector_text(surface.normal));
  put(text, "contype=\"0\" conaffinity=\"0\"/>\n");
}

void put_surfaces(Text& text, const Scene& scene, const std::vector<peer::Surface>& surfaces) {
  for (std::size_t k = 0; k < surfaces.size(); ++k)
    if (!surfaces[k].moves) put_surface(text, surfaces[k], k);
  if (!std::ranges::any_of(surfaces, &peer::Surface::moves)) return;
  put(text, "<body>\n");
  if (scene.box) {
    put(text, "<joint name=\"stage_z\" type=\"slide\" axis=\"0 0 1\"/>\n");
  } else {
    put(text, "<joint name=\"stage_x\" type=\"slide\" axis=\"1 0 0\"/>\n");
    put(text, "<joint name=\"stage_y\" type=\"slide\" axis=\"0 1 0\"/>\n");
  }
  put(text, "<inertial pos=\"0 0 0\" mass=\"{0}\" diaginertia=\"{0} {0} {0}\"/>\n",
      stage_mass(scene));
  for (std::size_t k = 0; k < surfaces.size(); ++k)
    if (surfaces[k].moves) put_surface(text, surfaces[k], k);
  put(text, "</body>\n");
}

/// Half of a plate's thickness, of the shorter of its half sides.
constexpr double kPlateThickness = 1e-9;

/// Type and size of a geom in the surface's own frame.
struct GeomOf {
  bool driven;
  std::string operator()(const PlaneShape&) const {
    return driven ? fmt::format("type=\"box\" size=\"{0} {0} {1}\"", kHalfWidth, kThickness / 2)
                  : "type=\"plane\" size=\"0 0 1\"";
  }
  std::string operator()(const RectangleShape& plate) const {
    return fmt::format("type=\"box\" size=\"{}\"",
                       vector_text(peer::half_sizes(plate, kPlateThickness)));
  }
  std::string operator()(const RodShape& rod) const {
    return fmt::format("type=\"cylinder\" size=\"{} {}\"", rod.radius,
                       0.5 * (rod.end - rod.begin).norm());
  }
  std::string operator()(const BallShape& ball) const {
    return fmt::format("type=\"sphere\" size=\"{}\"", ball.radius);
  }
};

/// Those that move or pass by are bodies of their own, so heavy that nothing turns or stops them.
void put_beside(Text& text, const Scene& scene) {
  constexpr double kGyration = 100;  // radius of [m]
  for (std::size_t k = 0; k < scene.surfaces.size(); ++k) {
    const slipcheck::Surface& surface = scene.surfaces[k];
    const bool driven = !surface.motion.is_still();
    const peer::SurfaceFrame frame = frame_beside(surface, 0);
    const std::string place =
        fmt::format("pos=\"{}\" {}", vector_text(frame.centre), quaternion_text(frame.turn()));
    const double mass = stage_mass(scene), moment = mass * kGyration * kGyration;
    if (driven)
      put(text,
          "<body {0}><freejoint name=\"{1}\"/>\n<inertial pos=\"0 0 0\" mass=\"{2}\" "
          "diaginertia=\"{3} {3} {3}\"/>\n",
          place, beside_name(k), mass, moment);
    put(text, "<geom name=\"{}\" {} {}contype=\"0\" conaffinity=\"0\"/>\n{}", beside_name(k),
        std::visit(GeomOf{driven}, surface.shape), driven ? "" : place, driven ? "</body>\n" : "");
  }
}

int dimensions(const MujocoSettings& chosen, const peer::ContactValues& values) {
  if (chosen.condim > 0) return chosen.condim;
  if (values.rolling > 0) return 6;
  if (values.drilling > 0) return 4;
  return values.friction > 0 ? 3 : 1;
}

/// What a pair's solref and solimp say in XML.
struct Reference {
  std::string solref, solimp;
};

Reference reference(const MujocoSetup& setup, double restitution) {
  const MujocoSettings& chosen = setup.settings;
  if (chosen.restitution == RestitutionMap::none || restitution == 0)
    return {fmt::format("{} {}", chosen.solref_timeconst, chosen.solref_dampratio),
            fmt::format("{} {} {}", chosen.solimp_dmin, chosen.solimp_dmax, chosen.solimp_width)};
  const double step = setup.time_step / chosen.substeps;
  const Spring spring = spring_of(restitution, chosen.contact_steps * step);
  // A spring is what it says as far as d is 1. MuJoCo divides stiffness by d² and damping by d.
  constexpr double d = 0.9999;  // mjMAXIMP
  return {fmt::format("{} {}", -spring.stiffness * d * d, -spring.damping * d),
          fmt::format("{} {} {}", d, d, chosen.solimp_width)};
}

void put_pair(Text& text, const MujocoSetup& setup, int body, int other, const std::string& first,
              const std::string& second) {
  const MujocoSettings& chosen = setup.settings;
  const peer::ContactValues values = values_of(setup, body, other);
  const Reference pair = reference(setup, values.restitution);
  put(text,
      "<pair geom1=\"{0}\" geom2=\"{1}\" condim=\"{2}\" friction=\"{3} {3} {4} {5} {5}\" "
      "solref=\"{6}\" solimp=\"{7}\" margin=\"{8}\"/>\n",
      first, second, dimensions(chosen, values), values.friction, values.drilling, values.rolling,
      pair.solref, pair.solimp, chosen.margin);
}

void put_pairs(Text& text, const MujocoSetup& setup, const std::vector<peer::Surface>& surfaces) {
  const std::size_t bodies = setup.scene.bodies.size();
  for (std::size_t i = 0; i < bodies; ++i) {
    for (std::size_t k = 0; k < surfaces.size(); ++k)
      put_pair(text, setup, static_cast<int>(i), surfaces[k].index, surface_name(k), ball_name(i));
    for (std::size_t k = 0; k < setup.scene.surfaces.size(); ++k)
      put_pair(text, setup, static_cast<int>(i), surface_touch(k), beside_name(k), ball_name(i));
    for (std::size_t j = i + 1; j < bodies; ++j)
      put_pair(text, setup, static_cast<int>(i), static_cast<int>(j), ball_name(i), ball_name(j));
  }
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

std::string ball_name(std::size_t body) { return fmt::format("ball{}", body); }
std::string surface_name(std::size_t surface) { return fmt::format("surface{}", surface); }

std::string beside_name(std::size_t surface) { return fmt::format("beside{}", surface); }

peer::SurfaceFrame frame_beside(const slipcheck::Surface& surface, double time) {
  const bool boxed =
      std::holds_alternative<PlaneShape>(surface.shape) && !surface.motion.is_still();
  return peer::frame_at(surface, time).behind(boxed ? kThickness / 2 : 0);
}

peer::ContactValues values_of(const MujocoSetup& setup, int body, int other) {
  peer::ContactValues typed = peer::typed_values(setup.scene, body, other);
  if (setup.settings.coefficients == CoefficientMap::fields) return typed;
  peer::ContactValues values = peer::exact_values(setup.scene, body, other, {});
  values.restitution = typed.restitution;  // one number of a law
  return values;
}

double stage_mass(const Scene& scene) {
  double mass = 0;
  for (const Sphere& body : scene.bodies) mass += body.mass;
  return 1e6 * mass;
}

std::string mjcf(const MujocoSetup& setup, std::span<const BodyState> states) {
  const std::vector<peer::Surface> surfaces = peer::surfaces_of(setup.scene);
  Text text;
  put(text, "<mujoco>\n<compiler angle=\"radian\"/>\n");
  put_options(text, setup);
  put(text, "<worldbody>\n");
  put_surfaces(text, setup.scene, surfaces);
  put_beside(text, setup.scene);
  for (std::size_t i = 0; i < states.size(); ++i) put_ball(text, setup.scene, states[i], i);
  put(text, "</worldbody>\n<contact>\n");
  put_pairs(text, setup, surfaces);
  put(text, "</contact>\n</mujoco>\n");
  return fmt::to_string(text);
}

Model compile(const std::string& mjcf) {
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "scene.xml", static_cast<int>(mjcf.size()));
  std::memcpy(files->filedata[0], mjcf.data(), mjcf.size());
  std::array<char, 1000> error{};
  Model model(mj_loadXML("scene.xml", files.get(), error.data(), static_cast<int>(error.size())));
  mj_deleteVFS(files.get());
  if (!model) throw Refused(fmt::format("mujoco: {}", first_line(error.data())));
  return model;
}

}  // namespace slipcheck::mujoco
