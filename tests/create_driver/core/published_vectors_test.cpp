// Byte strings published for the Open Interface, kept outside the project.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "common/create/oi_decoder.h"
#include "services/create_driver/core/oi_encoder.h"
#include "tests/support/shared_data.h"

namespace roomwise::create {
namespace {

/// Decimal bytes at the beginning of `text`.
Bytes bytes_in(const std::string& text) {
  std::istringstream words(text);
  Bytes bytes;
  for (int byte = 0; words >> byte;) bytes.push_back(static_cast<std::uint8_t>(byte));
  return bytes;
}

/// The lines `left : right` of the file, by the first two words of the left.
std::map<std::string, std::pair<std::string, std::string>> lines_by_first_words() {
  std::ifstream file(shared_data() / "create_oi_vectors" / "vectors.txt");
  std::map<std::string, std::pair<std::string, std::string>> lines;
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(" : ");
    if (line.starts_with('#') || colon == std::string::npos) continue;
    lines[line.substr(0, line.find(' ', line.find(' ') + 1))] = {line.substr(0, colon),
                                                                 line.substr(colon + 3)};
  }
  return lines;
}

class PublishedVectors : public ::testing::Test {
 protected:
  void SetUp() override {
    ROOMWISE_NEED_DATA("create_oi_vectors/vectors.txt");
    lines_ = lines_by_first_words();
  }
  std::map<std::string, std::pair<std::string, std::string>> lines_;
};

TEST_F(PublishedVectors, TheStreamRequestIsOurs) {
  Bytes ours;
  append_stream_request(Bytes{29, 13}, ours);
  EXPECT_EQ(ours, bytes_in(lines_["stream cliff-left-signal"].second));
}

TEST_F(PublishedVectors, TheFrameDecodes) {
  const Bytes frame = bytes_in(lines_["19 5"].first);
  ASSERT_EQ(frame.size(), 8U);
  OiDecoder decoder(Bytes{29, 13});
  int frames = 0;
  decoder.push(frame, [&](const StreamFrame& found) {
    ++frames;
    EXPECT_EQ(found.packets[Packet::kCliffFrontLeftSignal], 537);
    EXPECT_EQ(found.packets[Packet::kVirtualWall], 0);
  });
  EXPECT_EQ(frames, 1);
}

TEST_F(PublishedVectors, MinusTwoHundredMillimetresAreTheSameTwoBytes) {
  const Bytes drive = bytes_in(lines_["drive v=-200"].second);  // 137, then velocity and radius
  ASSERT_EQ(drive.size(), 5U);
  Bytes ours;
  append_drive({0.5, -0.2}, ours);
  EXPECT_EQ(Bytes(ours.begin() + 1, ours.end()), Bytes(drive.begin() + 1, drive.end()));
}

TEST_F(PublishedVectors, TheRightWheelComesFirst) {
  EXPECT_NE(lines_["drive_direct order"].second.find("145 RIGHT_hi RIGHT_lo LEFT_hi LEFT_lo"),
            std::string::npos);
  Bytes ours;
  append_drive({0.001, 0.258}, ours);
  EXPECT_EQ(ours, (Bytes{145, 1, 2, 0, 1}));
}

}  // namespace
}  // namespace roomwise::create
