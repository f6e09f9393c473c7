#include "engine/remote_engine.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "engine/scene_json.h"
#include "engine/scene_needs.h"

namespace slipcheck {

using Clock = WorkerProcess::Clock;
using Status = WorkerFailure::Status;

namespace {

// Long enough that the exchange costs little beside the steps, short enough that the first frames
// come soon and a slow engine is not taken for a dead one.
constexpr std::size_t kReplySize = std::size_t{1} << 20;

/// A message of bodies one by one holds so many: 64 MiB and 4 million items, of which each takes
/// about 140 bytes and 9 items.
constexpr std::size_t kMostOneByOne = 400'000;
/// More than so many go over in one piece where the worker takes that.
constexpr std::size_t kPackedFrom = 20'000;

/// Steps in one request: in a dense layer each body touches the substrate and three others.
std::size_t steps_at_once(std::size_t bodies) {
  const std::size_t frame = bodies * (protocol::kStateBytes + 4 * 16) + 4;
  return std::max<std::size_t>(1, kReplySize / frame);
}

}  // namespace

RemoteEngine::RemoteEngine(const WorkerCommand& command, const WorkerLimits& limits,
                           const std::atomic<bool>* stop)
    : process_(command, limits, stop), run_limit_(std::numeric_limits<double>::infinity()) {
  auto welcome = ask<protocol::Welcome>(protocol::Hello{});
  if (welcome.version != protocol::kVersion) {
    process_.fail(Status::crashed,
                  fmt::format("speaks protocol {}, not {}", welcome.version, protocol::kVersion));
  }
  info_ = std::move(welcome.info);
  if (takes(scene_part::kMany)) process_.allow_messages(protocol::kMaxOfMany);
}

template <class Expected>
Expected RemoteEngine::ask(const protocol::Request& request) {
  const protocol::Bytes body =
      process_.exchange(protocol::encode(request, process_.longest_message()), deadline_);
  protocol::Reply reply;
  try {
    reply = protocol::decode_reply(body, spare_);
  } catch (const protocol::Rubbish& rubbish) {
    process_.fail(Status::crashed, fmt::format("spoke rubbish: {}", rubbish.what()));
  }
  if (auto* refusal = std::get_if<protocol::Refusal>(&reply)) throw Refused(refusal->reason);
  if (auto* failed = std::get_if<protocol::Failed>(&reply)) {
    process_.fail(Status::crashed, fmt::format("failed: {}", failed->reason));
  }
  auto* expected = std::get_if<Expected>(&reply);
  if (expected == nullptr) process_.fail(Status::crashed, "spoke rubbish: not the reply asked for");
  return std::move(*expected);
}

Applied RemoteEngine::configure(const EngineScene& scene, const Settings& settings,
                                double time_step) {
  deadline_ = Clock::time_point::max();
  for (const std::string& shape : shapes_of(scene))
    if (!takes(shape))
      throw Refused(fmt::format("{}: it takes spheres alone here, and the scene has a {}",
                                info_.engine, shape));
  if ((!scene.surfaces.empty() || !scene.has_substrate) && !takes(scene_part::kSurfaces))
    throw Refused(fmt::format("{}: it knows no surfaces beside the substrate here", info_.engine));
  const bool simpler = needs_of(scene, time_step).friction_law && !takes(scene_part::kFrictionLaw);
  EngineScene given = scene;
  if (simpler) static_cast<Scene&>(given) = with_friction_numbers(scene);
  const bool forgets = scene.has_memory() && !takes(scene_part::kMemory);
  if (forgets) given.forget_memory();
  given.packed = (scene.packed || scene.bodies.size() > kPackedFrom) && scene.extents.empty() &&
                 takes(scene_part::kMany);
  if (!given.packed && scene.bodies.size() > kMostOneByOne)
    throw Refused(fmt::format("{}: the scene has {} bodies, and it takes {} at most", info_.engine,
                              scene.bodies.size(), kMostOneByOne));
  auto reply =
      ask<protocol::Configured>(protocol::Configure{std::move(given), settings, time_step});
  bodies_ = scene.bodies.size();
  surfaces_ = scene.surfaces.size();
  if (simpler) reply.applied.not_represented.push_back({lack::kFrictionLaw, lack::kFrictionLaw});
  if (forgets)
    reply.applied.not_represented.push_back(
        {fmt::format("{} (hard ones in their place, without resistance against rolling)",
                     lack::kMemory),
         lack::kMemory});
  return std::move(reply.applied);
}

bool RemoteEngine::takes(const std::string& word) const {
  return std::ranges::find(info_.takes, word) != info_.takes.end();
}

void RemoteEngine::start(std::span<const BodyState> states, double time) {
  deadline_ = Clock::time_point::max();
  if (run_limit_ < 1e8) {  // an infinite one has no Clock::duration
    deadline_ = process_.now() + std::chrono::duration_cast<Clock::duration>(
                                     std::chrono::duration<double>(run_limit_));
  }
  ask<protocol::Started>(protocol::Start{{states.begin(), states.end()}, time});
}

std::vector<double> RemoteEngine::time_steps(std::span<const BodyState> states, double time,
                                             std::size_t steps, std::size_t repeats) {
  deadline_ = Clock::time_point::max();
  auto reply =
      ask<protocol::Timed>(protocol::Time{{states.begin(), states.end()}, time, steps, repeats});
  if (reply.cpu_seconds.size() != repeats)
    process_.fail(Status::crashed, "spoke rubbish: not the times asked for");
  return std::move(reply.cpu_seconds);
}

/// A frame at the end of so many steps, and maybe others.
protocol::Frames RemoteEngine::ask_for_frames(const protocol::Request& request, std::size_t steps) {
  auto reply = ask<protocol::Frames>(request);
  const auto ends = std::ranges::count(reply.frames, 1.0, &Frame::part);
  if (static_cast<std::size_t>(ends) != steps || reply.frames.front().bodies.size() != bodies_)
    process_.fail(Status::crashed, "spoke rubbish: not the frames asked for");
  return reply;
}

double RemoteEngine::skip(std::size_t steps, std::vector<BodyState>& states) {
  if (!takes(scene_part::kMany))
    return advance(steps, [&](const Frame& frame) { states = frame.bodies; });
  protocol::Frames reply = ask_for_frames(protocol::Skip{steps}, 1);
  if (reply.frames.size() != 1)
    process_.fail(Status::crashed, "spoke rubbish: not the frame asked for");
  std::swap(states, reply.frames.front().bodies);
  spare_.push_back(std::move(reply.frames.front()));
  return reply.cpu_seconds;
}

double RemoteEngine::advance(std::size_t steps, const std::function<void(const Frame&)>& callback) {
  double cpu_seconds = 0;
  const std::size_t most = steps_at_once(bodies_);
  while (steps > 0) {
    const std::size_t count = std::min(steps, most);
    auto reply = ask_for_frames(protocol::Step{count}, count);
    for (const Frame& frame : reply.frames)
      for (const Touch& touch : frame.touches)
        if (touch.second < kSubstrate && touched_surface(touch.second) >= surfaces_)
          process_.fail(Status::crashed,
                        fmt::format("spoke rubbish: a touch of the surface {} of {}",
                                    touched_surface(touch.second), surfaces_));
    cpu_seconds += reply.cpu_seconds;
    for (const Frame& frame : reply.frames) callback(frame);
    std::ranges::move(reply.frames, std::back_inserter(spare_));
    steps -= count;
  }
  return cpu_seconds;
}

}  // namespace slipcheck
