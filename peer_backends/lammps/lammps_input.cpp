#include "peer_backends/lammps/lammps_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "engine/engine.h"
#include "peer_backends/lammps/regions.h"
#include "peer_backends/lammps/springs.h"
#include "peer_backends/shared/applied.h"

namespace slipcheck::lammps {
namespace {

double smallest_radius(const Scene& scene) {
  return std::ranges::min_element(scene.bodies, {}, &Sphere::radius)->radius;
}

/// The springs of all pairs of types, the one for (a, b), a <= b, at its place in the triangle.
std::vector<Spring> pair_springs(const EngineScene& scene, const AtomTypes& types,
                                 const LammpsSettings& settings) {
  std::vector<Spring> springs;
  const std::size_t count = types.first_body.size();
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = a; b < count; ++b)
      springs.push_back(pair_spring(scene, types.first_body[a], types.first_body[b], settings));
  return springs;
}

/// gran/hooke and gran/hooke/history take rates of the reduced mass, one set for all types.
struct HookeCoefficients {
  double stiffness, shear, normal_rate, tangential_rate, friction;
  bool never_attracts;
  bool operator==(const HookeCoefficients&) const = default;
};

HookeCoefficients hooke_coefficients(const Spring& spring) {
  // gran/hertz/history: ρ = k √R_eff, and the damping is √(R_eff ξ) m_eff γ_n.
  const double unit = spring.hertz ? std::sqrt(spring.effective_radius) : 1;
  return {spring.stiffness / unit,         spring.shear,    spring.damping / (spring.mass * unit),
          spring.tangential / spring.mass, spring.friction, spring.never_attracts};
}

/// It takes coefficients up to 1e4, a limit that no force comes to.
std::string gran_style(const char* style, const Spring& spring) {
  constexpr double kMostFriction = 1e4;
  const HookeCoefficients c = hooke_coefficients(spring);
  return fmt::format(
      "pair_style {} {} {} {} {} {} 1{}\npair_coeff * *\n", style, exact(c.stiffness),
      c.shear > 0 ? exact(c.shear) : "NULL", exact(c.normal_rate), exact(c.tangential_rate),
      exact(std::min(c.friction, kMostFriction)), c.never_attracts ? " limit_damping" : "");
}

/// LAMMPS's tangential model of a spring, which multiplies k_t of Mindlin by √(R_eff ξ).
std::string shear_words(const Spring& spring) {
  using enum SpringFriction::Form;
  if (spring.shear == 0) return "linear_nohistory";
  if (spring.shear_form == constant) return "linear_history " + exact(spring.shear);
  return fmt::format("{} {}", spring.shear_form == mindlin ? "mindlin_rescale/force" : "mindlin",
                     exact(spring.shear / std::sqrt(spring.effective_radius)));
}

/// Rolling is a force at R_eff in LAMMPS, twisting a torque.
std::string torque_words(const Spring& spring) {
  const SpringTorque &rolling = spring.rolling, &drilling = spring.drilling;
  const double R = spring.effective_radius;
  std::string text;
  if (rolling.length > 0)
    text += fmt::format(" rolling sds {} {} {}", exact(rolling.stiffness / (R * R)),
                        exact(rolling.damping / (R * R)), exact(rolling.length / R));
  if (drilling.length > 0)
    text += fmt::format(" twisting sds {} {} {}", exact(drilling.stiffness),
                        exact(drilling.damping), exact(drilling.length));
  return text;
}

/// The words of pair style `granular` and of fix wall/gran for a spring. Their tangential damping
/// is a factor on the normal one, which so must not be zero.
std::string granular(const Spring& spring) {
  const double unit = spring.hertz ? std::sqrt(spring.effective_radius) : 1;
  const bool is_damped = spring.friction > 0 && spring.tangential > 0;
  std::string text =
      fmt::format("{} {}", spring.hertz ? "hertz" : "hooke", exact(spring.stiffness / unit));
  double factor = spring.tangential_ratio;
  if (spring.tsuji_restitution) {
    text += fmt::format(" {} damping tsuji", exact(*spring.tsuji_restitution));
    factor = 1;
  } else if (spring.hertz && spring.damping > 0) {
    text += fmt::format(" {} damping viscoelastic", exact(spring.damping / (spring.mass * unit)));
  } else {
    const double normal = std::max(spring.damping, is_damped ? 1e-9 * spring.tangential : 0.0);
    text += fmt::format(" {} damping velocity", exact(normal));
    if (is_damped) factor = spring.tangential / normal;
  }
  const bool slips = is_damped || spring.shear > 0 || spring.tangential_ratio > 0;
  text += fmt::format(" tangential {} {} {}", shear_words(spring), exact(factor),
                      exact(slips ? spring.friction : 0.0));
  return text + torque_words(spring) + (spring.never_attracts ? " limit_damping" : "");
}

std::string pair_commands(const EngineScene& scene, const AtomTypes& types,
                          const LammpsSettings& settings) {
  const std::vector<Spring> springs = pair_springs(scene, types, settings);
  const bool alike = std::ranges::all_of(springs, [&](const Spring& each) {
    return each.hertz == springs[0].hertz &&
           hooke_coefficients(each) == hooke_coefficients(springs[0]);
  });
  if (settings.pair_style != PairStyle::law) {
    const bool hertz = settings.pair_style == PairStyle::hertz_history;
    if (!alike || springs[0].hertz != hertz)
      throw Refused(
          fmt::format("lammps: {} has one set of coefficients for all pairs, {}",
                      hertz ? "gran/hertz/history" : "gran/hooke/history",
                      alike ? "of another law than the scene's" : "and the scene's pairs differ"));
    return gran_style(hertz ? "gran/hertz/history" : "gran/hooke/history", springs[0]);
  }
  const auto turns = [](const Spring& each) {
    return each.rolling.length > 0 || each.drilling.length > 0;
  };
  if (alike && !springs[0].hertz && !springs[0].tsuji_restitution &&
      springs[0].shear_form == SpringFriction::Form::constant &&
      std::ranges::none_of(springs, turns))
    return gran_style(springs[0].shear > 0 ? "gran/hooke/history" : "gran/hooke", springs[0]);
  std::string text = "pair_style granular\n";
  std::size_t place = 0;
  for (std::size_t a = 0; a < types.first_body.size(); ++a)
    for (std::size_t b = a; b < types.first_body.size(); ++b) {
      const Spring& spring = springs[place++];
      text += fmt::format("pair_coeff {} {} {}\n", a + 1, b + 1, granular(spring));
    }
  return text;
}

std::string wall_commands(const EngineScene& scene, const AtomTypes& types,
                          const LammpsSettings& settings) {
  std::string text;
  for (std::size_t type = 0; type < types.first_body.size(); ++type) {
    const std::size_t body = types.first_body[type];
    text += fmt::format("group type{0} type {0}\n", type + 1);
    const auto wall = [&](const std::string& of, const Spring& spring, const std::string& where) {
      text += fmt::format("fix {0}{1} type{1} wall/{2} granular {3} {4}\n", of, type + 1,
                          of == "wall" ? "gran" : "gran/region", granular(spring), where);
    };
    if (scene.has_substrate) wall("wall", substrate_spring(scene, body, settings), "zplane 0 NULL");
    for (std::size_t k = 0; k < scene.surfaces.size(); ++k)
      wall(fmt::format("beside{}_", k), surface_spring(scene, body, k, settings),
           fmt::format("region {}", region_name(k)));
  }
  return text;
}

/// A place inside the cell, and how many cells away it is.
std::pair<double, long> folded(double place, double length) {
  if (length == 0) return {place, 0};
  const double cells = std::floor(place / length);
  return {place - cells * length, static_cast<long>(cells)};
}

/// Its corners, the second beyond the first.
struct WorldBox {
  Vector3 low, high;
};

WorldBox world_box(const Scene& scene, std::span<const BodyState> states) {
  WorldBox box{Vector3::Zero(), Vector3::Zero()};
  const double margin = 2 * std::ranges::max_element(scene.bodies, {}, &Sphere::radius)->radius;
  for (int k = 0; k < 3; ++k) {
    const double cell = k < 2 ? scene.periodic[k] : 0;
    if (cell > 0) {
      box.high[k] = cell;
      continue;
    }
    for (const BodyState& state : states) {
      box.low[k] = std::min(box.low[k], state.position[k]);
      box.high[k] = std::max(box.high[k], state.position[k]);
    }
    box.low[k] -= margin;
    box.high[k] += margin;
  }
  return box;
}

/// Beyond so many bodies pairs are looked for in bins, which cost memory where bodies are far
/// apart.
constexpr std::size_t kBins = 400;

/// Bins want a box that is no thinner than a body is thick, which a layer's own is.
std::string boundary_command(const Scene& scene) {
  const char own = scene.bodies.size() > kBins ? 'm' : 's';
  return fmt::format("boundary {} {} {}\n", scene.periodic.x() > 0 ? 'p' : own,
                     scene.periodic.y() > 0 ? 'p' : own, own);
}

std::string box_commands(const Scene& scene, std::span<const BodyState> states, std::size_t types) {
  std::string text = boundary_command(scene) + "region world block";
  const WorldBox box = world_box(scene, states);
  for (int k = 0; k < 3; ++k)
    text += k < 2 && scene.periodic[k] > 0
                ? fmt::format(" 0 {}", exact(box.high[k]))
                : fmt::format(" {} {}", exact(box.low[k]), exact(box.high[k]));
  return text + fmt::format(" units box\ncreate_box {} world\n", types);
}

std::string atom_commands(const Scene& scene, std::span<const BodyState> states,
                          const AtomTypes& types) {
  std::string create, set;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto& [position, velocity, spin] = states[i];
    const auto [x, cells_x] = folded(position.x(), scene.periodic.x());
    const auto [y, cells_y] = folded(position.y(), scene.periodic.y());
    create += fmt::format("create_atoms {} single {} {} {} units box\n", types.of_body[i] + 1,
                          exact(x), exact(y), exact(position.z()));
    set += fmt::format("set atom {} diameter {} mass {} vx {} vy {} vz {} omega {} {} {}\n", i + 1,
                       exact(2 * scene.bodies[i].radius), exact(scene.bodies[i].mass),
                       exact(velocity.x()), exact(velocity.y()), exact(velocity.z()),
                       exact(spin.x()), exact(spin.y()), exact(spin.z()));
    if (scene.periodic.x() > 0)
      set += fmt::format("set atom {} image {} NULL NULL\n", i + 1, cells_x);
    if (scene.periodic.y() > 0)
      set += fmt::format("set atom {} image NULL {} NULL\n", i + 1, cells_y);
  }
  return create + set;
}

