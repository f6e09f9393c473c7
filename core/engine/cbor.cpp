#include "engine/cbor.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

namespace slipcheck::protocol {
namespace {

using nlohmann::json;

constexpr std::size_t kDeepest = 16;
constexpr std::size_t kMostItems =
    4'000'000;  // of one byte each in CBOR, but of 16 and more in json

/// Reads what the protocol uses, and byte strings, of which messages are made, as a whole:
/// nlohmann's reader takes them byte by byte.
class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  json read() {
    json whole = item(1);
    if (at_ != bytes_.size())
      throw Rubbish(fmt::format("{} bytes follow the CBOR item", bytes_.size() - at_));
    return whole;
  }

 private:
  struct Head {
    int major = 0, info = 0;
    std::uint64_t argument = 0;
  };

  /// `level`: of the item, from 1.
  json item(std::size_t level) {
    if (++items_ > kMostItems) throw Rubbish("CBOR of too many items");
    const Head head = next_head();
    switch (head.major) {
      case 0:
        return head.argument;
      case 1:
        if (head.argument > std::uint64_t{std::numeric_limits<std::int64_t>::max()})
          throw Rubbish("a CBOR number is below the range of 64 bits");
        return -1 - static_cast<std::int64_t>(head.argument);
      case 2: {
        const auto bytes = next(head.argument);
        return byte_string(Bytes(bytes.begin(), bytes.end()));
      }
      case 3:
        return text(head.argument);
      case 4:
        return list(head.argument, level);
      case 5:
        return object(head.argument, level);
      case 6:
        throw Rubbish("CBOR tags are not accepted");
      default:
        return simple(head);
    }
  }

  json list(std::uint64_t count, std::size_t level) {
    check_children(count, level);
    json items = json::array();
    for (std::uint64_t k = 0; k < count; ++k) items.push_back(item(level + 1));
    return items;
  }

  json object(std::uint64_t count, std::size_t level) {
    check_children(count, level);
    json members = json::object();
    for (std::uint64_t k = 0; k < count; ++k) {
      if (++items_ > kMostItems) throw Rubbish("CBOR of too many items");
      const Head key = next_head();
      if (key.major != 3) throw Rubbish("a CBOR key must be a text");
      std::string name = text(key.argument);
      members[std::move(name)] = item(level + 1);
    }
    return members;
  }

  static json simple(const Head& head) {
    switch (head.info) {
      case 20:
      case 21:
        return head.info == 21;
      case 22:
        return nullptr;
      case 25:
        return half(static_cast<std::uint16_t>(head.argument));
      case 26:
        return double{std::bit_cast<float>(static_cast<std::uint32_t>(head.argument))};
      case 27:
        return std::bit_cast<double>(head.argument);
      default:
        throw Rubbish(fmt::format("CBOR simple value {} is not accepted", head.info));
    }
  }

  /// RFC 8949, appendix D.
  static double half(std::uint16_t bits) {
    const int exponent = bits >> 10 & 31, mantissa = bits & 1023;
    double value =
        exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(mantissa + 1024, exponent - 25);
    if (exponent == 31)
      value = mantissa == 0 ? std::numeric_limits<double>::infinity()
                            : std::numeric_limits<double>::quiet_NaN();
    return (bits & 0x8000) != 0 ? -value : value;
  }

  Head next_head() {
    const std::uint8_t first = next(1)[0];
    Head head{first >> 5, first & 31, 0};
    if (head.info > 27) throw Rubbish(fmt::format("CBOR head 0x{:02x} is not accepted", first));
    head.argument = static_cast<std::uint64_t>(head.info);
    if (head.info < 24) return head;
    head.argument = 0;
    for (const std::uint8_t byte : next(std::uint64_t{1} << (head.info - 24)))
      head.argument = head.argument << 8 | byte;
    return head;
  }

  std::string text(std::uint64_t size) {
    const auto bytes = next(size);
    return {bytes.begin(), bytes.end()};
  }

  std::span<const std::uint8_t> next(std::uint64_t count) {
    at_most_the_rest(count);
    const auto bytes = bytes_.subspan(at_, static_cast<std::size_t>(count));
    at_ += bytes.size();
    return bytes;
  }

  void check_children(std::uint64_t count, std::size_t level) const {
    at_most_the_rest(count);
    if (count > 0 && level > kDeepest) throw Rubbish("CBOR nested too deeply");
  }

  /// Each item takes a byte at least.
  void at_most_the_rest(std::uint64_t count) const {
    if (count > bytes_.size() - at_) throw Rubbish("the CBOR item ends early");
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  std::size_t items_ = 0;
};

}  // namespace

json byte_string(Bytes bytes) {
  json value(json::value_t::binary);
  static_cast<Bytes&>(value.get_binary()) = std::move(bytes);
  return value;
}

nlohmann::json read_cbor(std::span<const std::uint8_t> bytes) { return Reader(bytes).read(); }

}  // namespace slipcheck::protocol
