#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "base/match.h"
#include "harness/observe/motion_quantities.h"
#include "physics/solid.h"
#include "report/charts/scene_charts.h"
#include "report/html/page_channel.h"
#include "report/html/page_data_parts.h"
#include "report/terminal/text.h"

namespace slipcheck {

using Json = nlohmann::json;

namespace {

// Bodies times frames: of one run, and of all runs on a page, which take about seven bytes each.
constexpr std::size_t kMostStatesOfRun = 640;
constexpr std::size_t kMostStatesOfPage = 30'000;
constexpr std::size_t kFewestFrames = 12;
constexpr std::array kDetails = {MotionDetail{64, true}, MotionDetail{40, true},
                                 MotionDetail{40, false}, MotionDetail{24, false},
                                 MotionDetail{16, false}};
constexpr std::size_t kTimeSteps = 20000;
constexpr std::size_t kSteps = 4000, kStepsOfMany = 500;  // of other channels
constexpr std::size_t kMostBodies = 50;  // of more there is no motion: too few frames to look at
constexpr std::size_t kMany = 20;        // bodies
constexpr double kNegligible = 1e-5;     // of the largest value of its kind in the run

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// A number of each frame, of one body.
template <typename Value>
Json channel_of(const std::vector<MotionFrame>& frames, double scale, const Value& value) {
  std::vector<double> values;
  values.reserve(frames.size());
  for (std::size_t k = 0; k < frames.size(); ++k) values.push_back(value(k));
  const bool many = frames[0].bodies.size() > kMany;
  return page_channel(values, kNegligible * scale, many ? kStepsOfMany : kSteps);
}

/// Evenly fewer frames; those in which two bodies have met and the ones before them stay, so that
/// a bounce is not cut off, as long as they are not most of them.
std::vector<MotionFrame> thinned(const std::vector<MotionFrame>& frames, std::size_t most) {
  if (frames.size() <= most) return frames;
  std::vector<bool> kept(frames.size(), false);
  std::size_t count = 0;
  const auto keep = [&](std::size_t k) {
    if (kept[k]) return;
    kept[k] = true;
    ++count;
  };
  keep(0);
  keep(frames.size() - 1);
  const auto met = [](const MotionFrame& frame) {
    return std::ranges::any_of(frame.touches, [](const auto& touch) { return touch.second >= 0; });
  };
  for (std::size_t k = 1; k < frames.size() && count + 2 <= most / 2; ++k)
    if (met(frames[k])) {
      keep(k - 1);
      keep(k);
    }
  const std::size_t left = most - count;
  for (std::size_t k = 1; k <= left; ++k) keep(k * (frames.size() - 1) / (left + 1));
  std::vector<MotionFrame> result;
  std::vector<std::pair<int, int>> touches;  // of frames that are left out, for the next one
  for (std::size_t k = 0; k < frames.size(); ++k) {
    touches.insert(touches.end(), frames[k].touches.begin(), frames[k].touches.end());
    if (!kept[k]) continue;
    result.push_back(frames[k]);
    std::ranges::sort(touches);
    touches.erase(std::unique(touches.begin(), touches.end()), touches.end());
    result.back().touches = std::exchange(touches, {});
  }
  return result;
}

/// The largest of each kind in a run; what is far below it is rounding.
struct Scales {
  double way = 0, spin = 0, speed = 0;
};

Scales scales_of(const Scene& scene, const std::vector<MotionFrame>& frames) {
  Scales scales;
  for (const MotionFrame& frame : frames)
    for (std::size_t i = 0; i < frame.bodies.size(); ++i) {
      const BodyState& body = frame.bodies[i];
      scales.way = std::max(scales.way, (body.position - frames[0].bodies[i].position).norm());
      scales.spin = std::max(scales.spin, body.angular_velocity.norm());
      scales.speed = std::max({scales.speed, body.velocity.norm(),
                               scene.bodies[i].radius * body.angular_velocity.norm()});
    }
  return scales;
}

std::size_t most_frames(std::size_t bodies, const MotionDetail& detail) {
  return std::clamp(kMostStatesOfRun / bodies, kFewestFrames, detail.frames);
}

bool is_shown(const RecordedMotion& motion, const MotionDetail& detail) {
  return detail.nearest || motion.role != "nearest";
}

Json run_motion(const Scene& scene, const RecordedMotion& recorded, int run,
                const MotionDetail& detail) {
  const std::size_t bodies = scene.bodies.size();
  RecordedMotion motion = recorded;
  motion.frames = thinned(recorded.frames, most_frames(bodies, detail));
  const std::vector<MotionFrame>& frames = motion.frames;
  const MotionQuantities shown = motion_quantities(scene, motion);
  const Scales scales = scales_of(scene, frames);

  std::vector<double> time;
  Json touches = Json::array();
  for (std::size_t k = 0; k < frames.size(); ++k) {
    time.push_back(frames[k].time);
    for (const auto& [first, second] : frames[k].touches)
      if (second >= 0) touches.push_back({k, first, second});
  }
  Json body_data = Json::array();
  for (std::size_t i = 0; i < bodies; ++i) {
    Json position = Json::array(), spin = Json::array(), slip = Json::array();
    for (int axis = 0; axis < 3; ++axis) {
      position.push_back(channel_of(
          frames, scales.way, [&](std::size_t k) { return frames[k].bodies[i].position[axis]; }));
      spin.push_back(channel_of(frames, scales.spin, [&](std::size_t k) {
        return frames[k].bodies[i].angular_velocity[axis];
      }));
    }
    for (int axis = 0; axis < (scene.surfaces.empty() ? 2 : 3); ++axis)
      slip.push_back(
          channel_of(frames, scales.speed, [&](std::size_t k) { return shown.slip[k][i][axis]; }));
    body_data.push_back({{"p", std::move(position)},
                         {"w", std::move(spin)},
                         {"speed", channel_of(frames, scales.speed,
                                              [&](std::size_t k) { return shown.speed[k][i]; })},
                         {"slip", std::move(slip)}});
  }
  const auto moved = [&](int axis) {
    return channel_of(frames, scales.way, [&](std::size_t k) { return frames[k].substrate[axis]; });
  };
  return {{"run", run},
          {"role", motion.role},
          {"phase", motion.phase},
          {"error", page_number(motion.error)},
          {"time", page_channel(time, 0, kTimeSteps)},
          {"substrate", {moved(0), moved(1)}},
          {"bodies", std::move(body_data)},
          {"energy", page_channel(shown.kinetic_energy)},
          {"touches", std::move(touches)}};
}

Json numbers_of(const Vector3& v) {
  return {page_number(v.x(), 9), page_number(v.y(), 9), page_number(v.z(), 9)};
}

Json surface_data(const NamedSurface& surface) {
  Json data = std::visit(Match{[](const PlaneShape& plane) -> Json {
                                 return {{"kind", "plane"},
                                         {"point", numbers_of(plane.point)},
                                         {"normal", numbers_of(plane.normal)}};
                               },
                               [](const RectangleShape& plate) -> Json {
                                 return {{"kind", "plate"},
                                         {"centre", numbers_of(plate.centre)},
                                         {"half_length", numbers_of(plate.half_length)},
                                         {"half_width", numbers_of(plate.half_width)}};
                               },
                               [](const RodShape& rod) -> Json {
                                 return {{"kind", "rod"},
                                         {"begin", numbers_of(rod.begin)},
                                         {"end", numbers_of(rod.end)},
                                         {"radius", page_number(rod.radius, 9)}};
                               },
                               [](const BallShape& ball) -> Json {
                                 return {{"kind", "ball"},
                                         {"centre", numbers_of(ball.centre)},
                                         {"radius", page_number(ball.radius, 9)}};
                               }},
                         surface.shape);
  data["name"] = printable(surface.name);
  std::visit(
      Match{[](const StillMotion&) {},
            [&](const BeltMotion& belt) { data["belt"] = numbers_of(belt.velocity); },
            [&](const SurfaceTranslation& moves) { data["velocity"] = numbers_of(moves.velocity); },
            [&](const SurfaceOscillation& wave) {
              data["amplitude"] = numbers_of(wave.amplitude);
              data["frequency"] = page_number(wave.frequency, 9);
              data["phase"] = page_number(wave.phase, 9);
            },
            [&](const SurfaceTurning& turn) {
              data["about"] = numbers_of(turn.about);
              data["rate"] = numbers_of(turn.rate);
            }},
      surface.motion);
  return data;
}

/// A body's name, radius and, unless it is a sphere, shape.
Json body_data(const Body& body, const Scene& scene, std::size_t index) {
  Json data = {{"name", printable(body.name)}, {"radius", page_number(body.sphere.radius, 9)}};
  if (scene.extents.empty() || !scene.extents[index]) return data;
  const Extent& extent = *scene.extents[index];
  const Eigen::Quaterniond turn = turn_of(extent);
  data["shape"] = {{"kind", scene.bodies[index].shape == Shape::block ? "block" : "cylinder"},
                   {"size", numbers_of(extent.size)},
                   {"turn",
                    {page_number(turn.x(), 9), page_number(turn.y(), 9), page_number(turn.z(), 9),
                     page_number(turn.w(), 9)}}};
  return data;
}

}  // namespace

MotionDetail motion_detail(const std::vector<SceneRecord>& scenes) {
  for (const MotionDetail& detail : kDetails) {
    std::size_t states = 0;
    for (const SceneRecord& scene : scenes) {
      const std::size_t bodies = scene.scenario.bodies.size();
      if (bodies == 0 || bodies > kMostBodies) continue;
      const std::size_t most = most_frames(bodies, detail);
      for (const EngineRecord& run : scene.runs)
        for (const RecordedMotion& motion : run.motions)
          if (is_shown(motion, detail)) states += bodies * std::min(most, motion.frames.size());
    }
    if (states <= kMostStatesOfPage) return detail;
  }
  return kDetails.back();
}

Json motion_page_data(const SceneRecord& scene, const MotionDetail& detail) {
  const bool any = scene.reference.motion || std::ranges::any_of(scene.runs, [](const auto& run) {
                     return !run.motions.empty();
                   });
  if (!any || !scene.scene || scene.scenario.bodies.empty() ||
      scene.scenario.bodies.size() > kMostBodies)
    return nullptr;
  const Scene& hard = scene.scene->hard;
  Json runs = Json::array();
  if (scene.reference.motion && fits_scene(hard, *scene.reference.motion))
    runs.push_back(run_motion(hard, *scene.reference.motion, -1, {}));
  for (std::size_t k = 0; k < scene.runs.size(); ++k)
    for (const RecordedMotion& motion : scene.runs[k].motions)
      if (is_shown(motion, detail) && fits_scene(hard, motion))
        runs.push_back(run_motion(hard, motion, static_cast<int>(k), detail));
  if (runs.empty()) return nullptr;

  Json bodies = Json::array();
  for (std::size_t i = 0; i < scene.scenario.bodies.size(); ++i)
    bodies.push_back(body_data(scene.scenario.bodies[i], hard, i));
  const auto* plane = std::get_if<Substrate>(&scene.scenario.surroundings);
  Json periodic;
  if (plane && plane->periodic) periodic = {plane->periodic->x(), plane->periodic->y()};
  Json surfaces = Json::array();
  for (const NamedSurface& surface : scene.scenario.surfaces)
    surfaces.push_back(surface_data(surface));
  return {{"bodies", std::move(bodies)},
          {"surfaces", std::move(surfaces)},
          {"tilt", page_number(plane ? plane->tilt * 180 / std::numbers::pi : 0)},
          {"substrate", plane != nullptr && plane->is_there},
          {"periodic", std::move(periodic)},
          {"gravity", page_number(scene.scenario.gravity.norm())},
          {"runs", std::move(runs)}};
}

}  // namespace slipcheck