/// A file's density is rounded once more on its way to a mass: each type is given its own.
std::string read_commands(const Scene& scene, const AtomTypes& types, const std::string& file) {
  std::string text = boundary_command(scene) + fmt::format("read_data {}\n", file);
  for (std::size_t type = 0; type < types.first_body.size(); ++type)
    text += fmt::format("set type {} mass {}\n", type + 1,
                        exact(scene.bodies[types.first_body[type]].mass));
  return text;
}

/// Every two types have a line of coefficients.
constexpr std::size_t kMostTypes = 300;

void refuse_many_types(const AtomTypes& types) {
  if (types.first_body.size() > kMostTypes)
    throw Refused(
        fmt::format("lammps: each material, radius and mass is an atom type of its own, the scene "
                    "has {} of them, and there must be at most {}",
                    types.first_body.size(), kMostTypes));
}

std::string gravity_command(const Scene& scene) {
  const Vector3 gravity(scene.downhill.x(), scene.downhill.y(), -scene.gravity);
  if (gravity.isZero(0)) return "";
  // fix gravity makes a unit vector of the direction: along an axis it is exact.
  const bool level = scene.downhill.isZero(0);
  const Vector3 direction = level ? Vector3(0, 0, -1) : gravity;
  return fmt::format("fix weight all gravity {} vector {} {} {}\n",
                     exact(level ? scene.gravity : gravity.norm()), exact(direction.x()),
                     exact(direction.y()), exact(direction.z()));
}

