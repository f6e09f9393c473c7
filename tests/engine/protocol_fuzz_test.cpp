// Whatever bytes come in, decoding either gives a message or throws Rubbish. Run under the
// sanitizers this shows that nothing else happens.

#include <gtest/gtest.h>

#include <random>

#include "engine/protocol.h"
#include "some_scene.h"

namespace slipcheck::protocol {
namespace {

/// Any exception but Rubbish fails the test.
void decode_both(const Bytes& bytes) {
  try {
    decode_reply(bytes);
  } catch (const Rubbish&) {
  }
  try {
    decode_request(bytes);
  } catch (const Rubbish&) {
  }
}

std::vector<Bytes> good_messages() {
  Frames frames;
  for (int n = 0; n < 3; ++n) {
    frames.frames.push_back({some_scene(3).initial, {{0, kSubstrate, 1}, {0, 2, 0.5}}});
  }
  Scene on_table = some_scene(1), on_belt = some_scene(1);
  on_table.motion = SubstrateMotion::table({{0, {0, 1}}, {1, {0.1, 1}}});
  on_belt.motion = SubstrateMotion::constant({0.1, 0});
  Scene open_box = some_box(1), periodic = some_scene(1);
  open_box.box->lid.reset();
  periodic.periodic = {0.1, 0};
  std::vector<Bytes> messages = {
      encode(Request(Hello{})),
      encode(Request(Configure{some_scene(3), {{"erp", 0.2}}, 0.01})),
      encode(Request(Configure{on_table, {{"erp", 0.2}}, 0.01})),
      encode(Request(Configure{on_belt, {{"erp", 0.2}}, 0.01})),
      encode(Request(Configure{some_box(3), {{"erp", 0.2}}, 0.01})),
      encode(Request(Configure{open_box, {{"erp", 0.2}}, 0.01})),
      encode(Request(Configure{periodic, {{"erp", 0.2}}, 0.01})),
      encode(Request(Start{some_scene(3).initial, 0.5})),
      encode(Request(Step{100})),
      encode(Request(Time{some_scene().initial, 0.5, 100, 3})),
      encode(Reply(Welcome{1, {"bullet", "3.24", "double", some_settings()}})),
      encode(Reply(Configured{
          {{{"erp", 0.2}, {"on", true}}, {Lack{"this", "one"}, Lack{"that", ""}}, {"this"}}})),
      encode(Reply(Refusal{"no"})),
      encode(Reply(frames)),
  };
  for (Bytes& message : messages) message.erase(message.begin(), message.begin() + kPrefix);
  return messages;
}

TEST(ProtocolFuzz, SpoiltMessagesAreRubbishOrMessages) {
  std::mt19937 random(7);
  const auto messages = good_messages();
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random()) % n; };
  for (int round = 0; round < 40'000; ++round) {
    Bytes bytes = messages[below(messages.size())];
    for (std::size_t times = 1 + below(4); times > 0 && !bytes.empty(); --times) {
      const auto at = static_cast<std::ptrdiff_t>(below(bytes.size()));
      switch (below(4)) {
        case 0:
          bytes[static_cast<std::size_t>(at)] = static_cast<std::uint8_t>(random());
          break;
        case 1:
          bytes.resize(static_cast<std::size_t>(at));
          break;
        case 2:
          bytes.insert(bytes.begin() + at, static_cast<std::uint8_t>(random()));
          break;
        default:
          bytes.erase(bytes.begin() + at);
      }
    }
    decode_both(bytes);
  }
}

TEST(ProtocolFuzz, RandomBytesAreRubbish) {
  std::mt19937 random(8);
  for (int round = 0; round < 40'000; ++round) {
    Bytes bytes(random() % 64);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
    decode_both(bytes);
  }
}

}  // namespace
}  // namespace slipcheck::protocol
