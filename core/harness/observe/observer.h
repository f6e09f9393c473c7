#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <unordered_map>
#include <vector>

#include "base/state_archive.h"
#include "harness/observe/falling_quantity.h"
#include "harness/observe/observables.h"
#include "physics/frame.h"
#include "reference/spring_speeds.h"
#include "scene/scene.h"

namespace slipcheck {

/// Below what a quantity counts as zero, for one body.
struct Resolution {
  double slip = 0;  ///< [m/s]
  /// The same for a body that slides already, and has not turned back; less where it would stick by
  /// a spring [m/s].
  double lasting_slip = 0;
  double left_slip = 0;  ///< what a rolling body of an engine may keep of it in every step [m/s]
  double rise = 0;       ///< [m/s]
  double speed = 0;      ///< [m/s]
  double spin = 0;       ///< about the vertical [rad/s]
};

/// Turns the frames of a run, of the reference or of an engine, into observables while it goes on;
/// nothing grows with the run's length.
///
/// The reference shows its frames at the events themselves (`step` = 0). An engine shows one frame
/// a step: a collision ends with the last step that pushes the bodies apart, and what ends inside a
/// step (the slip, the speed, the spin) is found from how it fell before. What counts as zero is
/// half of what friction takes in a step, since friction stops a body inside a step; but slip that
/// the next step takes away too was still sliding, and so the next frame is waited for.
///
/// A body is on the substrate while it touches it and neither comes down nor leaves by more than
/// what gravity adds in a step: one that bounces flies. It rolls once two steps show no vertical
/// speed, or ten no flight, as some engines never come to rest.
///
/// A contact of two bodies is a collision if it closes faster than 7 % of the pair's fastest
/// collision so far and 0.1 % of the scene's speed, spins left out; weaker ones are rattling. A
/// collision that the reference resolves in time lasts from the frame before the first of
/// consecutive frames in which the pair touches to the last of them, whatever happens in between.
/// Two bodies that overlap in the first frame collide from there on for as long as they touch.
///
/// Slip, rest and the ways to both are relative to the substrate, which may move; velocities and
/// final positions are those of the laboratory.
class Observer final : public FrameSink {
 public:
  /// step [s], >= 0; speed_scale [m/s] as of event_solver.h. `resolved`: the reference's contacts
  /// of bodies last, so that their duration, overlap and what happens in them are observed.
  /// springs: of what carries the bodies, by body; empty: nothing gives way.
  Observer(const Scene& scene, double step, double speed_scale, bool resolved = false,
           std::vector<SpringSpeeds> springs = {});

  void take(double time, const Frame& frame) override;
  /// Of hard contacts where substrate and surfaces are still: what happens to a body then shows in
  /// its own events.
  bool take_partial(double time, const PartialFrame& frame) override;

  /// What it goes on with, of the same scene.
  void exchange(StateArchive& archive);

  /// What closes slower than this is no collision [m/s].
  double weakest_collision() const { return kOfSceneSpeed * closing_scale_; }

  bool anything_slides_or_flies() const;
  /// Two bodies, or one and a surface, are in the middle of a collision, where they may show no
  /// slip and no speed for an instant.
  bool anything_collides() const;
  bool everything_rests() const;
  /// States now, as they would be if each body rolled on what carries it, and nothing of slip and
  /// height were left that an engine leaves.
  std::vector<BodyState> rolling(double time, std::vector<BodyState> states) const;
  /// When the last body stopped to slide or landed, or came to rest [s].
  double last_slide_end() const;
  double last_stop() const;

  /// Collisions that lasted until now are over: else that shows only in a frame without the touch.
  void end_collisions();

  /// The observables of a run that ended at `end` [s], in the last interval or after it.
  Observables finish(double end) const;