/// The substrate that the world is seen from is shaken, so that bodies are the other way.
std::string shaking_command(const Scene& scene, double time) {
  const SubstrateMotion& motion = scene.motion;
  if (motion.kind() != SubstrateMotion::Kind::oscillation) return "";
  const double rate = 2 * std::numbers::pi * motion.frequency();
  const Vector2& amplitude = motion.vector();
  return fmt::format(
      "variable shaking equal \"{}*sin({}*({}+step*dt)+{})\"\n"
      "fix shaking all gravity v_shaking vector {} {} 0\n",
      exact(rate * rate * amplitude.norm()), exact(rate), exact(time), exact(motion.phase()),
      exact(amplitude.x()), exact(amplitude.y()));
}

}  // namespace

InnerSteps inner_steps(const EngineScene& scene, const LammpsSettings& settings, double time_step) {
  const auto steps_of = [&](double least) {
    const int count = settings.frames * static_cast<int>(std::ceil(least / settings.frames));
    return InnerSteps{count, time_step / count};
  };
  if (settings.substeps > 0) return steps_of(settings.substeps);
  const AtomTypes types = atom_types(scene);
  refuse_many_types(types);
  const double speed = approach_speed(scene);
  double shortest = std::numeric_limits<double>::infinity();
  const auto look_at = [&](const Spring& spring) {
    shortest = std::min(shortest, collision_time(spring, speed));
  };
  if (scene.bodies.size() > 1) std::ranges::for_each(pair_springs(scene, types, settings), look_at);
  for (const std::size_t body : types.first_body) {
    if (scene.has_substrate) look_at(substrate_spring(scene, body, settings));
    for (std::size_t k = 0; k < scene.surfaces.size(); ++k)
      look_at(surface_spring(scene, body, k, settings));
  }
  const double count = std::ceil(time_step / shortest * settings.steps_per_collision);
  if (!(count < 1e8))
    throw Refused(
        fmt::format("lammps: {:.3g} steps of its own in each step of {} s", count, time_step));
  return steps_of(std::max(1.0, count));
}

