#include "engine/protocol.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine/cbor.h"
#include "engine/scene_json.h"
#include "engine/setting_json.h"

namespace slipcheck::protocol {

using nlohmann::json;

namespace {

constexpr std::size_t kTouchBytes = 4 + 4 + 8;  // first, second, normal impulse
constexpr std::uint32_t kSubstrateOnWire = 0xffffffff;

Bytes pack(const json& message) {
  Bytes bytes(kPrefix);
  json::to_cbor(message, bytes);
  const std::size_t length = bytes.size() - kPrefix;
  if (length > kMaxMessage) {
    throw std::length_error(fmt::format("a message of {} bytes is too long", length));
  }
  for (std::size_t k = 0; k < kPrefix; ++k) bytes[k] = static_cast<std::uint8_t>(length >> (8 * k));
  return bytes;
}

// --- frames --------------------------------------------------------------------------------------

json to_json(const Frames& reply) {
  const std::size_t count = reply.frames.size();
  const std::size_t bodies = count == 0 ? 0 : reply.frames.front().bodies.size();
  Bytes states, touch_counts, touches, parts;
  states.reserve(count * bodies * kStateBytes);
  touch_counts.reserve(4 * count);
  for (const Frame& frame : reply.frames) {
    for (const BodyState& state : frame.bodies) append_state(states, state);
    append_u32(touch_counts, static_cast<std::uint32_t>(frame.touches.size()));
    for (const Touch& touch : frame.touches) {
      append_u32(touches, static_cast<std::uint32_t>(touch.first));
      append_u32(touches, touch.second == kSubstrate ? kSubstrateOnWire
                                                     : static_cast<std::uint32_t>(touch.second));
      append_f64(touches, touch.normal_impulse);
    }
    append_f64(parts, frame.part);
  }
  json message = {{"type", "frames"},
                  {"count", count},
                  {"bodies", bodies},
                  {"cpu_seconds", reply.cpu_seconds},
                  {"states", json::binary(std::move(states))},
                  {"touch_counts", json::binary(std::move(touch_counts))},
                  {"touches", json::binary(std::move(touches))}};
  const auto is_part = [](const Frame& frame) { return frame.part != 1; };
  if (std::ranges::any_of(reply.frames, is_part))
    message.emplace("parts", json::binary(std::move(parts)));
  return message;
}

/// Where in its step each frame is: all at the end unless the message says otherwise.
void read_parts(const Fields& fields, std::vector<Frame>& frames) {
  if (!fields.has("parts")) return;
  const Bytes& parts = fields.bytes("parts");
  if (parts.size() != 8 * frames.size()) throw Rubbish("parts is not 8 bytes for each frame");
  double before = 0;
  for (std::size_t n = 0; n < frames.size(); ++n) {
    const double part = read_f64(parts.data() + 8 * n);
    if (!(part > before && part <= 1))
      throw Rubbish(fmt::format("a part of a step is {}, not in ({}, 1]", part, before));
    frames[n].part = part;
    before = part < 1 ? part : 0;
  }
  if (before != 0) throw Rubbish("the last step has no end");
}

Touch read_touch(const std::uint8_t* at, std::size_t bodies) {
  const std::uint32_t first = read_u32(at);
  const std::uint32_t second = read_u32(at + 4);
  const bool valid =
      first < bodies && (second == kSubstrateOnWire || (second > first && second < bodies));
  if (!valid)
    throw Rubbish(fmt::format("a touch of {} and {} among {} bodies", first, second, bodies));
  const double impulse = read_f64(at + 8);
  if (impulse <= 0) throw Rubbish(fmt::format("a touch's normal impulse is {}, not > 0", impulse));
  return {static_cast<int>(first),
          second == kSubstrateOnWire ? kSubstrate : static_cast<int>(second), impulse};
}

Frames frames_from_json(const Fields& fields) {
  const std::size_t count = fields.count("count", kMaxMessage);
  const std::size_t bodies = fields.count("bodies", kMaxMessage);
  const Bytes& states = fields.bytes("states");
  const Bytes& touch_counts = fields.bytes("touch_counts");
  const Bytes& touches = fields.bytes("touches");
  if (count == 0 || bodies == 0) throw Rubbish("frames without a step or a body");
  if (states.size() / kStateBytes / bodies != count ||
      states.size() % (bodies * kStateBytes) != 0) {
    throw Rubbish(
        fmt::format("{} bytes of states for {} steps of {} bodies", states.size(), count, bodies));
  }
  if (touch_counts.size() != 4 * count) throw Rubbish("touch_counts is not 4 bytes for each step");

  Frames reply;
  reply.cpu_seconds = fields.number("cpu_seconds", 0);
  reply.frames.resize(count);
  const std::uint8_t* state = states.data();
  std::size_t touch = 0;
  for (std::size_t n = 0; n < count; ++n) {
    Frame& frame = reply.frames[n];
    frame.bodies.reserve(bodies);
    for (std::size_t i = 0; i < bodies; ++i, state += kStateBytes) {
      frame.bodies.push_back(read_state(state));
    }
    const std::size_t here = read_u32(touch_counts.data() + 4 * n);
    if (here > (touches.size() - touch) / kTouchBytes) throw Rubbish("touches end early");
    frame.touches.reserve(here);
    for (std::size_t k = 0; k < here; ++k, touch += kTouchBytes) {
      frame.touches.push_back(read_touch(touches.data() + touch, bodies));
    }
  }
  if (touch != touches.size()) throw Rubbish("more touches than touch_counts says");
  read_parts(fields, reply.frames);
  return reply;
}

std::vector<double> times_from_json(const Fields& fields) {
  std::vector<double> times = fields.numbers("cpu_seconds");
  for (const double time : times)
    if (time < 0) throw Rubbish(fmt::format("reply.cpu_seconds holds {}, not >= 0", time));
  return times;
}

// --- the other messages --------------------------------------------------------------------------

json to_json(const Hello& request) { return {{"type", "hello"}, {"protocol", request.version}}; }
json to_json(const Configure& request) {
  return {{"type", "configure"},
          {"scene", scene_to_json(request.scene)},
          {"settings", settings_to_json(request.settings)},
          {"time_step", request.time_step}};
}
json to_json(const Start& request) {
  return {{"type", "start"},
          {"states", json::binary(pack_states(request.states))},
          {"time", request.time}};
}
json to_json(const Step& request) { return {{"type", "step"}, {"count", request.count}}; }
json to_json(const Time& request) {
  return {{"type", "time"},
          {"states", json::binary(pack_states(request.states))},
          {"time", request.time},
          {"steps", request.steps},
          {"repeats", request.repeats}};
}
json to_json(const Quit&) { return {{"type", "quit"}}; }

json to_json(const Welcome& reply) {
  return {{"type", "welcome"},
          {"protocol", reply.version},
          {"engine", reply.info.engine},
          {"version", reply.info.version},
          {"precision", reply.info.precision},
          {"settings", setting_infos_to_json(reply.info.settings)}};
}
json to_json(const Configured& reply) {
  return {{"type", "configured"},
          {"settings", settings_to_json(reply.applied.settings)},
          {"not_represented", reply.applied.not_represented},
          {"left_out", reply.applied.left_out}};
}
json to_json(const Refusal& reply) { return {{"type", "refused"}, {"reason", reply.reason}}; }
json to_json(const Started&) { return {{"type", "started"}}; }
json to_json(const Timed& reply) { return {{"type", "timed"}, {"cpu_seconds", reply.cpu_seconds}}; }
json to_json(const Failed& reply) { return {{"type", "failed"}, {"reason", reply.reason}}; }

}  // namespace

Bytes encode(const Request& request) {
  return pack(std::visit([](const auto& each) { return to_json(each); }, request));
}

Bytes encode(const Reply& reply) {
  return pack(std::visit([](const auto& each) { return to_json(each); }, reply));
}

std::size_t body_length(std::span<const std::uint8_t, kPrefix> prefix) {
  const std::size_t length = read_u32(prefix.data());
  if (length > kMaxMessage) {
    throw Rubbish(fmt::format("a message of {} bytes, more than {}", length, kMaxMessage));
  }
  return length;
}

Request decode_request(std::span<const std::uint8_t> body) {
  const json message = read_cbor(body);
  const Fields fields(message, "request");
  const std::string type = fields.text("type");
  if (type == "hello") return Hello{fields.count("protocol", 1000)};
  if (type == "configure") {
    return Configure{scene_from_json(fields.object("scene")),
                     settings_from_json(fields.object("settings")),
                     fields.number("time_step", std::numeric_limits<double>::min())};
  }
  if (type == "start") {
    return Start{unpack_states(fields.bytes("states"), "request.states"), fields.number("time", 0)};
  }
  if (type == "step") {
    const Step step{fields.count("count", kMaxMessage)};
    if (step.count == 0) throw Rubbish("request.count is 0");
    return step;
  }
  if (type == "time") {
    Time time{unpack_states(fields.bytes("states"), "request.states"), fields.number("time", 0),
              fields.count("steps", kMaxMessage), fields.count("repeats", kMaxMessage)};
    if (time.steps == 0) throw Rubbish("request.steps is 0");
    if (time.repeats == 0) throw Rubbish("request.repeats is 0");
    return time;
  }
  if (type == "quit") return Quit{};
  throw Rubbish(fmt::format("there is no request '{}'", type));
}

Reply decode_reply(std::span<const std::uint8_t> body) {
  const json message = read_cbor(body);
  const Fields fields(message, "reply");
  const std::string type = fields.text("type");
  if (type == "frames") return frames_from_json(fields);
  if (type == "welcome") {
    return Welcome{fields.count("protocol", 1000),
                   {fields.text("engine"), fields.text("version"), fields.text("precision"),
                    setting_infos_from_json(fields.list("settings"))}};
  }
  if (type == "configured") {
    return Configured{
        {settings_from_json(fields.object("settings")), fields.texts("not_represented"),
         fields.has("left_out") ? fields.texts("left_out") : std::vector<std::string>{}}};
  }
  if (type == "refused") return Refusal{fields.text("reason")};
  if (type == "started") return Started{};
  if (type == "timed") return Timed{times_from_json(fields)};
  if (type == "failed") return Failed{fields.text("reason")};
  throw Rubbish(fmt::format("there is no reply '{}'", type));
}

}  // namespace slipcheck::protocol
