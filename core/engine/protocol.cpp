#include "engine/protocol.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine/cbor.h"
#include "engine/engine_text.h"
#include "engine/lacks.h"
#include "engine/message_fields.h"
#include "engine/scene_json.h"
#include "engine/setting_json.h"

namespace slipcheck::protocol {

using nlohmann::json;

namespace {

constexpr std::size_t kTouchBytes = 4 + 4 + 8;  // first, second, normal impulse

/// The second of two that touch: a body, or from the top of the range down the substrate and the
/// surfaces, which are negative numbers there.
static_assert(static_cast<std::uint32_t>(kSubstrate) == 0xffffffff);
static_assert(static_cast<std::uint32_t>(surface_touch(0)) == 0xfffffffe);

Bytes pack(const json& message, std::size_t most) {
  Bytes bytes(kPrefix);
  json::to_cbor(message, bytes);
  const std::size_t length = bytes.size() - kPrefix;
  if (length > most) {
    throw std::length_error(fmt::format("a message of {} bytes is too long", length));
  }
  for (std::size_t k = 0; k < kPrefix; ++k) bytes[k] = static_cast<std::uint8_t>(length >> (8 * k));
  return bytes;
}

// --- frames --------------------------------------------------------------------------------------

json frames_json(const Frames& reply) {
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
      append_u32(touches, static_cast<std::uint32_t>(touch.second));
      append_f64(touches, touch.normal_impulse);
    }
    append_f64(parts, frame.part);
  }
  json message = {{"count", count},
                  {"bodies", bodies},
                  {"cpu_seconds", reply.cpu_seconds},
                  {"states", byte_string(std::move(states))},
                  {"touch_counts", byte_string(std::move(touch_counts))},
                  {"touches", byte_string(std::move(touches))}};
  const auto is_part = [](const Frame& frame) { return frame.part != 1; };
  if (std::ranges::any_of(reply.frames, is_part))
    message.emplace("parts", byte_string(std::move(parts)));
  return message;
}

/// Where in its step each frame is: all at the end unless the message says otherwise.
void read_parts(const JsonNode& node, std::vector<Frame>& frames) {
  if (!node.has("parts")) return;
  const Bytes& parts = node["parts"].bytes();
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
  const int signed_second = static_cast<int>(second);
  const bool valid = first < bodies && (signed_second < 0 || (second > first && second < bodies));
  if (!valid)
    throw Rubbish(fmt::format("a touch of {} and {} among {} bodies", first, second, bodies));
  const double impulse = read_f64(at + 8);
  if (!(impulse > 0))
    throw Rubbish(fmt::format("a touch's normal impulse is {}, not > 0", impulse));
  return {static_cast<int>(first), signed_second, impulse};
}

std::string name_of_second(int second) {
  if (second >= 0) return fmt::to_string(second);
  return second == kSubstrate ? "the substrate"
                              : fmt::format("the surface {}", touched_surface(second));
}

/// Each pair appears once. Most engines sort them.
void check_pairs(const std::vector<Touch>& touches) {
  const auto pair_of = [](const Touch& touch) { return std::pair(touch.first, touch.second); };
  if (std::ranges::is_sorted(touches, std::ranges::less_equal(), pair_of)) return;
  std::vector<std::pair<int, int>> pairs;
  for (const Touch& touch : touches) pairs.push_back(pair_of(touch));
  std::ranges::sort(pairs);
  const auto twice = std::ranges::adjacent_find(pairs);
  if (twice == pairs.end()) return;
  const auto& [first, second] = *twice;
  throw Rubbish(
      fmt::format("a touch of {} and {} twice in a frame", first, name_of_second(second)));
}

/// As many as asked for, with what `spare` has of them.
std::vector<Frame> taken_from(std::vector<Frame>& spare, std::size_t count) {
  std::vector<Frame> frames;
  frames.reserve(count);
  const std::size_t old = std::min(count, spare.size());
  const auto first = spare.end() - static_cast<std::ptrdiff_t>(old);
  frames.insert(frames.end(), std::move_iterator(first), std::move_iterator(spare.end()));
  spare.erase(first, spare.end());
  frames.resize(count);
  return frames;
}

