#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "engine/cbor.h"
#include "engine/engine.h"

/// What the harness and a worker say to each other over the worker's standard input and output:
/// one request, one reply. docs/engine-protocol.md words it for other languages.
namespace slipcheck::protocol {

inline constexpr std::size_t kVersion = 5;
inline constexpr std::size_t kMaxMessage = std::size_t{64} << 20;  ///< of a message's body [bytes]
/// The same to and from a worker that takes many bodies (scene_part::kMany).
inline constexpr std::size_t kMaxOfMany = std::size_t{512} << 20;
inline constexpr std::size_t kPrefix = 4;  ///< the body's length before it, u32 little-endian

// --- requests ------------------------------------------------------------------------------------

struct Hello {
  static constexpr const char* kType = "hello";
  std::size_t version = kVersion;
};
struct Configure {
  static constexpr const char* kType = "configure";
  EngineScene scene;
  Settings settings;     ///< those that are chosen
  double time_step = 0;  ///< [s], > 0
};
struct Start {
  static constexpr const char* kType = "start";
  std::vector<BodyState> states;
  double time = 0;  ///< of the states [s], >= 0
};
struct Step {
  static constexpr const char* kType = "step";
  std::size_t count = 1;  ///< >= 1
};
/// Steps of which the last one's end alone is shown, without touches.
struct Skip {
  static constexpr const char* kType = "skip";
  std::size_t count = 1;  ///< >= 1
};
/// How long steps take, with nothing looked at in between.
struct Time {
  static constexpr const char* kType = "time";
  std::vector<BodyState> states;
  double time = 0;          ///< of the states [s], >= 0
  std::size_t steps = 1;    ///< of each run, >= 1
  std::size_t repeats = 1;  ///< runs, each from a fresh world, >= 1
};
struct Quit {
  static constexpr const char* kType = "quit";
};
using Request = std::variant<Hello, Configure, Start, Step, Skip, Time, Quit>;

// --- replies -------------------------------------------------------------------------------------

struct Welcome {
  static constexpr const char* kType = "welcome";
  std::size_t version = kVersion;
  EngineInfo info;
};
struct Configured {
  static constexpr const char* kType = "configured";
  Applied applied;
};
struct Refusal {
  static constexpr const char* kType = "refused";
  std::string reason;
};
struct Started {
  static constexpr const char* kType = "started";
};
struct Frames {
  static constexpr const char* kType = "frames";
  std::vector<Frame> frames;
  double cpu_seconds = 0;  ///< that the steps took [s], >= 0
};
struct Timed {
  static constexpr const char* kType = "timed";
  std::vector<double> cpu_seconds;  ///< that the steps of each run took [s], >= 0
};
/// The request was not understood or the engine threw.
struct Failed {
  static constexpr const char* kType = "failed";
  std::string reason;
};
using Reply = std::variant<Welcome, Configured, Refusal, Started, Frames, Timed, Failed>;

/// A whole message, prefix included. A message longer than `most` bytes throws std::length_error.
Bytes encode(const Request& request, std::size_t most = kMaxMessage);
Bytes encode(const Reply& reply, std::size_t most = kMaxMessage);

/// The length of the body that follows a prefix; throws Rubbish beyond `most` bytes.
std::size_t body_length(std::span<const std::uint8_t, kPrefix> prefix,
                        std::size_t most = kMaxMessage);

/// A message's body, checked in full: types, ranges, indices, sizes. Throws Rubbish and nothing
/// else. States may hold any float64: an engine that blows up is no breach of the protocol.
Request decode_request(std::span<const std::uint8_t> body);
Reply decode_reply(std::span<const std::uint8_t> body);
/// The same; frames are taken from the end of `spare` as far as there are any, whatever they hold,
/// and need no storage of their own then.
Reply decode_reply(std::span<const std::uint8_t> body, std::vector<Frame>& spare);

}  // namespace slipcheck::protocol
