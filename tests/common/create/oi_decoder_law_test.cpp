#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <random>

#include "common/create/oi_decoder.h"

namespace roomwise::create {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// The data of the frames found, by the encoder counts and bumps put into them.
std::vector<int> values_found(std::span<const std::uint8_t> ids, const std::vector<Bytes>& pieces) {
  OiDecoder decoder(ids);
  std::vector<int> values;
  for (const Bytes& piece : pieces) {
    decoder.push(piece, [&](const StreamFrame& frame) {
      values.push_back(frame.packets[Packet::kEncoderLeft] << 8 |
                       frame.packets[Packet::kBumpsAndDrops]);
      values.push_back(static_cast<int>(frame.gap_size));
    });
  }
  return values;
}

const Bytes kIds{7, 43, 100};

/// Random data in which 19, the header, turns up often.
SensorPackets any_packets() {
  std::mt19937 engine(*rc::gen::arbitrary<std::uint32_t>());
  SensorPackets packets;
  for (int id = kFirstPacket; id <= kLastPacket; ++id) {
    const int value = static_cast<int>(engine() & 0xFFFF);
    packets.set(static_cast<Packet>(id), value < 0x4000 ? 0x1313 : value);
  }
  return packets;
}

Bytes any_frame() {
  Bytes bytes;
  append_stream_frame(kIds, any_packets(), bytes);
  return bytes;
}

void append(Bytes& bytes, const Bytes& more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

/// Frames with noise between some of them.
Bytes any_stream() {
  Bytes stream;
  for (int i = *rc::gen::inRange(1, 6); i > 0; --i) {
    append(stream, *rc::gen::arbitrary<Bytes>());
    append(stream, any_frame());
  }
  return stream;
}

RC_GTEST_PROP(OiDecoderLaw, AnySplitOfTheBytesGivesTheSamePackets, ()) {
  const Bytes stream = any_stream();
  std::vector<Bytes> pieces;
  for (std::size_t at = 0; at < stream.size();) {
    const std::size_t size = std::min(*rc::gen::inRange<std::size_t>(1, 40), stream.size() - at);
    const auto from = stream.begin() + static_cast<std::ptrdiff_t>(at);
    pieces.emplace_back(from, from + static_cast<std::ptrdiff_t>(size));
    at += size;
  }
  RC_ASSERT(values_found(kIds, {stream}) == values_found(kIds, pieces));
}

RC_GTEST_PROP(OiDecoderLaw, OneFlippedByteLosesAtMostOnePacket, ()) {
  const int frames = 5;
  Bytes stream;
  for (int i = 0; i < frames; ++i) append(stream, any_frame());
  const auto at = *rc::gen::inRange<std::size_t>(0, stream.size());
  stream[at] = static_cast<std::uint8_t>(stream[at] ^ *rc::gen::inRange(1, 256));
  OiDecoder decoder(kIds);
  int found = 0;
  decoder.push(stream, [&](const StreamFrame&) { ++found; });
  RC_ASSERT(found == frames - 1);
}

RC_GTEST_PROP(OiDecoderLaw, OneLostByteLosesAtMostOnePacket, ()) {
  Bytes stream;
  for (int i = 0; i < 5; ++i) append(stream, any_frame());
  const auto at = *rc::gen::inRange<std::size_t>(0, stream.size());
  stream.erase(stream.begin() + static_cast<std::ptrdiff_t>(at));
  OiDecoder decoder(kIds);
  int found = 0;
  decoder.push(stream, [&](const StreamFrame&) { ++found; });
  RC_ASSERT(found >= 4);
}

RC_GTEST_PROP(OiDecoderLaw, NoiseBetweenFramesLosesNone, ()) {
  Bytes stream;
  const int frames = *rc::gen::inRange(1, 6);
  for (int i = 0; i < frames; ++i) {
    append(stream, *rc::gen::arbitrary<Bytes>());
    append(stream, any_frame());
  }
  OiDecoder decoder(kIds);
  int found = 0;
  decoder.push(stream, [&](const StreamFrame&) { ++found; });
  RC_ASSERT(found == frames);
}

}  // namespace
}  // namespace roomwise::create
