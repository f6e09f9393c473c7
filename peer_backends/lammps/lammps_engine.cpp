#include "peer_backends/lammps/lammps_engine.h"

#include <fmt/format.h>

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "engine/scene_needs.h"
#include "peer_backends/lammps/lammps_input.h"
#include "peer_backends/lammps/lammps_process.h"
#include "peer_backends/lammps/springs.h"
#include "peer_backends/shared/applied.h"
#include "peer_backends/shared/momentum_touches.h"
#include "peer_backends/shared/moving_frame.h"

namespace slipcheck::lammps {
namespace {

/// "29 Sep 2021 - Update 2", from the first line of `lmp -h` that holds it.
std::string lammps_version() {
  std::string version = "unknown";
  FILE* help = popen("lmp -h 2>/dev/null", "r");
  if (!help) return version;
  char line[512];
  const std::string mark = "Simulator - ";
  while (std::fgets(line, sizeof line, help)) {
    const std::string text = line;
    const std::size_t at = text.find(mark);
    if (at != std::string::npos)
      version = text.substr(at + mark.size(), text.find_last_not_of("\r\n") + 1 - at - mark.size());
  }
  pclose(help);
  return version;
}

void refuse_what_cannot_be(const Scene& scene) {
  if (scene.box)
    throw Refused("lammps: the walls of a box are shaken and fix wall/gran knows no table of them");
  if (!scene.surfaces.empty() && !scene.motion.is_still())
    throw Refused("lammps: the substrate moves beside surfaces, and the world is seen from it");
  for (const Sphere& body : scene.bodies)
    if (body.shape_factor != 0.4)
      throw Refused(fmt::format(
          "lammps: atoms of style sphere are solid, I = 2/5 m R², and the scene has {} m R²",
          body.shape_factor));
}

std::vector<Lack> not_represented(const EngineScene& scene, const LammpsSettings& settings,
                                  double time_step) {
  const SceneNeeds needs = needs_of(scene, time_step);
  const bool fields = settings.coefficients == Coefficients::fields;
  bool any_hard = false, apart = false, low = false, two_coefficients = needs.static_friction;
  const auto remembered = [&](const SoftContact* soft) {
    if (!soft || !soft->memory) return;
    const SpringFriction& sliding = soft->memory->sliding;
    two_coefficients |= sliding.static_friction != sliding.kinetic_friction;
  };
  for (const auto& [i, j] : material_pairs(scene)) {
    const SoftContact* soft = scene.soft_between(i, j);
    any_hard |= !soft;
    remembered(soft);
    const auto* viscous = soft ? std::get_if<ViscousForce>(&soft->tangential) : nullptr;
    apart |= viscous && viscous->friction > 0 && viscous->caps == ViscousForce::Caps::apart;
    const auto* e = std::get_if<double>(&scene.between(i, j).restitution);
    low |= !soft && e && *e < settings.lowest_restitution;
  }
  for (const std::size_t material : scene.material)
    low |=
        scene.has_substrate && scene.substrate[material].restitution < settings.lowest_restitution;
  for (const std::size_t body : peer::one_of_each_material(scene))
    for (std::size_t k = 0; k < scene.surfaces.size(); ++k) {
      const SoftContact* soft = scene.soft_on_surface(body, k);
      remembered(soft);
      any_hard |= !soft;
      low |=
          !soft && peer::typed_values(scene, static_cast<int>(body), surface_touch(k)).restitution <
                       settings.lowest_restitution;
    }
  const bool holds = holds_by_springs(scene, settings);
  LackList missing;
  missing.note(
      two_coefficients, lack::kStaticFriction,
      holds ? "one coefficient, the kinetic one" : "one coefficient, and damping below its limit");
  missing.note(needs.coupled_drilling, lack::kCoupledDrilling,
               "torque and friction are full, each by itself");
  missing.note(needs.rolling_only, lack::kRollingOnly, "it acts while sliding too");
  missing.note(needs.rolling_table, lack::kRollingTable);
  missing.note(any_hard && needs.bounce_law, lack::kRestitutionLaw);
  missing.note(any_hard && needs.reversed_slip && !holds, lack::kTangentialRestitution,
               "friction only stops the slip");
  missing.note(scene.confined, lack::kConfinement);
  missing.note(needs.through_in_a_step, lack::kThrough);
  if (low)
    missing.add({fmt::format("restitution below {:.3g}", settings.lowest_restitution),
                 "restitution below …"});
  missing.note(any_hard || scene.has_substrate, "contacts without duration",
               !any_hard             ? "the substrate is a spring"
               : scene.has_substrate ? "hard ones and the substrate are springs"
                                     : "hard ones are springs");
  missing.note(apart, "friction whose parts in the plane and across it have a limit each");
  missing.note(fields, "restitution of a linear spring", "damping tsuji is made for Hertz's force");
  missing.note(settings.pair_style != PairStyle::law, "the tangential force",
               "a spring acts beside the damping");
  return missing.take();
}

class LammpsEngine final : public Engine {
 public:
  EngineInfo info() const override {
    static const std::string version = lammps_version();
    return {"lammps",
            version,
            "double",
            infos_of(setting_rows()),
            {scene_part::kMany, scene_part::kSurfaces, scene_part::kMemory}};
  }