 private:
  /// A collision closes at least at these fractions of the pair's fastest and of the scene's speed.
  static constexpr double kOfPairsFastest = 0.07;
  static constexpr double kOfSceneSpeed = 1e-3;
  /// It goes on in an engine while it drives the bodies apart by this fraction of what its mean
  /// force so far does.
  static constexpr double kOfMeanForce = 0.003;
  /// Reached by the tenth and the second frame where frames show whole steps; half a step less than
  /// that is for rounding.
  static constexpr double kSupportedSteps = 9.5, kQuietSteps = 1.5;
  /// Of gravity's speed in a step: what an engine leaves to a body that stays on the substrate.
  static constexpr double kQuiet = 0.05;
  /// What an engine leaves in a quantity that should be zero, of the scene's speed.
  static constexpr double kEngineNoise = 1e-5;
  static constexpr double kRoundOff = 1e-12;
  /// What an integration leaves in the slip of a body that sticks.
  static constexpr double kIntegrationError = 1e-9;
  /// Of SpringSpeeds::slip, what a body that sticks may keep: its spring turns with it and follows
  /// its friction.
  static constexpr double kTurnedSpring = 0.02;
  /// Slip that shares its friction with a spin dies out exponentially: below this fraction of the
  /// scene's speed it has ended.
  static constexpr double kCoupledSlip = 1e-6;

  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  /// The substrate at one instant.
  struct Ground {
    Vector3 position = Vector3::Zero(), velocity = Vector3::Zero();
  };
  /// The flags first, in a row: two bodies are a kilobyte, which the heap gives at once.
  struct Body {
    bool supported = true, sliding = false, resting = false, spinning = false;
    bool began_on_plane = true, touched = false, collided_now = false;
    bool spun = false;
    bool jumping = false;
    bool collided = false;
    /// The slide has ended with some slip left; the next frame tells whether it went on. The rest
    /// of the step is then part of it.
    bool faint = false;
    /// Steps in succession on the substrate, and among them those without a vertical speed; the
    /// first frame is one.
    double supported_steps = 0, quiet_steps = 0;
    int base = kSubstrate;  ///< what carries it, or did last
    int landed_on = kSubstrate;
    std::uint32_t last_pair = kNone;  ///< of the last collision, an index of pairs_
    Resolution zero;
    double seen = 0;  ///< the time of its last frame [s]
    double origin_time = 0;
    Vector3 origin = Vector3::Zero();  ///< over the substrate, as are all ways below
    double hop_end = 0;  ///< the last frame that shows the end of a bounce too small for a flight
    double faint_time = 0;
    Vector3 faint_way = Vector3::Zero();
    Vector3 up = kUp;  ///< the base's normal there
    FallingQuantity slip, speed, spin;
    double slide_end = 0, slide_time = 0;
    Vector3 slide = Vector3::Zero();
    Vector3 rolling_velocity = kVectorNotObserved;
    double stop_time = kNotObserved, spin_stop_time = kNotObserved;
    Vector3 stop_position = kVectorNotObserved;
    double unsupported_since = kNotObserved, unsupported_height = 0;
    double lift_off_time = 0, lift_off_speed = kNotObserved, lift_off_height = 0;
    double peak = 0, flight_time = kNotObserved;
    // The last collision.
    BodyState after;
    Vector3 slip_after = Vector3::Zero();
    double collision_begin = 0, collision_height = 0;
    Vector3 away = Vector3::Zero();  ///< n from the other body
    double fall_speed = 0;           ///< of the last landing, for the pair with the substrate
    double landing_restitution = kNotObserved;
    double fastest_landing = 0;
  };
  struct Pair {
    int first, second;   ///< bodies; second maybe a surface_touch()
    double fastest = 0;  ///< approach of its collisions so far [m/s]
    bool touched_before = false, touched_now = false, colliding = false, collided = false;
    bool from_start = false;      ///< it overlaps since the first frame
    bool awaits_rolling = false;  ///< for the effective restitution
    Vector3 n = Vector3::Zero();
    double approach = 0;
    Vector3 tangential = Vector3::Zero();
    double restitution = kNotObserved, tangential_restitution = kNotObserved;
    double effective = kNotObserved;
    double begin_time = 0, contact_time = 0, max_overlap = 0;
    double end_time = 0;  ///< of its last step so far [s]
    double blows = 0;     ///< half of what they changed of the relative velocity [m/s]
    bool slid_before = false;
    double sliding_onset = kNotObserved;
  };

  void begin(double time, const Frame& frame);
  void note_substrate(std::span<const Touch> touches, double t1, std::span<const BodyState> now);
  /// What body i has done since it was last seen.
  void follow(std::size_t i, double t1, const Frame& frame);
  void look_at_ground(double t0, double t1);
  /// The same of what carries one body, beside surfaces.
  void look_at_ground_of(std::size_t i, double t0, double t1, const BodyState& now);
  void keep_frames_of_the_end();
  bool touches_substrate(std::size_t i, double t1, const Frame& frame) const;
  void follow_support(Body& body, bool touches, double t0, double t1, const BodyState& now) const;

