#include "engine/protocol.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "../support/refusal.h"
#include "../support/text_of.h"
#include "engine/scene_json.h"
#include "engine/scene_needs.h"
#include "some_scene.h"

namespace slipcheck::protocol {
namespace {

/// The body of an encoded message.
std::span<const std::uint8_t> body(const Bytes& message) {
  return std::span(message).subspan(kPrefix);
}

template <class T>
T through(const Reply& reply) {
  return std::get<T>(decode_reply(body(encode(reply))));
}

template <class T>
T request_through(const Request& request) {
  return std::get<T>(decode_request(body(encode(request))));
}

/// Bit for bit, so that NaN equals itself and 0 differs from −0.
bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

bool same_bits(const BodyState& a, const BodyState& b) {
  for (int k = 0; k < 3; ++k) {
    if (!same_bits(a.position[k], b.position[k]) || !same_bits(a.velocity[k], b.velocity[k]) ||
        !same_bits(a.angular_velocity[k], b.angular_velocity[k])) {
      return false;
    }
  }
  return true;
}

/// Any of the 2^64 float64, as an engine that blows up may produce.
double any_double(std::mt19937_64& random) {
  const std::uint64_t bits = random();
  double value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

Frame any_frame(std::mt19937_64& random, std::size_t bodies) {
  Frame frame;
  for (std::size_t i = 0; i < bodies; ++i) {
    BodyState state;
    for (Vector3* v : {&state.position, &state.velocity, &state.angular_velocity}) {
      for (int k = 0; k < 3; ++k) (*v)[k] = any_double(random);
    }
    frame.bodies.push_back(state);
  }
  const int count = static_cast<int>(bodies);
  for (int first = 0; first < count; ++first) {
    const int second = static_cast<int>(random() % static_cast<unsigned>(count));
    const double impulse = std::ldexp(1.0, static_cast<int>(random() % 100) - 50);
    frame.touches.push_back({first, second > first ? second : kSubstrate, impulse});
  }
  return frame;
}

TEST(Protocol, FramesComeThroughBitForBit) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 200; ++round) {
    const std::size_t bodies = 1 + random() % 7;
    Frames sent;
    sent.cpu_seconds = 1e-6 * static_cast<double>(random() % 1000);
    for (std::size_t n = 1 + random() % 20; n > 0; --n) {
      sent.frames.push_back(any_frame(random, bodies));
    }
    const auto received = through<Frames>(sent);
    EXPECT_EQ(received.cpu_seconds, sent.cpu_seconds);
    ASSERT_EQ(received.frames.size(), sent.frames.size());
    for (std::size_t n = 0; n < sent.frames.size(); ++n) {
      const Frame &a = sent.frames[n], &b = received.frames[n];
      ASSERT_EQ(a.bodies.size(), b.bodies.size());
      ASSERT_EQ(a.touches.size(), b.touches.size());
      for (std::size_t i = 0; i < a.bodies.size(); ++i) {
        EXPECT_TRUE(same_bits(a.bodies[i], b.bodies[i]));
      }
      for (std::size_t k = 0; k < a.touches.size(); ++k) {
        EXPECT_EQ(a.touches[k].first, b.touches[k].first);
        EXPECT_EQ(a.touches[k].second, b.touches[k].second);
        EXPECT_EQ(a.touches[k].normal_impulse, b.touches[k].normal_impulse);
      }
    }
  }
}

TEST(Protocol, ATouchNamesItsSurface) {
  Frames sent;
  sent.frames.resize(1);
  sent.frames[0].bodies.resize(2);
  sent.frames[0].touches = {
      {0, surface_touch(3), 0.5}, {1, kSubstrate, 1}, {1, surface_touch(0), 2}};
  const auto received = through<Frames>(sent);
  ASSERT_EQ(received.frames[0].touches.size(), 3u);
  EXPECT_EQ(touched_surface(received.frames[0].touches[0].second), 3u);
  EXPECT_EQ(received.frames[0].touches[1].second, kSubstrate);
  sent.frames[0].touches[1].first = 0;
  sent.frames[0].touches[2] = sent.frames[0].touches[0];
  EXPECT_EQ(test::refusal_of<Rubbish>([&] { through<Frames>(sent); }),
            "a touch of 0 and the surface 3 twice in a frame");
}

TEST(Protocol, AWelcomeThatSaysNothingOfItKnowsNoSurfaces) {
  EXPECT_TRUE(through<Welcome>(Welcome{1, {"e", "1", "single", {}}}).info.takes.empty());
  const auto takes = through<Welcome>(Welcome{1, {"e", "1", "single", {}, {"surfaces"}}});
  EXPECT_EQ(takes.info.takes, std::vector<std::string>{"surfaces"});
}

TEST(Protocol, TheOtherMessagesComeThrough) {
  EXPECT_EQ(request_through<Hello>(Hello{}).version, kVersion);
  EXPECT_EQ(request_through<Step>(Step{77}).count, 77u);
  const auto start = request_through<Start>(Start{some_scene().initial, 0.125});
  EXPECT_EQ(start.states.size(), 2u);
  EXPECT_EQ(start.time, 0.125);
  const auto time = request_through<Time>(Time{some_scene().initial, 0.25, 300, 7});
  EXPECT_EQ(time.states.size(), 2u);
  EXPECT_EQ(time.time, 0.25);
  EXPECT_EQ(time.steps, 300u);
  EXPECT_EQ(time.repeats, 7u);
  request_through<Quit>(Quit{});

  const auto welcome = through<Welcome>(Welcome{1, {"bullet", "3.24", "single", some_settings()}});
  EXPECT_EQ(welcome.info.engine, "bullet");
  EXPECT_EQ(welcome.info.precision, "single");
  EXPECT_TRUE(welcome.info.takes.empty());
  const EngineInfo more{"bullet", "3.24", "single", {}, {scene_part::kBlock, "whatever"}};
  EXPECT_EQ(through<Welcome>(Welcome{1, more}).info.takes, more.takes);
  const Settings settings = {
      {"erp", 0.2}, {"iterations", 10.0}, {"law", std::string("by speed")}, {"warm", true}};
  const auto configure = request_through<Configure>(Configure{some_scene(), settings, 0.01});
  EXPECT_EQ(configure.settings, settings);
  EXPECT_EQ(configure.time_step, 0.01);
  const auto configured = through<Configured>(
      Configured{{settings, {Lack{"friction below 2 m/s", "friction"}}, {"rows"}}});
  EXPECT_EQ(configured.applied.settings, settings);
  ASSERT_EQ(configured.applied.not_represented.size(), 1u);
  EXPECT_EQ(configured.applied.not_represented[0].text, "friction below 2 m/s");
  EXPECT_EQ(configured.applied.not_represented[0].kind, "friction");
  EXPECT_EQ(configured.applied.left_out, std::vector<std::string>{"rows"});
  EXPECT_EQ(through<Refusal>(Refusal{"why"}).reason, "why");
  EXPECT_EQ(through<Failed>(Failed{"µ"}).reason, "µ");
  through<Started>(Started{});
  const std::vector<double> times = {1e-6, 0, 2.5};
  EXPECT_EQ(through<Timed>(Timed{times}).cpu_seconds, times);
}

void expect_rubbish(const nlohmann::json& reply, const std::string& reason) {
  EXPECT_EQ(test::refusal_of<Rubbish>([&] { decode_reply(nlohmann::json::to_cbor(reply)); }),
            reason);
}

nlohmann::json good_frames() {
  Bytes touches;
  append_u32(touches, 0);
  append_u32(touches, 1);
  append_f64(touches, 1e-3);
  return {{"type", "frames"},
          {"count", 1},
          {"bodies", 2},
          {"cpu_seconds", 1e-6},
          {"states", nlohmann::json::binary(Bytes(2 * kStateBytes))},
          {"touch_counts", nlohmann::json::binary({1, 0, 0, 0})},
          {"touches", nlohmann::json::binary(touches)}};
}

TEST(Protocol, ABadReplyIsNamed) {
  EXPECT_NO_THROW(decode_reply(nlohmann::json::to_cbor(good_frames())));
  const auto with = [](const char* key, const nlohmann::json& value) {
    nlohmann::json reply = good_frames();
    reply[key] = value;
    return reply;
  };
  const auto bytes = [](const Bytes& content) { return nlohmann::json::binary(content); };
  expect_rubbish(3, "reply: must be an object, got 3");
  expect_rubbish({{"kind", "frames"}}, "reply: type: must be there");
  expect_rubbish({{"type", "dance"}}, "reply: type: must be a type of message, got \"dance\"");
  expect_rubbish(with("count", "one"), "reply: count: must be a whole number >= 0, got \"one\"");
  expect_rubbish(with("count", -1), "reply: count: must be a whole number >= 0, got -1");
  expect_rubbish(with("count", 0), "frames without a step or a body");
  expect_rubbish(with("count", 2), "144 bytes of states for 2 steps of 2 bodies");
  expect_rubbish(with("bodies", 1), "144 bytes of states for 1 steps of 1 bodies");
  expect_rubbish(with("cpu_seconds", -1.0), "reply: cpu_seconds: must be >= 0, got -1.0");
  expect_rubbish(with("cpu_seconds", std::nan("")), "reply: cpu_seconds: must be finite, got nan");
  expect_rubbish(with("states", "text"), "reply: states: must be a byte string, got \"text\"");
  expect_rubbish(with("touch_counts", bytes({1, 0})), "touch_counts is not 4 bytes for each step");
  expect_rubbish(with("touch_counts", bytes({0, 0, 0, 0})), "more touches than touch_counts says");
  expect_rubbish(with("touch_counts", bytes({0, 0, 0, 9})), "touches end early");
  Bytes touches = good_frames()["touches"].get_binary();
  touches[4] = 2;
  expect_rubbish(with("touches", bytes(touches)), "a touch of 0 and 2 among 2 bodies");
  touches[4] = 0;
  expect_rubbish(with("touches", bytes(touches)), "a touch of 0 and 0 among 2 bodies");
  touches.resize(8);
  append_f64(touches, -1);
  touches[4] = 1;
  expect_rubbish(with("touches", bytes(touches)), "a touch's normal impulse is -1, not > 0");
  touches.resize(8);
  append_f64(touches, std::nan(""));
  expect_rubbish(with("touches", bytes(touches)), "a touch's normal impulse is nan, not > 0");
  expect_rubbish({{"type", "timed"}, {"cpu_seconds", {1e-6, -1e-6}}},
                 "reply: cpu_seconds: must hold times >= 0");
  expect_rubbish({{"type", "refused"}, {"reason", "\xff"}},
                 "reply: reason: must be valid UTF-8, got \"\uFFFD\"");
}

TEST(Protocol, PartsOfAStepGrowAndTheLastIsItsEnd) {
  const auto decoded = [](const std::vector<double>& parts) {
    nlohmann::json reply = good_frames();
    Bytes bytes;
    for (const double part : parts) append_f64(bytes, part);
    const std::size_t count = std::max<std::size_t>(parts.size(), 1);
    Bytes counts;
    for (std::size_t n = 0; n < count; ++n) append_u32(counts, n == 0 ? 1 : 0);
    reply["count"] = count;
    reply["states"] = nlohmann::json::binary(Bytes(count * 2 * kStateBytes));
    reply["touch_counts"] = nlohmann::json::binary(counts);
    reply["parts"] = nlohmann::json::binary(bytes);
    return decode_reply(nlohmann::json::to_cbor(reply));
  };
  const auto refusal = [&](const std::vector<double>& parts) {
    return test::refusal_of<Rubbish>([&] { decoded(parts); });
  };
  const Reply good = decoded({0.25, 0.75, 1, 1, 0.5, 1});
  const std::vector<double> expected = {0.25, 0.75, 1, 1, 0.5, 1};
  const auto& frames = std::get<Frames>(good).frames;
  ASSERT_EQ(frames.size(), expected.size());
  for (std::size_t n = 0; n < frames.size(); ++n) EXPECT_EQ(frames[n].part, expected[n]);
  EXPECT_EQ(refusal({0.25}), "the last step has no end");
  EXPECT_EQ(refusal({1, 0.5}), "the last step has no end");
  EXPECT_EQ(refusal({0.5, 0.25, 1}), "a part of a step is 0.25, not in (0.5, 1]");
  EXPECT_EQ(refusal({0.5, 0.5, 1}), "a part of a step is 0.5, not in (0.5, 1]");
  EXPECT_EQ(refusal({0, 1}), "a part of a step is 0, not in (0, 1]");
  EXPECT_EQ(refusal({1.5}), "a part of a step is 1.5, not in (0, 1]");
  EXPECT_EQ(refusal({std::nan("")}), "a part of a step is nan, not in (0, 1]");
  EXPECT_EQ(refusal({}), "parts is not 8 bytes for each frame");
}

TEST(Protocol, APairTouchesOnceInAFrame) {
  Frames frames;
  frames.frames.resize(1);
  frames.frames[0].bodies.resize(3);
  std::vector<Touch>& touches = frames.frames[0].touches;
  touches = {{1, 2, 0.5}, {0, kSubstrate, 0.5}, {0, 1, 0.5}, {1, kSubstrate, 0.5}};
  EXPECT_EQ(through<Frames>(frames).frames[0].touches.size(), 4u);
  const auto refusal = [&] { return test::refusal_of<BadJson>([&] { through<Frames>(frames); }); };
  touches.push_back({1, 2, 0.25});
  EXPECT_EQ(refusal(), "a touch of 1 and 2 twice in a frame");
  touches.back() = {0, kSubstrate, 0.25};
  EXPECT_EQ(refusal(), "a touch of 0 and the substrate twice in a frame");
  frames.frames.resize(2);
  frames.frames[1] = frames.frames[0];
  frames.frames[0].touches.resize(1);
  frames.frames[1].touches.resize(1);
  EXPECT_EQ(through<Frames>(frames).frames.size(), 2u);
}

TEST(Protocol, NoTextOfAnEngineCommandsATerminalOrALog) {
  const auto said = [](const std::string& reason) {
    return through<Refusal>(Refusal{reason}).reason;
  };
  EXPECT_EQ(said("btBody::solve failed at 2 :: 3, \u03bc = 0.1"),
            "btBody::solve failed at 2 : : 3, \u03bc = 0.1");
  EXPECT_EQ(said("\x1b[31mred\x07"), "\uFFFD[31mred\uFFFD");
  EXPECT_EQ(said("::error::x\n::warning file=a::y"), ": :error::x : :warning file=a::y");
  EXPECT_EQ(said("a ##[error]b"), "a ## [error]b");
  Applied applied;
  applied.settings = {{"a\x1b", std::string("\t::stop-commands::t")}};
  applied.not_represented = {{"rolling\x1b]0;title\x07"}};
  const auto received = through<Configured>(Configured{applied}).applied;
  EXPECT_EQ(received.settings, (Settings{{"a\uFFFD", std::string(" : :stop-commands::t")}}));
  EXPECT_EQ(received.not_represented[0].text, "rolling\uFFFD]0;title\uFFFD");
}

TEST(Protocol, SettingsAreLimited) {
  Welcome welcome;
  welcome.info = {"many", "1", "double", {}};
  for (int k = 0; k < 1000; ++k)
    welcome.info.settings.emplace_back().name = "setting_" + std::to_string(k);
  EXPECT_EQ(through<Welcome>(welcome).info.settings.size(), 1000u);
  welcome.info.settings.emplace_back().name = "one_more";
  EXPECT_EQ(test::refusal_of<BadJson>([&] { through<Welcome>(welcome); }),
            "reply: settings: must be at most 1000 settings");
  Configured configured;
  for (int k = 0; k <= 100'000; ++k) configured.applied.settings["s" + std::to_string(k)] = true;
  EXPECT_EQ(test::refusal_of<BadJson>([&] { through<Configured>(configured); }),
            "reply: settings: must be at most 100000 settings");
}

TEST(Protocol, KindsOfLacksMayBeMissingButNotSome) {
  nlohmann::json reply = {{"type", "configured"},
                          {"settings", nlohmann::json::object()},
                          {"not_represented", {"friction below 2 m/s", "drilling"}}};
  const auto configured = std::get<Configured>(decode_reply(nlohmann::json::to_cbor(reply)));
  ASSERT_EQ(configured.applied.not_represented.size(), 2u);
  EXPECT_EQ(configured.applied.not_represented[0].text, "friction below 2 m/s");
  EXPECT_EQ(configured.applied.not_represented[0].kind, "");
  reply["not_represented_kinds"] = nlohmann::json::array({"friction"});
  expect_rubbish(reply, "reply: not_represented_kinds: must be a list of 2, got a list");
}

TEST(Protocol, DeepNestingAndOddCborAreRefused) {
  // A megabyte of arrays of one would overflow the stack of a reader that recurses.
  EXPECT_THROW(decode_reply(Bytes(1 << 20, 0x81)), Rubbish);
  EXPECT_THROW(decode_reply(Bytes(1 << 20, 0x7f)), Rubbish);  // text of indefinite length
  EXPECT_THROW(decode_reply(Bytes{}), Rubbish);
  Bytes many(5 + (5 << 20));  // an array of 5 Mi zeros
  many[0] = 0x9a, many[2] = 0x50;
  EXPECT_THROW(decode_reply(many), Rubbish);
  EXPECT_THROW(decode_reply(Bytes{0x9b, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff}), Rubbish);
  EXPECT_THROW(decode_reply(Bytes{0xc0, 0x00}), Rubbish);        // a tag
  EXPECT_THROW(decode_reply(Bytes{0xa1, 0x00, 0x00}), Rubbish);  // a key that is a number
  EXPECT_THROW(decode_reply(Bytes{0x00, 0x00}), Rubbish);        // two items
}

TEST(Protocol, TheLengthIsLimited) {
  const std::array<std::uint8_t, 4> most = {0, 0, 0, 4}, more = {1, 0, 0, 4};
  EXPECT_EQ(body_length(most), std::size_t{64} << 20);
  EXPECT_THROW(body_length(more), Rubbish);
  EXPECT_EQ(body_length(more, kMaxOfMany), (std::size_t{64} << 20) + 1);
  Start start;
  start.states.resize(1'000'000);  // of 72 bytes each
  EXPECT_THROW(encode(start), std::length_error);
  EXPECT_GT(encode(start, kMaxOfMany).size(), std::size_t{72'000'000});
}

TEST(Protocol, StepsThatAreSkippedAreCounted) {
  EXPECT_EQ(request_through<Skip>(Skip{12}).count, 12u);
  EXPECT_THROW(request_through<Skip>(Skip{0}), Rubbish);
}

/// docs/engine-protocol.md shows a message byte for byte: `step` for one step.
TEST(Protocol, TheDocumentsExampleIsWhatIsSent) {
  const Bytes expected = {0x12, 0x00, 0x00, 0x00, 0xa2, 0x65, 'c',  'o', 'u', 'n', 't',
                          0x01, 0x64, 't',  'y',  'p',  'e',  0x64, 's', 't', 'e', 'p'};
  EXPECT_EQ(encode(Request(Step{1})), expected);
  const std::string text = test::text_of(SLIPCHECK_SOURCE_DIR "/docs/engine-protocol.md");
  EXPECT_NE(text.find("12 00 00 00  a2 65 63 6f 75 6e 74 01 64 74 79 70 65 64 73 74 65 70"),
            std::string::npos);
}

}  // namespace
}  // namespace slipcheck::protocol