  Applied configure(const EngineScene& scene, const Settings& chosen, double time_step) override {
    const LammpsSettings settings = read_rows(setting_rows(), chosen);
    refuse_what_cannot_be(scene);
    const MovingFrame frame(scene, "lammps");
    const InnerSteps steps = inner_steps(scene, settings, time_step);
    input(scene, scene.initial, 0, settings, steps.length, "");  // refuses what cannot be said
    if (!process_ || settings.ranks != setup_->settings.ranks) {
      process_.reset();
      process_ = std::make_unique<LammpsProcess>(settings.ranks);
    }
    setup_.emplace(Setup{scene, settings, steps, time_step, frame});
    start(scene.initial, 0);
    return {applied(scene, settings, steps), not_represented(scene, settings, time_step), {}};
  }

  void start(std::span<const BodyState> states, double time) override {
    if (run_ && run_->blown_up)  // that LAMMPS has ended
      process_ = std::make_unique<LammpsProcess>(setup_->settings.ranks);
    run_ = std::make_unique<Run>();
    run_->states = setup_->frame.enter(states, time);
    run_->start = time;
    const EngineScene& scene = setup_->scene;
    const std::string file =
        is_read(scene) ? process_->keep_file(data_text(scene, run_->states)) : "";
    process_->send(input(scene, run_->states, time, setup_->settings, setup_->steps.length, file) +
                   dump_command(scene, process_->snapshot_file()) + "run 0\n");
    process_->finish_run();
    process_->forget_file();
  }

  void step() override { ++run_->pending; }

  std::span<const Frame> parts() const override {
    const std::vector<Frame>& shown = look();
    return std::span(shown).first(shown.size() - 1);
  }

  void read(Frame& frame) const override { frame = look().back(); }

  /// A snapshot at the end alone, without its touches: of many bodies they cost more than the
  /// steps.
  void read_states(std::vector<BodyState>& states) const override {
    Run& run = *run_;
    if (run.pending > 0) {
      if (run.pending > 1) advance(run.pending - 1, 0);
      advance(1, setup_->steps.count);
      run.pending = 0;
      take_snapshot(run.taken);
      run.shown.clear();
      run.shown.emplace_back().bodies = left_states();
    }
    states = run.shown.back().bodies;
  }

  double cpu_seconds() const override {
    if (run_ && run_->pending > 0) advance(std::exchange(run_->pending, 0), 0);
    return cpu_seconds_;
  }

