#include "engine/cbor.h"

#include <fmt/format.h>

#include <cstddef>
#include <vector>

namespace slipcheck::protocol {
namespace {

constexpr std::size_t kDeepest = 16;
constexpr std::size_t kMostItems =
    4'000'000;  // of one byte each in CBOR, but of 16 and more in json

// Walks over the item without recursion: nlohmann's reader recurses for every level, so that a
// megabyte of "array of one" bytes would exhaust its stack.
class Walker {
 public:
  explicit Walker(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  void walk() {
    std::vector<std::uint64_t> open = {1};  // items still to come, by level
    while (!open.empty()) {
      if (open.back() == 0) {
        open.pop_back();
        continue;
      }
      --open.back();
      if (++items_ > kMostItems) throw Rubbish("CBOR of too many items");
      const std::uint64_t children = item();
      if (children == 0) continue;
      if (open.size() > kDeepest) throw Rubbish("CBOR nested too deeply");
      open.push_back(children);
    }
    if (at_ != bytes_.size()) {
      throw Rubbish(fmt::format("{} bytes follow the CBOR item", bytes_.size() - at_));
    }
  }

 private:
  /// Passes over one item's head and content; the number of items inside.
  std::uint64_t item() {
    const std::uint8_t head = next();
    const int major = head >> 5;
    const int info = head & 31;
    if (info > 27) throw Rubbish(fmt::format("CBOR head 0x{:02x} is not accepted", head));
    std::uint64_t argument = static_cast<std::uint64_t>(info);
    if (info >= 24) {
      argument = 0;
      for (int i = 0; i < (1 << (info - 24)); ++i) argument = argument << 8 | next();
    }
    switch (major) {
      case 2:
      case 3:
        skip(argument);
        return 0;
      case 4:
        return at_most_the_rest(argument);
      case 5:
        return 2 * at_most_the_rest(argument);
      case 6:
        throw Rubbish("CBOR tags are not accepted");
      default:
        return 0;
    }
  }

  std::uint8_t next() {
    if (at_ == bytes_.size()) throw Rubbish("the CBOR item ends early");
    return bytes_[at_++];
  }

  void skip(std::uint64_t count) { at_ += static_cast<std::size_t>(at_most_the_rest(count)); }

  /// Each item takes a byte at least.
  std::uint64_t at_most_the_rest(std::uint64_t count) const {
    if (count > bytes_.size() - at_) throw Rubbish("the CBOR item ends early");
    return count;
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  std::size_t items_ = 0;
};

}  // namespace

nlohmann::json read_cbor(std::span<const std::uint8_t> bytes) {
  Walker(bytes).walk();
  try {
    return nlohmann::json::from_cbor(bytes.begin(), bytes.end());
  } catch (const nlohmann::json::exception& error) {
    throw Rubbish(error.what());
  }
}

}  // namespace slipcheck::protocol