std::string input(const EngineScene& scene, std::span<const BodyState> states, double time,
                  const LammpsSettings& settings, double inner_step, const std::string& data_file) {
  const AtomTypes types = atom_types(scene);
  refuse_many_types(types);
  std::string text =
      "clear\nunits si\natom_style sphere\nnewton off\n"
      "comm_modify mode single vel yes\natom_modify sort 0 0\n";
  text += is_read(scene) ? read_commands(scene, types, data_file)
                         : box_commands(scene, states, types.first_body.size()) +
                               atom_commands(scene, states, types);
  text += pair_commands(scene, types, settings);
  text += fmt::format("neighbor {} {}\nneigh_modify delay 0 every 1 check yes\n",
                      exact(settings.skin * smallest_radius(scene)),
                      scene.bodies.size() > kBins ? "bin" : "nsq");
  text += "fix motion all nve/sphere\n" + gravity_command(scene) + shaking_command(scene, time);
  text += region_commands(scene, time);
  text += wall_commands(scene, types, settings);
  return text + fmt::format("timestep {}\nthermo 1000000000\n", exact(inner_step));
}

std::string data_text(const Scene& scene, std::span<const BodyState> states) {
  const AtomTypes types = atom_types(scene);
  const WorldBox box = world_box(scene, states);
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "spheres\n\n{} atoms\n{} atom types\n", states.size(),
                 types.first_body.size());
  for (int k = 0; k < 3; ++k)
    fmt::format_to(out, "{0:.17g} {1:.17g} {2}lo {2}hi\n", box.low[k], box.high[k], "xyz"[k]);
  fmt::format_to(out, "\nAtoms # sphere\n\n");
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Sphere& body = scene.bodies[i];
    const Vector3& position = states[i].position;
    const auto [x, cells_x] = folded(position.x(), scene.periodic.x());
    const auto [y, cells_y] = folded(position.y(), scene.periodic.y());
    const double volume = 4 * std::numbers::pi / 3 * std::pow(body.radius, 3);
    fmt::format_to(out, "{} {} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {} {} 0\n", i + 1,
                   types.of_body[i] + 1, 2 * body.radius, body.mass / volume, x, y, position.z(),
                   cells_x, cells_y);
  }
  fmt::format_to(out, "\nVelocities\n\n");
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Vector3 &v = states[i].velocity, &spin = states[i].angular_velocity;
    fmt::format_to(out, "{} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}\n", i + 1, v.x(), v.y(),
                   v.z(), spin.x(), spin.y(), spin.z());
  }
  return {text.data(), text.size()};
}

std::string dump_command(const Scene& scene, const std::string& file) {
  const char *x = scene.periodic.x() > 0 ? "xu" : "x", *y = scene.periodic.y() > 0 ? "yu" : "y";
  return fmt::format(
      "dump frames all custom 1000000000 {} id {} {} z vx vy vz omegax omegay omegaz\n"
      "dump_modify frames format float %.17g sort id flush yes\n",
      file, x, y);
}

Settings applied(const EngineScene& scene, const LammpsSettings& settings,
                 const InnerSteps& steps) {
  Settings all = write_rows(setting_rows(), settings);
  all["substeps"] = static_cast<double>(steps.count);
  all["timestep"] = steps.length;
  const auto tell = [&](const std::string& of, const Spring& spring) {
    all[of + "_stiffness"] = spring.stiffness;
    all[of + "_damping"] = spring.damping;
    all[of + "_tangential_damping"] = spring.tangential;
    all[of + "_friction"] = spring.friction;
    if (spring.shear > 0) all[of + "_tangential_stiffness"] = spring.shear;
    if (spring.rolling.length > 0) all[of + "_rolling_length"] = spring.rolling.length;
    if (spring.drilling.length > 0) all[of + "_twisting_length"] = spring.drilling.length;
  };
  if (scene.bodies.size() > 1) tell("pair", pair_spring(scene, 0, 1, settings));
  if (scene.has_substrate) tell("substrate", substrate_spring(scene, 0, settings));
  for (std::size_t k = 0; k < scene.surfaces.size(); ++k)
    for (const std::size_t body : peer::one_of_each_material(scene))
      tell(fmt::format("surface[{}-{}]", body, k), surface_spring(scene, body, k, settings));
  return all;
}

}  // namespace slipcheck::lammps
