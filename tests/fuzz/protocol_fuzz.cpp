// What a worker or the harness may say: the first byte chooses which of both reads the rest. A
// message that is read is encoded and read again.

#include "engine/protocol.h"
#include "fuzz_text.h"

namespace {

using namespace slipcheck::protocol;

template <class Message, class Decode>
void through(std::span<const std::uint8_t> body, const Decode& decode) {
  Bytes once;
  try {
    const Message message = decode(body);
    once = encode(message);
  } catch (const Rubbish&) {
    return;
  }
  const std::span<const std::uint8_t> sent(once);
  const Bytes again = encode(decode(sent.subspan(kPrefix)));
  slipcheck::fuzz::require(once == again, "a message reads back");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::span<const std::uint8_t> body(data + 1, size - 1);
  if (data[0] % 2 == 0)
    through<Reply>(body, [](auto bytes) { return decode_reply(bytes); });
  else
    through<Request>(body, [](auto bytes) { return decode_request(bytes); });
  return 0;
}
