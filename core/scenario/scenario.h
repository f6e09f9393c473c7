#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/enum_names.h"
#include "physics/contact/hard_contact.h"
#include "physics/sphere.h"
#include "physics/surface.h"
#include "physics/vector.h"

namespace slipcheck {

/// Where in a file something stands, both counted from 1; 0 where unknown.
struct Location {
  int line = 0;
  int column = 0;
};

// One scene, format version 1 (docs/scenario-format.md). The fields are the YAML keys; all values
// are SI (angles in radians) whatever the file's units, and all defaults stand here.

struct Material {
  std::optional<double> density;        ///< [kg/m³], > 0; needed unless every body has a mass
  std::optional<double> young_modulus;  ///< Y [Pa], > 0
  std::optional<double> poisson_ratio;  ///< ν [-], in (−1, 0.5]
  /// A of B (23) [s], >= 0; an extension. Only a restitution `viscoelastic` needs it.
  std::optional<double> dissipation_time;
};

// --- normal contact models -----------------------------------------------------------------------

enum class EndsAt { zero_overlap, zero_force };

/// ε = min(1, coefficient (g/speed)^−exponent).
struct BridgesRestitution {
  double coefficient = 0.32;  ///< [-], > 0
  double exponent = 0.234;    ///< [-], >= 0
  double speed = 0.01;        ///< [m/s], > 0
};
/// ε over the impact speed from the viscoelastic model and the materials (B 24 until the overlap is
/// zero).
struct ViscoelasticRestitution {};

struct HardNormal {
  std::variant<double, BridgesRestitution, ViscoelasticRestitution> restitution = 1.0;  ///< [0, 1]
};
/// K (2). Exactly one of each pair is given.
struct LinearNormal {
  std::optional<double> restitution;     ///< e_n [-], (0, 1]
  std::optional<double> damping_rate;    ///< γ_N [1/s], >= 0
  std::optional<double> collision_time;  ///< t_col [s], > 0
  std::optional<double> stiffness;       ///< k [N/m], > 0
  EndsAt ends_at = EndsAt::zero_overlap;
};
struct HertzNormal {
  EndsAt ends_at = EndsAt::zero_overlap;
};
/// K (B1): F = modulus ξ^alpha + viscosity ξ^gamma ξ̇. Exactly one of viscosity and restitution.
struct PowerNormal {
  double modulus = 0;                 ///< [N/m^alpha], > 0
  std::optional<double> viscosity;    ///< [N s/m^(1+gamma)], >= 0
  std::optional<double> restitution;  ///< e_n [-], (0, 1], of an impact `at_speed`; an extension
  std::optional<double> at_speed;     ///< [m/s], > 0; with restitution and only then
  double alpha = 1.5;                 ///< [-], >= 1 (β of K B1)
  double gamma = 0.5;                 ///< [-], >= 0
  EndsAt ends_at = EndsAt::zero_overlap;
};
/// Exactly one of dissipation_time, viscosity and restitution.
struct ViscoelasticNormal {
  enum class Form { expanded, compact };               ///< B (24), B (25)
  std::optional<double> dissipation_time;              ///< A of B (23) [s], >= 0
  std::optional<std::pair<double, double>> viscosity;  ///< η1, η2 of B (23) [Pa s], >= 0
  std::optional<double> restitution;  ///< e_n [-], (0, 1], of an impact `at_speed`; an extension
  std::optional<double> at_speed;     ///< [m/s], > 0; with restitution and only then
  Form form = Form::expanded;
  EndsAt ends_at = EndsAt::zero_overlap;
};
using NormalModel =
    std::variant<HardNormal, LinearNormal, HertzNormal, PowerNormal, ViscoelasticNormal>;

// --- tangential contact models -------------------------------------------------------------------

struct NoTangential {};
/// K (4), (6); also Haff-Werner, B (39). Exactly one of the first two is given.
struct ViscousTangential {
  enum class Caps { together, apart };
  std::optional<double> damping_rate;   ///< γ_S [1/s], >= 0
  std::optional<double> damping_ratio;  ///< γ_S/γ_N [-], >= 0
  double friction = 0;                  ///< ν_s [-], >= 0
  /// Whether |F_T| is capped, or its parts in the plane and across it are, as K has it.
  Caps caps = Caps::together;
};
/// B (35), (37). Exactly one of friction and roughness_factor, exactly one kind of size.
struct AsperityTangential {
  enum class Form { printed, passive };
  std::optional<double> friction;                ///< μ [-], >= 0
  std::optional<double> roughness_factor;        ///< α in μ = α √ζ0 [m^−1/2], >= 0
  std::optional<double> asperity_size;           ///< ζ0 [m], > 0
  std::optional<double> relative_asperity_size;  ///< ζ0/R_eff [-], > 0
  Form form = Form::printed;
};
/// L (5)-(12).
struct HardTangential {
  FrictionLaw friction = {};  ///< μ [-], >= 0; a law is an extension, of hard contacts alone
  double tangential_restitution = 0;  ///< β0 [-], in [−1, 1]
};
/// Coefficients of Coulomb's friction.
struct FrictionCoefficients {
  double static_ = 0;  ///< μ_s [-], >= kinetic
  double kinetic = 0;  ///< μ_k [-], >= 0
};
/// Cundall and Strack: a spring beside a dashpot that gives way at Coulomb's cap. An extension.
/// Exactly one of the first two is given, and at most one damping.
struct SpringTangential {
  std::optional<double> stiffness;        ///< k_t [N/m], > 0
  std::optional<double> stiffness_ratio;  ///< k_t over the normal k [-], > 0
  std::optional<double> damping_rate;     ///< γ_S [1/s], >= 0
  std::optional<double> damping_ratio;    ///< c_t over the normal dashpot's [-], >= 0
  FrictionCoefficients friction;
};
/// Mindlin's contact of spheres that do not slip, from the materials, with the same cap. An
/// extension.
struct MindlinTangential {
  /// passive: the force falls with the stiffness; displacement: it is the present stiffness times
  /// the whole displacement.
  enum class Form { passive, displacement };
  double damping_ratio = 0;  ///< c_t over the normal dashpot's [-], >= 0
  FrictionCoefficients friction;
  Form form = Form::passive;
};
using TangentialModel = std::variant<NoTangential, ViscousTangential, AsperityTangential,
                                     HardTangential, SpringTangential, MindlinTangential>;

/// Resistance against rolling on each other: a spring that gives way. An extension.
struct RollingResistance {
  double friction = 0;                    ///< μ_r: largest torque over F_N R_eff [-], >= 0
  std::optional<double> stiffness;        ///< k_r: torque over R_eff² and angle [N/m], > 0
  std::optional<double> stiffness_ratio;  ///< k_r over the normal k [-], > 0
  double damping = 1;                     ///< of the critical one [-], >= 0
};

/// A body pair, or a body and floor, wall or lid of a container.
struct BodyContact {
  std::string first, second;  ///< materials; second may be "floor", "wall", "lid"
  NormalModel normal;
  TangentialModel tangential = NoTangential{};
  std::optional<RollingResistance> rolling;
  std::string path;  ///< of its keys in the file, as in "contacts[0]"
};

// --- contact with the substrate ------------------------------------------------------------------

using SubstrateFriction = FrictionCoefficients;
struct RollingLaw {
  /// (speed [m/s], μ_r [-]) with rising speeds, linear between and constant outside; one point is a
  /// constant. Never empty.
  std::vector<std::pair<double, double>> table = {{0, 0}};
  bool while_sliding = false;
};
struct Drilling {
  enum class Model { none, uncoupled, coupled };
  Model model = Model::none;
  std::optional<double> contact_radius;  ///< a_c [m], > 0; none: Hertzian, from the material
};
struct MaterialOnSubstrate {
  std::string material;
  SubstrateFriction friction;
  RollingLaw rolling;
  Drilling drilling;
  double restitution = 0;  ///< [-], in [0, 1]
  std::string path;        ///< of its keys in the file, as in "contacts[1]"
};

/// The same on surfaces of a material beside the substrate.
struct MaterialOnSurface : MaterialOnSubstrate {
  std::string surface;  ///< the surfaces' material
};

// --- surroundings --------------------------------------------------------------------------------

struct StillMotion {};
struct ConstantMotion {
  Vector2 velocity = Vector2::Zero();  ///< [m/s]
};
/// x_S(t) = amplitude sin(2π frequency t + phase).
struct OscillatingMotion {
  Vector2 amplitude = Vector2::Zero();  ///< [m]
  double frequency = 0;                 ///< [Hz], > 0
  double phase = 0;                     ///< [rad]
};
/// Positions x_S at rising times, linear between them.
struct TableMotion {
  struct Point {
    double time = 0;                     ///< [s]
    Vector2 position = Vector2::Zero();  ///< [m]
  };
  std::vector<Point> table;
};
using Motion = std::variant<StillMotion, ConstantMotion, OscillatingMotion, TableMotion>;

struct Substrate {
  bool is_there = true;             ///< false: there are only surfaces
  std::optional<Vector2> periodic;  ///< lengths of the periodic cell [m], > 0
  double tilt = 0;                  ///< [rad], in [0, π/2), downhill along −y
  bool confined = false;            ///< bodies never leave the plane
  Motion motion = StillMotion{};
};

/// L's vertical two-dimensional box; positions are (x, 0, z), z up from the floor's mean height.
struct Container {
  enum class Walls { fixed, moving };
  double width = 0;              ///< [m], > 0
  double floor_amplitude = 0;    ///< [m], >= 0
  double floor_frequency = 0;    ///< [Hz], >= 0
  Walls walls = Walls::fixed;    ///< moving: with the floor
  std::optional<double> height;  ///< closed by a lid at this height [m], > 0
};

// --- surfaces beside the substrate; an extension -------------------------------------------------

/// Matter passes by, along the surface; its shape stays where it is.
struct BeltMotion {
  Vector3 velocity = Vector3::Zero();  ///< [m/s]
};
struct SurfaceTranslation {
  Vector3 velocity = Vector3::Zero();  ///< [m/s]
};
/// x_S(t) = amplitude sin(2π frequency t + phase) from where the file has it.
struct SurfaceOscillation {
  Vector3 amplitude = Vector3::Zero();  ///< [m]
  double frequency = 0;                 ///< [Hz], > 0
  double phase = 0;                     ///< [rad]
};
struct SurfaceTurning {
  Vector3 about = Vector3::Zero();  ///< a point of the axis [m]
  Vector3 rate = Vector3::Zero();   ///< around itself [rad/s]
};
using SurfaceMotionModel =
    std::variant<StillMotion, BeltMotion, SurfaceTranslation, SurfaceOscillation, SurfaceTurning>;

struct NamedSurface {
  std::string name;
  std::string material;
  SurfaceShape shape;
  SurfaceMotionModel motion;
  std::string path;  ///< of its keys in the file, as in "surfaces[0]"
};

/// A cue's impulse, which made the velocity and spin that a body starts with.
struct Stroke {
  double impulse = 0;  ///< [N s]
  Vector3 direction = Vector3::UnitX();
};

struct Body {
  std::string name;
  std::string material;
  Sphere sphere;
  BodyState initial;
  // What few of many bodies have takes a pointer's room of the others; null: it has none.
  std::shared_ptr<const Extent> extent = {};  ///< where it is no sphere
  std::shared_ptr<const Stroke> stroke = {};
};

/// A value that a preset brought.
struct UsedPreset {
  std::string path;    ///< "contacts[0].rolling"
  std::string value;   ///< as it stands in the preset
  std::string preset;  ///< "pool-cloth"
  std::string source;  ///< where it is from
};

// --- inelastic collapse --------------------------------------------------------------------------

/// A pair that meets too slowly for the scene parts with the least speed that counts.
struct SlowestRebound {};
/// TC model of Luding and McNamara: a collision does not dissipate if one of the two had its last
/// one less than this ago.
struct ContactTimeModel {
  double contact_time = 0;  ///< t_c [s], > 0
};
/// Of bodies that collide again within this time the pair that approaches fastest goes first.
struct LargestVelocityModel {
  double contact_time = 0;  ///< [s], > 0
};
/// What keeps an endless cascade of ever weaker collisions finite; an extension.
using CollapseModel = std::variant<SlowestRebound, ContactTimeModel, LargestVelocityModel>;

// --- what is run and compared --------------------------------------------------------------------

struct Run {
  enum class Until { rolling, rest, time };
  Until until = Until::rolling;
  double time = 0;                      ///< [s], where until is `time`
  double limit = 60;                    ///< simulated time after which `until` has failed [s], > 0
  std::optional<std::int64_t> periods;  ///< of the floor, for a container
  std::int64_t discard = 0;             ///< periods before the first sample
  bool discard_until_steady = false;    ///< an extension: samples begin in the steady state
  bool sample_phase_zero = false;
  CollapseModel collapse = SlowestRebound{};
  /// An extension: more collisions, landings and ends of phases than this, each second and for each
  /// body, end the run [1/s], > 0.
  double most_events = 1e7;
};

struct Tolerance {
  double value = 0;  ///< >= 0; relative, or absolute for restitution coefficients
  /// The file gave a unit (an extension): the value is absolute, in SI.
  bool absolute = false;
  bool none = false;  ///< what it names is not judged (an extension)
};

/// How a run of an engine ended.
enum class RunStatus { ok, unstable, crashed, timed_out, skipped };
template <>
inline constexpr std::array kNamesOf<RunStatus> = {"ok", "unstable", "crashed", "timed_out",
                                                   "skipped"};

/// Where a statistic of an engine's ensemble is expected [SI].
struct ExpectedRange {
  double low = 0;
  double high = 0;  ///< >= low
};
/// What an engine is expected to show of an observable: at least one of the ranges, or `none`.
struct ExpectedObservable {
  std::optional<ExpectedRange> min, median, max;  ///< over the phases
  bool none = false;                              ///< it does not occur in any phase
};
/// What an engine is known to do in this scene, right or wrong; its runs are judged by this in
/// place of the tolerances. An extension.
struct Expectation {
  std::optional<RunStatus> status;  ///< none or one that is not `ok`; then nothing else is expected
  std::map<std::string, ExpectedObservable> observables;  ///< by full name, "i-j.restitution"
};

struct EngineRequest {
  enum class Precision { single_, double_ };
  std::string engine;
  std::optional<Precision> precision;  ///< none: that which is installed, of both the double one
  std::string profile = "default";
  std::vector<double> rates;  ///< steps per second [Hz], > 0
  std::optional<Expectation> expect;
  /// One of a grid of engines and profiles: an engine that lacks the profile is skipped.
  bool of_grid = false;
};

/// Every engine that is installed, in each of its precisions. An extension.
struct AllEngines {
  bool all = true;
  std::vector<std::string> profiles;  ///< where an engine has them; empty: default and physical
  std::vector<double> rates = {240, 1000};  ///< steps per second [Hz], > 0
};

inline constexpr int kMostHeadings = 360;

struct Compare {
  enum class Reference { automatic, event, contact, steps };  ///< steps: an extension
  Reference reference = Reference::automatic;
  double steps_per_contact = 200;  ///< of the reference `steps` [-], >= 10; an extension
  std::vector<EngineRequest> engines;
  std::optional<AllEngines> all_engines;  ///< in place of `engines`
  /// Headings in which each phase is run, evenly around the vertical, >= 1; an extension.
  std::size_t headings = 1;
  /// Lengths of the scenes that engines run over those of this one, > 0; an extension.
  std::vector<double> scales = {1};
  /// By what they judge: "restitution", or as an extension of one owner or of those that match,
  /// "i-j.restitution", "*-substrate.restitution". Which one holds is tolerance_of's to say.
  std::map<std::string, Tolerance> tolerance;
};

struct Scenario {
  std::string name;
  std::string title;
  std::string source;
  Vector3 gravity = Vector3(0, 0, -9.80665);  ///< in the substrate's frame [m/s²]
  std::map<std::string, Material> materials;
  std::vector<BodyContact> contacts;
  std::vector<MaterialOnSubstrate> substrate_contacts;
  std::vector<MaterialOnSurface> surface_contacts;
  std::variant<Substrate, Container> surroundings;
  std::vector<NamedSurface> surfaces;  ///< beside the substrate, or without one
  std::vector<Body> bodies;
  Run run;
  Compare compare;
  std::vector<UsedPreset> presets;

  std::string file;    ///< as it was named by the user
  std::string text;    ///< the file's bytes
  std::string sha256;  ///< of them, in hex
  /// Where each key stands in the file, by its path, as in "contacts[0].normal.model".
  std::map<std::string, Location> locations;
};

}  // namespace slipcheck
