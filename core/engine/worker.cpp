#include "engine/worker.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/protocol.h"
#include "engine/scene_needs.h"
#include "engine/settings.h"

namespace slipcheck {
namespace {

using protocol::Bytes;

/// The protocol's own copies of standard input and output.
class Connection {
 public:
  Connection() : in_(dup(STDIN_FILENO)), out_(dup(STDOUT_FILENO)) {
    const int null = open("/dev/null", O_RDONLY | O_CLOEXEC);
    dup2(null, STDIN_FILENO);
    dup2(STDERR_FILENO, STDOUT_FILENO);
    close(null);
  }

  /// The next message's body, of `most` bytes; nothing at the end of the input, even in the middle
  /// of a message.
  std::optional<Bytes> receive(std::size_t most) {
    std::array<std::uint8_t, protocol::kPrefix> prefix;
    if (!read_all(prefix)) return std::nullopt;
    Bytes body(protocol::body_length(prefix, most));
    if (!read_all(body)) return std::nullopt;
    return body;
  }

  /// False when nobody listens any more.
  bool send(const Bytes& message) {
    std::size_t sent = 0;
    while (sent < message.size()) {
      const ssize_t n = write(out_, message.data() + sent, message.size() - sent);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) return false;
      sent += static_cast<std::size_t>(n);
    }
    return true;
  }

 private:
  bool read_all(std::span<std::uint8_t> bytes) {
    while (!bytes.empty()) {
      const ssize_t n = read(in_, bytes.data(), bytes.size());
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) return false;
      bytes = bytes.subspan(static_cast<std::size_t>(n));
    }
    return true;
  }

  int in_;
  int out_;
};

/// Answers requests in the only order that makes sense: configure, start, step.
class Worker {
 public:
  explicit Worker(Engine& engine) : engine_(engine) {}

  protocol::Reply answer(const protocol::Request& request) {
    try {
      return std::visit([this](const auto& each) { return handle(each); }, request);
    } catch (const Refused& refused) {
      return protocol::Refusal{refused.what()};
    } catch (const std::bad_alloc&) {
      return protocol::Failed{"out of memory"};
    } catch (const std::exception& error) {
      return protocol::Failed{error.what()};
    }
  }

  /// A reply that was sent.
  void take_back(protocol::Reply&& reply) {
    if (auto* frames = std::get_if<protocol::Frames>(&reply)) frames_ = std::move(frames->frames);
  }

 private:
  protocol::Reply handle(const protocol::Hello&) {
    return protocol::Welcome{protocol::kVersion, engine_.info()};
  }

  protocol::Reply handle(const protocol::Configure& request) {
    bodies_ = 0;
    started_ = false;
    refuse_bad_settings(request.settings);
    Applied applied = engine_.configure(request.scene, request.settings, request.time_step);
    bodies_ = request.scene.bodies.size();
    return protocol::Configured{std::move(applied)};
  }

  protocol::Reply handle(const protocol::Start& request) {
    if (const char* fault = fault_of_start(request.states)) return protocol::Failed{fault};
    engine_.start(request.states, request.time);
    started_ = true;
    return protocol::Started{};
  }

  protocol::Reply handle(const protocol::Step& request) {
    if (!started_) return protocol::Failed{"step before start"};
    protocol::Frames reply;
    reply.frames = std::move(frames_);
    std::size_t count = 0;
    // Frames of an earlier reply lend their storage.
    const auto next = [&]() -> Frame& {
      return count++ < reply.frames.size() ? reply.frames[count - 1] : reply.frames.emplace_back();
    };
    const double before = engine_.cpu_seconds();
    for (std::size_t k = 0; k < request.count; ++k) {
      engine_.step();
      for (const Frame& part : engine_.parts()) next() = part;
      Frame& frame = next();
      frame.part = 1;
      engine_.read(frame);
    }
    reply.frames.resize(count);
    reply.cpu_seconds = engine_.cpu_seconds() - before;
    return reply;
  }

