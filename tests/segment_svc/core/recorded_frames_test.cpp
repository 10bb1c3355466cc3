#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <vector>

#include "services/segment_svc/core/segmenter.h"
#include "tests/segment_svc/support/recorded_views.h"
#include "tests/support/shared_data.h"

namespace roomwise::segment {
namespace {

struct FloorCounts {
  double right = 0.0;
  double missed = 0.0;
  double missed_as_standing = 0.0;  // of those, called obstacle or wall
  double wrong = 0.0;
  double other = 0.0;
  double iou() const { return right / (right + missed + wrong); }
};

void add(const std::vector<std::uint8_t>& labels, const std::vector<std::uint8_t>& mask,
         FloorCounts& counts) {
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const bool is_called = labels[i] == kAccessible;
    if (mask[i] == 255) ++(is_called ? counts.right : counts.missed);
    const bool stands = labels[i] == kObstacle || labels[i] == kWall;
    if (mask[i] == 255 && stands) ++counts.missed_as_standing;
    if (mask[i] == 0) ++(is_called ? counts.wrong : counts.other);
  }
}

/// One segmenter that is told its camera starts at this height.
struct Claim {
  explicit Claim(double claimed_height_m) : height_m(claimed_height_m), mounting(height_m) {}

  double height_m;
  recorded::Mounting mounting;
  Segmenter segmenter{SegmentParams{}};
  Segmentation result;
  FloorCounts counts;
};

/// Each image is read once for all of them.
void score(std::vector<Claim>& claims) {
  for (int i = 0; i < recorded::kFrames; ++i) {
    RgbdFrame frame =
        recorded::read_frame(i, Eigen::Isometry3d::Identity(), recorded::Color::kNone);
    const auto mask = recorded::read_floor_mask(i);
    for (Claim& claim : claims) {
      frame.T_robot_camera = claim.mounting(i);
      claim.segmenter.segment(frame, claim.result);
      EXPECT_TRUE(claim.result.floor.trusted) << i;
      if (mask) add(claim.result.labels, *mask, claim.counts);
    }
  }
}

TEST(RecordedFrames, FloorIsFoundWhateverHeightIsClaimed) {
  ROOMWISE_NEED_DATA(recorded::kFolder);
  std::vector<Claim> claims;
  for (const double claimed_height_m : {0.3, 1.2, 1.9}) claims.emplace_back(claimed_height_m);
  score(claims);
  for (const Claim& claim : claims) {
    const FloorCounts& counts = claim.counts;
    const double wrong_ratio = counts.wrong / (counts.wrong + counts.other);
    std::printf(
        "claimed %.1f m: floor IoU %.4f, other called floor %.4f, floor called standing %.4f\n",
        claim.height_m, counts.iou(), wrong_ratio,
        counts.missed_as_standing / (counts.right + counts.missed));
    // The masks call everything within 3 cm of one plane floor, the feet of cupboards and chairs
    // too; what is called standing there is counted as missed.
    EXPECT_GE(counts.iou(), 0.95) << claim.height_m;
    EXPECT_GE((counts.right + counts.missed_as_standing) / (counts.right + counts.missed), 0.99)
        << claim.height_m;
    EXPECT_LE(wrong_ratio, 0.002) << claim.height_m;
  }
}

}  // namespace
}  // namespace roomwise::segment