Frames frames_of(const JsonNode& node, std::vector<Frame>& spare) {
  const std::size_t count = node["count"].count(kMaxMessage);
  const std::size_t bodies = node["bodies"].count(kMaxMessage);
  const Bytes& states = node["states"].bytes();
  const Bytes& touch_counts = node["touch_counts"].bytes();
  const Bytes& touches = node["touches"].bytes();
  if (count == 0 || bodies == 0) throw Rubbish("frames without a step or a body");
  if (states.size() / kStateBytes / bodies != count ||
      states.size() % (bodies * kStateBytes) != 0) {
    throw Rubbish(
        fmt::format("{} bytes of states for {} steps of {} bodies", states.size(), count, bodies));
  }
  if (touch_counts.size() != 4 * count) throw Rubbish("touch_counts is not 4 bytes for each step");

  Frames reply;
  reply.cpu_seconds = node["cpu_seconds"].number(0);
  reply.frames = taken_from(spare, count);
  const std::uint8_t* state = states.data();
  std::size_t touch = 0;
  for (std::size_t n = 0; n < count; ++n) {
    Frame& frame = reply.frames[n];
    frame.part = 1;
    frame.bodies.resize(bodies);
    for (std::size_t i = 0; i < bodies; ++i, state += kStateBytes)
      frame.bodies[i] = read_state(state);
    const std::size_t here = read_u32(touch_counts.data() + 4 * n);
    if (here > (touches.size() - touch) / kTouchBytes) throw Rubbish("touches end early");
    frame.touches.clear();
    frame.touches.reserve(here);
    for (std::size_t k = 0; k < here; ++k, touch += kTouchBytes) {
      frame.touches.push_back(read_touch(touches.data() + touch, bodies));
    }
    check_pairs(frame.touches);
  }
  if (touch != touches.size()) throw Rubbish("more touches than touch_counts says");
  read_parts(node, reply.frames);
  return reply;
}

// --- the other messages --------------------------------------------------------------------------

/// A count of at least 1.
template <class Fields>
void describe_count(Fields& f, const char* key, std::size_t& count) {
  f(key, count);
  if constexpr (Fields::kReads)
    if (count == 0 || count > kMaxMessage)
      f[key].fault(fmt::format("must be from 1 to {}", kMaxMessage));
}

/// What a run starts from.
template <class Fields, class Message>
void describe_start(Fields& f, Message& message) {
  if constexpr (Fields::kReads)
    message.states = unpack_states(f["states"]);
  else
    f("states", byte_string(pack_states(message.states)));
  f("time", message.time, kNotBelowZero);
}

}  // namespace

template <class Fields>
void describe(Fields& f, Hello& request) {
  f("protocol", request.version);
}

template <class Fields>
void describe(Fields& f, Configure& request) {
  if constexpr (Fields::kReads)
    request.scene = scene_from_json(f["scene"]);
  else
    f("scene", scene_to_json(request.scene));
  f("settings", request.settings);
  f("time_step", request.time_step, kAboveZero);
}

template <class Fields>
void describe(Fields& f, Start& request) {
  describe_start(f, request);
}

template <class Fields>
void describe(Fields& f, Step& request) {
  describe_count(f, "count", request.count);
}

template <class Fields>
void describe(Fields& f, Skip& request) {
  describe_count(f, "count", request.count);
}

template <class Fields>
void describe(Fields& f, Time& request) {
  describe_start(f, request);
  describe_count(f, "steps", request.steps);
  describe_count(f, "repeats", request.repeats);
}

template <class Fields>
void describe(Fields&, Quit&) {}