  protocol::Reply handle(const protocol::Skip& request) {
    if (!started_) return protocol::Failed{"skip before start"};
    protocol::Frames reply;
    reply.frames = std::move(frames_);
    reply.frames.resize(1);
    Frame& frame = reply.frames.front();
    const double before = engine_.cpu_seconds();
    for (std::size_t k = 0; k < request.count; ++k) engine_.step();
    engine_.read_states(frame.bodies);  // an engine may take its steps when it is looked at
    reply.cpu_seconds = engine_.cpu_seconds() - before;
    frame.touches.clear();
    frame.part = 1;
    return reply;
  }

  protocol::Reply handle(const protocol::Time& request) {
    if (const char* fault = fault_of_start(request.states)) return protocol::Failed{fault};
    started_ = false;
    protocol::Timed reply;
    reply.cpu_seconds.reserve(request.repeats);
    for (std::size_t run = 0; run < request.repeats; ++run) {
      engine_.start(request.states, request.time);
      const double before = engine_.cpu_seconds();
      for (std::size_t k = 0; k < request.steps; ++k) engine_.step();
      reply.cpu_seconds.push_back(engine_.cpu_seconds() - before);
    }
    return reply;
  }

  protocol::Reply handle(const protocol::Quit&) {
    return protocol::Started{};
  }  // run_worker returns

  /// Null for a good one.
  const char* fault_of_start(const std::vector<BodyState>& states) const {
    if (bodies_ == 0) return "start before configure";
    return states.size() == bodies_ ? nullptr : "wrong number of states";
  }

  void refuse_bad_settings(const Settings& settings) const {
    const std::vector<SettingFault> faults = check_settings(engine_.info().settings, settings);
    if (faults.empty()) return;
    std::string reason;
    for (const SettingFault& fault : faults) {
      if (!reason.empty()) reason += "; ";
      reason += fault.name + ' ' + fault.rule;
      if (!fault.value.empty()) reason += ", got " + fault.value;
    }
    throw Refused(reason);
  }

  Engine& engine_;
  std::size_t bodies_ = 0;  // 0: not configured
  bool started_ = false;
  std::vector<Frame> frames_;  // for the next reply
};

Bytes encode_or_fail(const protocol::Reply& reply, std::size_t most) {
  try {
    return protocol::encode(reply, most);
  } catch (const std::exception& error) {  // too long, or text that is no UTF-8
    return protocol::encode(protocol::Reply(protocol::Failed{error.what()}));
  }
}

/// What a process holds ends with it: taking a world of many bodies apart takes as long as making
/// it. A sanitizer is to see that nothing was lost.
int leave(Engine& engine) {
  engine.finish();
#ifndef SLIPCHECK_SANITIZE
  std::fflush(nullptr);
  std::_Exit(0);
#endif
  return 0;
}

}  // namespace

void Engine::read_states(std::vector<BodyState>& states) const {
  Frame frame;
  read(frame);
  states = std::move(frame.bodies);
}

double Engine::cpu_seconds() const {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

int run_worker(Engine& engine) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  signal(SIGPIPE, SIG_IGN);  // a harness that is gone shows as a failed write
  Connection connection;
  Worker worker(engine);
  const std::vector<std::string> takes = engine.info().takes;
  const bool many = std::ranges::find(takes, scene_part::kMany) != takes.end();
  const std::size_t most = many ? protocol::kMaxOfMany : protocol::kMaxMessage;
  try {
    while (const std::optional<Bytes> body = connection.receive(most)) {
      const protocol::Request request = protocol::decode_request(*body);
      if (std::holds_alternative<protocol::Quit>(request)) return leave(engine);
      protocol::Reply reply = worker.answer(request);
      if (!connection.send(encode_or_fail(reply, most))) return leave(engine);
      worker.take_back(std::move(reply));
    }
    return leave(engine);
  } catch (const protocol::Rubbish& rubbish) {  // nothing after it can be trusted
    connection.send(protocol::encode(protocol::Reply(protocol::Failed{rubbish.what()})));
    return 1;
  }
}

}  // namespace slipcheck
