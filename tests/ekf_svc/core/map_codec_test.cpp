#include "services/ekf_svc/core/map_codec.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/ekf_svc/support/filter_run.h"

namespace roomwise::ekf {
namespace {

MapSnapshot small_map() {
  KnownIdentityRun run({}, 5);
  SlamFilter filter(ErrorForm::kInvariant, 64);
  filter.free_calibration({0.01, 0.02, 0.03});
  for (int step = 0; step < 60; ++step) run.step({&filter}, {});
  MapSnapshot map;
  filter.save(map);
  return map;
}

TEST(MapCodec, BytesGiveTheMapBack) {
  const MapSnapshot map = small_map();
  MapSnapshot again;
  ASSERT_EQ(decode_map(encode_map(map), again), MapVerdict::kOk);
  ASSERT_EQ(again.landmarks.size(), map.landmarks.size());
  for (std::size_t l = 0; l < map.landmarks.size(); ++l) {
    EXPECT_EQ(again.landmarks[l].map_id, map.landmarks[l].map_id);
    EXPECT_EQ(again.positions_m[l], map.positions_m[l]);
  }
  EXPECT_EQ(again.covariance_m2, map.covariance_m2);
  EXPECT_EQ(again.calibration.value, map.calibration.value);
  EXPECT_EQ(again.next_map_id, map.next_map_id);
  EXPECT_EQ(encode_map(again), encode_map(map));
}

TEST(MapCodec, AFilterGoesOnFromASavedMap) {
  KnownIdentityRun run({}, 5);
  SlamFilter filter(ErrorForm::kInvariant, 64);
  for (int step = 0; step < 60; ++step) run.step({&filter}, {});
  MapSnapshot map, again;
  filter.save(map);
  SlamFilter later(ErrorForm::kInvariant, 64);
  ASSERT_TRUE(later.restore(map, filter.pose(), Eigen::Matrix3d::Identity()));
  later.save(again);
  EXPECT_EQ(again.covariance_m2, map.covariance_m2);
  EXPECT_EQ(later.pose().x_m, filter.pose().x_m);
  SlamFilter small(ErrorForm::kInvariant, 2);
  EXPECT_FALSE(small.restore(map, {}, Eigen::Matrix3d::Identity()));
}

TEST(MapCodec, EveryFlippedBitIsNoticed) {
  std::vector<std::uint8_t> bytes = encode_map(small_map());
  MapSnapshot untouched;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] ^= static_cast<std::uint8_t>(1U << (i % 8));
    ASSERT_NE(decode_map(bytes, untouched), MapVerdict::kOk) << "byte " << i;
    bytes[i] ^= static_cast<std::uint8_t>(1U << (i % 8));
  }
  EXPECT_TRUE(untouched.empty());
}

TEST(MapCodec, EveryCutIsNoticed) {
  const std::vector<std::uint8_t> bytes = encode_map(small_map());
  MapSnapshot untouched;
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    ASSERT_NE(decode_map(std::span(bytes).first(size), untouched), MapVerdict::kOk) << size;
  }
  std::vector<std::uint8_t> longer = bytes;
  longer.push_back(0);
  EXPECT_NE(decode_map(longer, untouched), MapVerdict::kOk);
}

TEST(MapCodec, NumbersNoMapHasAreRefusedWhateverTheChecksumSays) {
  const auto refused = [](auto spoil) {
    MapSnapshot map = small_map();
    spoil(map);
    MapSnapshot untouched;
    return decode_map(encode_map(map), untouched) == MapVerdict::kNumbersInvalid;
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(refused([](auto& map) { map.positions_m[1].x() = kNan; }));
  EXPECT_TRUE(refused([](auto& map) { map.positions_m[1].y() = 1e300; }));
  EXPECT_TRUE(refused([](auto& map) { map.covariance_m2[0] = -1.0; }));
  EXPECT_TRUE(refused([](auto& map) { map.covariance_m2[5] = kNan; }));
  EXPECT_TRUE(refused([](auto& map) { map.landmarks[1].map_id = map.landmarks[0].map_id; }));
  EXPECT_TRUE(refused([](auto& map) { map.next_map_id = 1; }));
  EXPECT_TRUE(refused([](auto& map) { map.calibration.value(0) = 9.0; }));
  EXPECT_TRUE(refused([](auto& map) { map.landmarks[0].times_seen = -1; }));
}

}  // namespace
}  // namespace roomwise::ekf
