#pragma once

#include <atomic>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/remote_engine.h"

namespace slipcheck {

/// The worker does something that it must not; the message says what.
class Breach : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The worker cannot be asked; the message says why.
class NotJudged : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What the checks of one worker share: how to start it, and how it greeted.
class Trial {
 public:
  Trial(WorkerCommand executable, const WorkerLimits& limits, const std::atomic<bool>* stop)
      : executable_(std::move(executable)), limits_(limits), stop_(stop) {}

  const WorkerCommand& executable() const { return executable_; }
  /// A worker that nothing has been said to.
  WorkerProcess process() const { return WorkerProcess(executable_, limits_, stop_); }
  /// One that has greeted.
  RemoteEngine engine() const { return RemoteEngine(executable_, limits_, stop_); }

 private:
  WorkerCommand executable_;
  WorkerLimits limits_;
  const std::atomic<bool>* stop_;
};

/// A request of any kind, right or wrong, and its reply. Throws Breach where that is no map of CBOR
/// with a type.
nlohmann::json ask(WorkerProcess& worker, const nlohmann::json& request);
/// The same, and the type of the reply.
std::string reply_type(WorkerProcess& worker, const nlohmann::json& request);
/// A message with its prefix.
protocol::Bytes message_of(const nlohmann::json& request);

nlohmann::json hello_request();
nlohmann::json configure_request(const Scene& scene, const Settings& settings = {});
nlohmann::json start_request(const std::vector<BodyState>& states, double time = 0);
nlohmann::json step_request(std::size_t count);

/// The step of the checks [s]: short enough for every engine, a power of two.
inline constexpr double kStep = 1.0 / 1024;

using Frames = std::vector<Frame>;

/// `steps` more of them.
Frames advance(RemoteEngine& engine, std::size_t steps);
/// From the scene's own states at `time` [s]; the scene is configured before.
Frames run(RemoteEngine& engine, const Scene& scene, std::size_t steps, double time = 0);
/// With a configure, in a worker of its own.
Frames run_alone(const Trial& trial, const Scene& scene, std::size_t steps, double time = 0,
                 const Settings& settings = {});

/// Where the two first differ in a bit: "frame 3, body 0"; nothing where they are the same.
std::optional<std::string> difference(const Frames& one, const Frames& other);
/// Throws Breach with `what` and the place unless they are the same, bit for bit.
void expect_same(const Frames& one, const Frames& other, const std::string& what);

}  // namespace slipcheck
