#include "common/create/oi_decoder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

namespace roomwise::create {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::vector<StreamFrame> decode(OiDecoder& decoder, const Bytes& bytes) {
  std::vector<StreamFrame> frames;
  decoder.push(bytes, [&](const StreamFrame& frame) { frames.push_back(frame); });
  return frames;
}

/// The frame of the manual's example; `checksum` 163 sums to 0 with the header, 182 without.
Bytes manual_frame(std::uint8_t checksum) { return {19, 5, 29, 2, 25, 13, 0, checksum}; }
const Bytes kManualIds{29, 13};

Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Bytes repeated(const Bytes& bytes, int times) {
  Bytes all;
  for (int i = 0; i < times; ++i) all = all + bytes;
  return all;
}

TEST(OiDecoder, ReadsTheManualsFrame) {
  OiDecoder decoder(kManualIds);
  const auto frames = decode(decoder, manual_frame(163));
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].packets[Packet::kCliffFrontLeftSignal], 537);  // 0x0219
  EXPECT_EQ(frames[0].packets[Packet::kVirtualWall], 0);
  EXPECT_FALSE(frames[0].packets.has(Packet::kWall));
  EXPECT_EQ(frames[0].gap_size, 0U);
}

TEST(OiDecoder, ReadsAWholeGroup) {
  const Bytes ids{100};
  SensorPackets sent;
  sent.set(Packet::kEncoderLeft, 65530);
  sent.set(Packet::kCurrent_ma, -1234);
  sent.set(Packet::kTemperature_c, -5);
  sent.set(Packet::kStasis, 1);
  Bytes bytes;
  append_stream_frame(ids, sent, bytes);
  EXPECT_EQ(bytes.size(), 84U);
  OiDecoder decoder(ids);
  const auto frames = decode(decoder, bytes);
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].packets[Packet::kEncoderLeft], 65530);
  EXPECT_EQ(frames[0].packets[Packet::kCurrent_ma], -1234);
  EXPECT_EQ(frames[0].packets[Packet::kTemperature_c], -5);
  EXPECT_EQ(frames[0].packets[Packet::kStasis], 1);
}

TEST(OiDecoder, TakesUpTheOtherChecksumAfterTwentyFrames) {
  OiDecoder decoder(kManualIds);
  EXPECT_EQ(decode(decoder, repeated(manual_frame(182), 19)).size(), 0U);
  EXPECT_EQ(decoder.checksum_reading(), ChecksumReading::kWithHeader);
  EXPECT_EQ(decode(decoder, repeated(manual_frame(182), 3)).size(), 2U);
  EXPECT_EQ(decoder.checksum_reading(), ChecksumReading::kWithoutHeader);
  EXPECT_EQ(decoder.counts().checksum_switches, 1);
}

TEST(OiDecoder, OneGoodFrameStartsTheCountOfTwentyAnew) {
  OiDecoder decoder(kManualIds);
  const Bytes nineteen = repeated(manual_frame(182), 19);
  EXPECT_EQ(decode(decoder, nineteen + manual_frame(163) + nineteen).size(), 1U);
  EXPECT_EQ(decoder.counts().checksum_switches, 0);
}

TEST(OiDecoder, GoesBackToTheFirstChecksumLikewise) {
  OiDecoder decoder(kManualIds);
  decode(decoder, repeated(manual_frame(182), 20));
  decode(decoder, repeated(manual_frame(163), 20));
  EXPECT_EQ(decoder.checksum_reading(), ChecksumReading::kWithHeader);
  EXPECT_EQ(decode(decoder, manual_frame(163)).size(), 1U);
}

TEST(OiDecoder, KeepsWhatStandsBetweenFrames) {
  OiDecoder decoder(kManualIds);
  const auto frames =
      decode(decoder, manual_frame(163) + Bytes{0, 19, 255, 3, 0, 7} + manual_frame(163));
  ASSERT_EQ(frames.size(), 2U);
  ASSERT_EQ(frames[1].gap_size, 6U);
  EXPECT_THAT(Bytes(frames[1].gap_bytes.begin(), frames[1].gap_bytes.begin() + 6),
              ::testing::ElementsAre(0, 19, 255, 3, 0, 7));
}

TEST(OiDecoder, ALongGapIsCountedThoughNotKept) {
  OiDecoder decoder(kManualIds);
  const auto frames = decode(decoder, Bytes(1000, 19) + manual_frame(163));
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].gap_size, 1000U);
}

TEST(OiDecoder, AWrongLengthCostsItsFrameOnly) {
  for (int length = 0; length < 256; ++length) {
    if (length == 5) continue;
    Bytes wrong = manual_frame(163);
    wrong[1] = static_cast<std::uint8_t>(length);
    OiDecoder decoder(kManualIds);
    EXPECT_EQ(decode(decoder, wrong + manual_frame(163)).size(), 1U) << "length " << length;
  }
}

TEST(OiDecoder, HeadersInsideTheDataDoNotMislead) {
  const Bytes ids{6};
  SensorPackets sent;
  for (int id = kFirstPacket; id <= kLastPacketCreate1; ++id) {
    sent.set(static_cast<Packet>(id), id % 2 == 0 ? 0x1313 : 0x1335);
  }
  Bytes frame;
  append_stream_frame(ids, sent, frame);
  OiDecoder decoder(ids);
  const Bytes torn(frame.begin() + 20, frame.end());
  EXPECT_EQ(decode(decoder, torn + repeated(frame, 5)).size(), 5U);
}

TEST(OiDecoder, BootTextBetweenFramesIsSkippedAndKnown) {
  const std::string text = "Roomba by iRobot!\r\nrelease-stm32-3.7.7:6913\r\n";
  OiDecoder decoder(kManualIds);
  Bytes cut = manual_frame(163);
  cut.resize(4);
  const auto frames = decode(decoder, cut + Bytes(text.begin(), text.end()) + manual_frame(163));
  EXPECT_EQ(frames.size(), 1U);
  EXPECT_EQ(decoder.boot_text().boot_lines(), 2);
  EXPECT_EQ(decoder.boot_text().firmware(), (Firmware{3, 7, 7}));
}

TEST(OiDecoder, RestartForgetsAFrameBegun) {
  OiDecoder decoder(kManualIds);
  decode(decoder, {19, 5, 29});
  decoder.restart();
  EXPECT_EQ(decode(decoder, {2, 25, 13, 0, 163}).size(), 0U);
  EXPECT_EQ(decode(decoder, manual_frame(163)).size(), 1U);
}

TEST(OiDecoder, RefusesAStreamNobodyCanSend) {
  EXPECT_THROW(OiDecoder(Bytes{}), std::invalid_argument);
  EXPECT_THROW(OiDecoder(Bytes{59}), std::invalid_argument);
  EXPECT_THROW(OiDecoder(Bytes{100, 100, 100, 6}), std::invalid_argument);
}

}  // namespace
}  // namespace roomwise::create
