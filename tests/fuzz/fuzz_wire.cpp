// decode() of every message type: the first byte says which, the rest is the message. What can be
// decoded must encode to the same bytes.
#include <array>
#include <tuple>
#include <utility>
#include <vector>

#include "common/bus/wire.h"
#include "roomwise/all_messages.hpp"
#include "tests/fuzz/fingerprint.h"

namespace {

using Bytes = std::vector<std::uint8_t>;

template <class Message>
void decode_and_encode(Bytes bytes) {
  set_fingerprint<Message>(bytes);
  Message message;
  if (roomwise::decode<Message>(bytes, message) != roomwise::DecodeResult::kOk) return;
  Bytes again;
  roomwise::encode(message, again);
  if (again != bytes) __builtin_trap();
}

template <std::size_t... kIndex>
constexpr auto decoders(std::index_sequence<kIndex...>) {
  return std::array{&decode_and_encode<std::tuple_element_t<kIndex, roomwise::AllMessages>>...};
}
constexpr auto kDecoders =
    decoders(std::make_index_sequence<std::tuple_size_v<roomwise::AllMessages>>());

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  kDecoders[data[0] % kDecoders.size()](Bytes(data + 1, data + size));
  return 0;
}