template <class Fields>
void describe(Fields& f, Welcome& reply) {
  f("protocol", reply.version);
  f("engine", reply.info.engine);
  f("version", reply.info.version);
  f("precision", reply.info.precision);
  if constexpr (Fields::kReads)
    reply.info.settings = setting_infos_from_json(f["settings"]);
  else
    f("settings", setting_infos_to_json(reply.info.settings));
  f.if_any("takes", reply.info.takes);
}

template <class Fields>
void describe(Fields& f, Configured& reply) {
  f("settings", reply.applied.settings);
  if constexpr (Fields::kReads)
    if (reply.applied.settings.size() > kMostApplied)
      f["settings"].fault_alone(fmt::format("must be at most {} settings", kMostApplied));
  describe_lacks(f, reply.applied.not_represented);
  if constexpr (Fields::kReads)
    f.if_any("left_out", reply.applied.left_out);
  else
    f("left_out", reply.applied.left_out);
}

template <class Fields>
void describe(Fields& f, Refusal& reply) {
  f("reason", reply.reason);
}

template <class Fields>
void describe(Fields&, Started&) {}

template <class Fields>
void describe(Fields& f, Timed& reply) {
  f("cpu_seconds", reply.cpu_seconds);
  if constexpr (Fields::kReads)
    if (!std::ranges::all_of(reply.cpu_seconds, [](double time) { return time >= 0; }))
      f["cpu_seconds"].fault_alone("must hold times >= 0");
}

template <class Fields>
void describe(Fields& f, Failed& reply) {
  f("reason", reply.reason);
}

namespace {

template <class Message>
Bytes encoded(const Message& message, std::size_t most) {
  json object = [&] {
    if constexpr (std::is_same_v<Message, Frames>)
      return frames_json(message);
    else
      return message_json(message);
  }();
  object["type"] = Message::kType;
  return pack(object, most);
}

template <class Message>
Message decoded(const JsonNode& node, std::vector<Frame>& spare) {
  if constexpr (std::is_same_v<Message, Frames>)
    return frames_of(node, spare);
  else
    return read_finite<Message>(node);
}

/// Tells by its type which message it is.
template <class... Messages>
void decode(const JsonNode& node, std::variant<Messages...>& message, std::vector<Frame>& spare) {
  const std::string type = node["type"].text();
  const bool is_known =
      ((type == Messages::kType && (message = decoded<Messages>(node, spare), true)) || ...);
  if (!is_known) node["type"].fault("must be a type of message");
}

}  // namespace

Bytes encode(const Request& request, std::size_t most) {
  return std::visit([most](const auto& each) { return encoded(each, most); }, request);
}

Bytes encode(const Reply& reply, std::size_t most) {
  return std::visit([most](const auto& each) { return encoded(each, most); }, reply);
}

std::size_t body_length(std::span<const std::uint8_t, kPrefix> prefix, std::size_t most) {
  const std::size_t length = read_u32(prefix.data());
  if (length > most) {
    const std::string letters(prefix.begin(), prefix.end());
    const bool is_text = std::ranges::all_of(letters, [](char c) { return c >= ' ' && c <= '~'; });
    throw Rubbish(fmt::format("a message of {} bytes, more than {}{}", length, most,
                              is_text ? fmt::format(": a text that begins \"{}\"?", letters) : ""));
  }
  return length;
}

Request decode_request(std::span<const std::uint8_t> body) {
  static const std::string kPlace = "request";
  const json message = read_cbor(body);
  Request request;
  std::vector<Frame> spare;
  decode(JsonNode(message, kPlace), request, spare);
  return request;
}

Reply decode_reply(std::span<const std::uint8_t> body, std::vector<Frame>& spare) {
  static const std::string kPlace = "reply";
  json message = read_cbor(body);
  make_harmless(message);
  Reply reply;
  decode(JsonNode(message, kPlace), reply, spare);
  return reply;
}

Reply decode_reply(std::span<const std::uint8_t> body) {
  std::vector<Frame> spare;
  return decode_reply(body, spare);
}

}  // namespace slipcheck::protocol
