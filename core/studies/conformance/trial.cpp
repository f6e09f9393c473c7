#include "studies/conformance/trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <utility>

#include "engine/cbor.h"
#include "engine/scene_json.h"

namespace slipcheck {

using nlohmann::json;
using protocol::Bytes;

Bytes message_of(const json& request) {
  Bytes bytes(protocol::kPrefix);
  json::to_cbor(request, bytes);
  const std::size_t length = bytes.size() - protocol::kPrefix;
  for (std::size_t k = 0; k < protocol::kPrefix; ++k)
    bytes[k] = static_cast<std::uint8_t>(length >> (8 * k));
  return bytes;
}

json ask(WorkerProcess& worker, const json& request) {
  const Bytes body = worker.exchange(message_of(request));
  try {
    json reply = protocol::read_cbor(body);
    if (reply.is_object() && reply.contains("type") && reply["type"].is_string()) return reply;
  } catch (const protocol::Rubbish& rubbish) {
    throw Breach(fmt::format("the reply is no CBOR of the protocol: {}", rubbish.what()));
  }
  throw Breach("the reply is no map with a text under \"type\"");
}

std::string reply_type(WorkerProcess& worker, const json& request) {
  return ask(worker, request)["type"].get<std::string>();
}

json hello_request() { return {{"type", "hello"}, {"protocol", protocol::kVersion}}; }

json configure_request(const Scene& scene, const Settings& settings) {
  json chosen = json::object();
  for (const auto& [name, value] : settings)
    std::visit([&](const auto& each) { chosen[name] = each; }, value);
  return {{"type", "configure"},
          {"scene", protocol::scene_to_json(scene)},
          {"settings", chosen},
          {"time_step", kStep}};
}

json start_request(const std::vector<BodyState>& states, double time) {
  return {{"type", "start"},
          {"states", protocol::byte_string(protocol::pack_states(states))},
          {"time", time}};
}

json step_request(std::size_t count) { return {{"type", "step"}, {"count", count}}; }

Frames advance(RemoteEngine& engine, std::size_t steps) {
  Frames frames;
  engine.advance(steps, [&](const Frame& frame) { frames.push_back(frame); });
  return frames;
}

Frames run(RemoteEngine& engine, const Scene& scene, std::size_t steps, double time) {
  engine.start(scene.initial, time);
  return advance(engine, steps);
}

Frames run_alone(const Trial& trial, const Scene& scene, std::size_t steps, double time,
                 const Settings& settings) {
  RemoteEngine engine = trial.engine();
  engine.configure(scene, settings, kStep);
  return run(engine, scene, steps, time);
}

namespace {

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool same_state(const BodyState& a, const BodyState& b) {
  return std::memcmp(static_cast<const void*>(&a), static_cast<const void*>(&b), sizeof a) == 0;
}

bool same_touch(const Touch& a, const Touch& b) {
  return a.first == b.first && a.second == b.second &&
         same_bits(a.normal_impulse, b.normal_impulse);
}

}  // namespace

std::optional<std::string> difference(const Frames& one, const Frames& other) {
  if (one.size() != other.size()) return fmt::format("{} and {} frames", one.size(), other.size());
  for (std::size_t n = 0; n < one.size(); ++n) {
    const Frame &a = one[n], &b = other[n];
    if (a.bodies.size() != b.bodies.size()) return fmt::format("frame {}, number of bodies", n);
    for (std::size_t i = 0; i < a.bodies.size(); ++i)
      if (!same_state(a.bodies[i], b.bodies[i])) return fmt::format("frame {}, body {}", n, i);
    if (!std::ranges::equal(a.touches, b.touches, same_touch))
      return fmt::format("frame {}, touches", n);
    if (a.part != b.part) return fmt::format("frame {}, part of the step", n);
  }
  return std::nullopt;
}

void expect_same(const Frames& one, const Frames& other, const std::string& what) {
  if (const auto place = difference(one, other))
    throw Breach(fmt::format("{}: {} differ", what, *place));
}

}  // namespace slipcheck