  /// mpirun tidies up where it may end; one rank leaves nothing anyway.
  void finish() override {
    if (setup_ && setup_->settings.ranks > 1) process_.reset();
  }

 private:
  struct Setup {
    EngineScene scene;
    LammpsSettings settings;
    InnerSteps steps;
    double time_step;
    MovingFrame frame;
  };
  /// A world in LAMMPS, as seen from the substrate.
  struct Run {
    std::vector<BodyState> states;  // in the last snapshot
    long seen = 0;                  // the step of LAMMPS's that it is of
    std::vector<Frame> shown;       // of the last step
    long pending = 0;               // steps that are asked for and not taken
    long taken = 0;                 // of LAMMPS's
    double start = 0;               // [s]
    bool blown_up = false;
  };

  /// The frames of the step that is pending, which is taken here; those of the last one where none
  /// is.
  const std::vector<Frame>& look() const {
    Run& run = *run_;
    if (run.pending == 0) return run.shown;
    const long each = setup_->steps.count / setup_->settings.frames;
    const double length = static_cast<double>(each) * setup_->steps.length;
    if (run.pending > 1) {
      advance(run.pending - 1, 0);
      run.pending = 1;
    }
    const long before = run.taken;
    advance(1, each);
    run.shown.clear();
    std::vector<BodyState> last = left_states();
    int parts = 0;  // since `last`
    for (int k = 1; k <= setup_->settings.frames; ++k) {
      take_snapshot(before + k * each);
      ++parts;
      const double now = run.start + static_cast<double>(run.seen) * setup_->steps.length;
      if (k < setup_->settings.frames && in_impact(setup_->scene, run.states, length, now))
        continue;
      Frame& frame = run.shown.emplace_back();
      frame.bodies = left_states();
      if (!run.blown_up)
        frame.touches = momentum_touches(setup_->scene, last, frame.bodies, parts * length,
                                         now - parts * length, OverlapPushes::yes);
      frame.part = k == setup_->settings.frames ? 1.0 : k / double(setup_->settings.frames);
      last = frame.bodies;
      parts = 0;
    }
    run.pending = 0;
    return run.shown;
  }

  /// The last snapshot, in the scene's frame.
  std::vector<BodyState> left_states() const {
    std::vector<BodyState> states = run_->states;
    setup_->frame.leave(states, static_cast<double>(run_->seen) * setup_->steps.length);
    return states;
  }

  /// So many steps in one run of LAMMPS's, with a snapshot every so many of its own; 0: none.
  void advance(long steps, long every) const {
    Run& run = *run_;
    if (run.blown_up) return;
    const long count = steps * setup_->steps.count;
    run.taken += count;
    attempt([&] {
      process_->send(fmt::format("dump_modify frames every {}\nrun {} pre no\n",
                                 every > 0 ? every : 1000000000, count));
      cpu_seconds_ += process_->finish_run();
    });
  }

  void take_snapshot(long step) const {
    run_->seen = step;
    attempt([&] { process_->read_snapshot(step, run_->states, run_->states.size()); });
  }

  /// A simulation that blows up is a result: from then on all places are NaN.
  void attempt(const std::function<void()>& call) const {
    if (run_->blown_up) return;
    try {
      call();
    } catch (const LammpsError& error) {
      const std::string reason = error.what();
      if (reason.find("Lost atoms") == std::string::npos &&
          reason.find("Non-numeric") == std::string::npos)
        throw;
      run_->blown_up = true;
      for (BodyState& state : run_->states)
        state.position.setConstant(std::numeric_limits<double>::quiet_NaN());
    }
  }

  std::optional<Setup> setup_;
  std::unique_ptr<LammpsProcess> process_;
  std::unique_ptr<Run> run_;
  mutable double cpu_seconds_ = 0;
};

}  // namespace

std::unique_ptr<Engine> make_lammps_engine() { return std::make_unique<LammpsEngine>(); }

}  // namespace slipcheck::lammps
