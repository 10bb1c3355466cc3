#include "logs/tools/score_floor.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <zstd.h>

#include "common/bus/log_bus.h"
#include "logs/tools/label_image.h"
#include "logs/tools/score.h"
#include "logs/tools/true_floor.h"
#include "tests/support/events.h"

namespace roomwise {
namespace {

constexpr int kFloor = segmentation_t::LABEL_ACCESSIBLE;

TEST(ScoreFloor, CountsByTruthAndCall) {
  const cv::Mat1b mask = (cv::Mat1b(1, 8) << 255, 255, 255, 0, 0, 0, 128, 128);
  const cv::Mat1b labels = (cv::Mat1b(1, 8) << kFloor, kFloor, 255, kFloor, 0, 100, kFloor, 0);
  const FloorCounts counts = count_floor(labels, mask);
  EXPECT_EQ(counts.floor_called_floor, 2);
  EXPECT_EQ(counts.floor_called_other, 1);
  EXPECT_EQ(counts.other_called_floor, 1);
  EXPECT_EQ(counts.other_called_other, 2);
  EXPECT_DOUBLE_EQ(counts.iou_ratio(), 0.5);
  EXPECT_DOUBLE_EQ(counts.precision_ratio(), 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(counts.recall_ratio(), 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(counts.nonfloor_called_floor_ratio(), 1.0 / 3.0);
}

TEST(ScoreFloor, LabelsOfHalfTheSizeAreComparedPlaceByPlace) {
  const cv::Mat1b mask = (cv::Mat1b(2, 4) << 255, 255, 0, 0, 255, 255, 0, 0);
  const cv::Mat1b labels = (cv::Mat1b(1, 2) << kFloor, 0);
  const FloorCounts counts = count_floor(labels, mask);
  EXPECT_EQ(counts.floor_called_floor, 4);
  EXPECT_EQ(counts.other_called_other, 4);
}

TEST(ScoreFloor, PoolsPixelsAndAveragesFrames) {
  const FloorCounts perfect{.floor_called_floor = 30,
                            .floor_called_other = 0,
                            .other_called_floor = 0,
                            .other_called_other = 10};
  const FloorCounts half{.floor_called_floor = 5,
                         .floor_called_other = 5,
                         .other_called_floor = 0,
                         .other_called_other = 10};
  const Scores scores = score_floor({perfect, half});
  EXPECT_EQ(scores[0], (std::pair<std::string, double>("floor_iou", 35.0 / 40.0)));
  EXPECT_EQ(scores[4], (std::pair<std::string, double>("floor_iou_mean", 0.75)));
  EXPECT_EQ(scores[5], (std::pair<std::string, double>("floor_frames", 2.0)));
}

TEST(ScoreFloor, NothingToDivideByIsZeroNotNan) {
  const Scores scores = score_floor({FloorCounts{}});
  for (const auto& [name, value] : scores) EXPECT_TRUE(std::isfinite(value)) << name;
  EXPECT_TRUE(score_floor({}).empty());
}

segmentation_t labels_message(int width_px, int height_px, std::vector<std::uint8_t> data) {
  segmentation_t message{};
  message.label_width_px = width_px;
  message.label_height_px = height_px;
  message.label_size = static_cast<std::int32_t>(data.size());
  message.label_data = std::move(data);
  return message;
}

std::vector<std::uint8_t> compressed(const std::vector<std::uint8_t>& bytes) {
  std::vector<std::uint8_t> out(ZSTD_compressBound(bytes.size()));
  out.resize(ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), 1));
  return out;
}

TEST(LabelImage, RawAndZstdGiveTheSamePixels) {
  const std::vector<std::uint8_t> pixels{0, 50, 100, 200, 255, 7};
  segmentation_t raw = labels_message(3, 2, pixels);
  segmentation_t zstd = labels_message(3, 2, compressed(pixels));
  zstd.label_encoding = segmentation_t::ENCODING_ZSTD;
  const auto a = decode_labels(raw);
  const auto b = decode_labels(zstd);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(cv::countNonZero(*a != *b), 0);
  EXPECT_EQ((*a)(1, 0), 200);
}

TEST(LabelImage, RefusesWhatIsNotExactlyTheImage) {
  const std::vector<std::uint8_t> six(6, 200);
  EXPECT_FALSE(decode_labels(labels_message(3, 3, six)));
  EXPECT_FALSE(decode_labels(labels_message(0, 0, {})));
  EXPECT_FALSE(decode_labels(labels_message(-3, -2, six)));
  EXPECT_FALSE(decode_labels(labels_message(2'000'000'000, 2'000'000'000, six)));
  for (const int height_px : {1, 3}) {
    segmentation_t zstd = labels_message(3, height_px, compressed(six));
    zstd.label_encoding = segmentation_t::ENCODING_ZSTD;
    EXPECT_FALSE(decode_labels(zstd)) << height_px;
  }
  segmentation_t unknown = labels_message(3, 2, six);
  unknown.label_encoding = 9;
  EXPECT_FALSE(decode_labels(unknown));
}

RC_GTEST_PROP(LabelImage, AnyBytesAreSafe, (std::vector<std::uint8_t> bytes, bool zstd)) {
  segmentation_t message = labels_message(4, 4, bytes);
  message.label_encoding = zstd ? segmentation_t::ENCODING_ZSTD : segmentation_t::ENCODING_RAW8;
  const auto labels = decode_labels(message);
  if (labels) RC_ASSERT(labels->total() == 16U);
}

segmentation_t of_frame(std::int64_t frame_seq, std::vector<std::uint8_t> labels) {
  segmentation_t message = labels_message(static_cast<int>(labels.size()), 1, labels);
  message.frame_seq = frame_seq;
  return message;
}

TEST(TrueFloor, ComparesLabelsOfTheSameFrameInWhicheverOrderTheyCome) {
  const std::vector<LogEvent> events{
      event_of(channels::kTrueSegments, 1, of_frame(7, {kFloor, kFloor, 0, 255})),
      event_of(channels::kSegments, 2, of_frame(8, {kFloor})),
      event_of(channels::kSegments, 3, of_frame(7, {kFloor, 0, kFloor, kFloor})),
      event_of(channels::kTrueSegments, 4, of_frame(8, {100})),
      event_of(channels::kSegments, 5, of_frame(9, {kFloor}))};
  std::vector<LogEvent> output;
  LogBus bus(events, output);
  TrueFloor floor;
  floor.gather(bus);
  bus.run();
  ASSERT_EQ(floor.frames().size(), 2U);
  EXPECT_EQ(floor.frames()[0].floor_called_floor, 1);
  EXPECT_EQ(floor.frames()[0].floor_called_other, 1);
  EXPECT_EQ(floor.frames()[0].other_called_floor, 1) << "the pixel of unknown truth is left out";
  EXPECT_EQ(floor.frames()[1].other_called_floor, 1);
}

}  // namespace
}  // namespace roomwise