  // What carries a body: the substrate, or beside surfaces that which it touches below itself.
  /// The speed at which it goes up [m/s].
  double rise(const Body& body, const BodyState& state) const {
    return on_surfaces_ ? body.up.dot(state.velocity) : state.velocity.z();
  }
  /// Of its centre [m], of which only differences mean something.
  double level(const Body& body, const BodyState& state) const {
    return on_surfaces_ ? body.up.dot(state.position) : state.position.z();
  }
  double spin(const Body& body, const BodyState& state) const {
    return on_surfaces_ ? body.up.dot(state.angular_velocity) : state.angular_velocity.z();
  }
  /// Between the body and what carries it [m].
  double gap(std::size_t i, double t, const BodyState& state) const;
  NearestPoint nearest(int base, double t, const BodyState& state) const;
  SubstrateContact contact_with(std::size_t i, int base) const;
  Resolution resolution(std::size_t i, const SubstrateContact& contact, double gravity) const;
  /// Where it can lie on a surface: that it does so from now on.
  bool take_base(std::size_t i, int base, double t, const BodyState& state);
  void find_base(std::size_t i, double t, const BodyState& state);

  /// The second of a pair: a body, or the place of a surface that the first touches.
  struct Side {
    Sphere sphere;
    BodyState state;
  };
  Side second_of(const Pair& pair, double t, const std::vector<BodyState>& states) const;
  template <class F>
  static void for_bodies_of(const Pair& pair, F f) {
    f(static_cast<std::size_t>(pair.first));
    if (is_body(pair.second)) f(static_cast<std::size_t>(pair.second));
  }

  /// On the substrate and not sliding, as far as the frames tell.
  bool rolls(const Body& body) const;
  void begin_overlaps(double time, const Frame& frame);
  void note_touches(double t0, double t1, const Frame& frame);
  void note_collision(Pair& pair, const Touch& touch, double t0, double t1, const Frame& frame);
  /// Whether this touch belongs to a collision, and whether it is the first.
  bool continues_or_begins(Pair& pair, const Touch& touch, double t0, double t1,
                           const Frame& frame);
  void resolve(Pair& pair, double t0, double t1, const Frame& frame);
  void follow_sliding(Body& body, std::size_t i, double t0, double t1, const Frame& frame);
  void follow_stopping(Body& body, std::size_t i, double t0, double t1, const Frame& frame);
  void lift_off(Body& body, double time, const BodyState& state) const;
  void follow_flight(Body& body, std::size_t i, bool touches, double t0, double t1,
                     const Frame& frame);
  void follow_landing(Body& body, std::size_t i, const Frame& frame);
  /// Both roll since they collided.
  bool has_settled(const Pair& pair) const;
  void settle_effective_restitution(Pair& pair, double t0, double t1, const Frame& frame);
  /// Over the substrate: the slip of the lowest point, the centre's velocity and position.
  Vector3 slip_of(std::size_t i, const BodyState& state, const Ground& ground) const;
  double slip_speed(std::size_t i, const BodyState& state, const Ground& ground) const {
    return slip_of(i, state, ground).norm();
  }
  bool slips(std::size_t i, const BodyState& state, const Ground& ground) const;
  static Vector3 velocity_over(const BodyState& state, const Ground& ground) {
    return state.velocity - ground.velocity;
  }
  static Vector3 position_over(const BodyState& state, const Ground& ground) {
    return state.position - ground.position;
  }
  /// Whether rolling friction could hold the body at rest.
  bool can_rest(std::size_t i, double time) const;
  std::size_t pair_of(int first, int second);  ///< an index of pairs_
  static std::uint64_t pair_key(int first, int second) {
    return (std::uint64_t{static_cast<std::uint32_t>(first)} << 32) |
           static_cast<std::uint32_t>(second);
  }
  /// From b's nearest image to a.
  Vector3 apart(const BodyState& a, const BodyState& b) const;
  double overlap(const Pair& pair, double t, const std::vector<BodyState>& states) const;

  const Scene* scene_;
  double step_;
  double speed_scale_;
  double closing_scale_;  ///< the same of centres alone [m/s]
  bool resolved_;
  bool on_surfaces_, is_all_still_;
  std::vector<SpringSpeeds> springs_;  ///< by body, or empty
  bool started_ = false;
  double time_ = 0, time_before_ = 0;
  Frame last_, before_last_;
  /// The frames around the latest end of a slide, or landing, once it is not between the last two.
  Frame end_before_, end_after_;
  double end_ = 0, end_time_before_ = 0, end_time_after_ = 0;
  bool end_is_kept_ = false;
  Ground ground0_, ground1_;  ///< at the start and at the end of the interval
  std::vector<Body> bodies_;
  std::vector<Pair> pairs_;
  std::unordered_map<std::uint64_t, std::size_t> pair_numbers_;
  std::vector<std::size_t> touching_;  ///< pairs that touched in the last frame
  /// Pairs that a partial frame may settle: of its bodies, or that have just parted.
  std::vector<std::size_t> settling_;
  /// All bodies as of the present partial frame; none where the last frame was whole.
  Frame now_;
};

}  // namespace slipcheck
