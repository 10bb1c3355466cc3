// Maps made by hand: where a small one is found in a large one, and where nothing must be found.
#include "services/ekf_svc/core/relocaliser.h"

#include <gtest/gtest.h>

#include <random>

namespace roomwise::ekf {
namespace {

constexpr double kMeasured_m = 0.01;  // of every landmark, independently
constexpr double kMisplaced_m = 0.1;

using Points = std::vector<Eigen::Vector2d>;

MapSnapshot map_of(const Points& positions_m) {
  MapSnapshot map;
  map.positions_m = positions_m;
  map.landmarks.resize(positions_m.size());
  const std::size_t size = 2 * positions_m.size();
  map.covariance_m2.assign(size * (size + 1) / 2, 0.0);
  for (std::size_t i = 0; i < size; ++i) {
    map.covariance_m2[i * size - i * (i + 1) / 2 + i] = kMeasured_m * kMeasured_m;
  }
  for (std::size_t l = 0; l < positions_m.size(); ++l) {
    map.landmarks[l].map_id = static_cast<std::int64_t>(l) + 1;
    map.landmarks[l].times_seen = 5;
  }
  map.next_map_id = static_cast<std::int64_t>(positions_m.size()) + 1;
  return map;
}

/// Numbers are drawn between braces, which every compiler works through in order: the same worlds.
class RelocaliserTest : public testing::Test {
 protected:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }

  /// `count` landmarks anywhere in a square room.
  Points room(int count, double side_m, const Eigen::Vector2d& corner_m = {0.0, 0.0}) {
    Points points;
    while (static_cast<int>(points.size()) < count) {
      points.push_back(corner_m + Eigen::Vector2d{uniform(0.0, side_m), uniform(0.0, side_m)});
    }
    return points;
  }

  /// Two walls of a corridor along x, landmarks in a row on both, each a little off its place.
  Points corridor(int pairs, double spacing_m) {
    Points points;
    for (int i = 0; i < pairs; ++i) {
      for (const double y : {-1.0, 1.0}) {
        points.push_back(Eigen::Vector2d{(i + uniform(-1.0 / 6.0, 1.0 / 6.0)) * spacing_m,
                                         y + uniform(-0.05, 0.05)});
      }
    }
    return points;
  }

  /// The same landmarks measured anew, in the frame of a robot that woke up at `T_map_local`.
  Points measured(const Points& points, const Pose2& T_map_local) {
    std::normal_distribution<double> normal(0.0, kMeasured_m);
    Points local;
    for (const Eigen::Vector2d& p : points) {
      local.push_back(transform(inverse(T_map_local), p) +
                      Eigen::Vector2d{normal(engine_), normal(engine_)});
    }
    return local;
  }

  Pose2 somewhere() { return {uniform(-9.0, 9.0), uniform(-9.0, 9.0), uniform(-3.1, 3.1)}; }

  std::mt19937_64 engine_{5};
};

Points joined(const Points& a, const Points& b) {
  Points all = a;
  all.insert(all.end(), b.begin(), b.end());
  return all;
}

Points moved_by(const Points& points, const Pose2& motion) {
  Points moved;
  for (const Eigen::Vector2d& p : points) moved.push_back(transform(motion, p));
  return moved;
}

TEST_F(RelocaliserTest, AMapIsFoundWhereverItsFrameLies) {
  for (int round = 0; round < 20; ++round) {
    const Points points = room(30, 8.0);
    const Pose2 truth = somewhere();
    const Points seen(points.begin(), points.begin() + 9);
    const auto place = Relocaliser(map_of(points)).find(map_of(measured(seen, truth)));
    ASSERT_TRUE(place) << "round " << round;
    EXPECT_LT((place->fit.T_map_local.position_m() - truth.position_m()).norm(), kMisplaced_m);
  }
}

// Under sanitizers a round takes seconds.
#ifdef ROOMWISE_SANITIZED
constexpr int kRowRounds = 2, kElsewhereRounds = 2;
#else
constexpr int kRowRounds = 200, kElsewhereRounds = 20;
#endif

// Most landmarks of a row fit one step further on too, but not as well.
TEST_F(RelocaliserTest, ARobotInARowOfLandmarksIsFoundBetweenPlacesThatFitNearlyAsMany) {
  int found = 0;
  for (int round = 0; round < kRowRounds; ++round) {
    const Points points = corridor(40, 0.6);
    const Points seen(points.begin() + 40, points.begin() + 52);
    const Pose2 truth = somewhere();
    const auto place = Relocaliser(map_of(points)).find(map_of(measured(seen, truth)));
    if (!place) continue;
    ++found;
    EXPECT_EQ(place->pairs.front().old, place->pairs.front().recent + 40) << "round " << round;
  }
  EXPECT_GE(found, kRowRounds * 95 / 100);
}

TEST_F(RelocaliserTest, OfTwoRoomsThatAreAlikeNoneIsChosen) {
  for (int round = 0; round < 20; ++round) {
    const Points points = room(14, 5.0);
    const Relocaliser relocaliser(map_of(joined(points, moved_by(points, {20.0, 3.0, 1.0}))));
    EXPECT_FALSE(relocaliser.find(map_of(measured(points, somewhere())))) << "round " << round;
  }
}

// One thing that was moved would lead the robot into the wrong room.
TEST_F(RelocaliserTest, OneLandmarkThatDiffersDoesNotTellTwoRoomsApart) {
  for (int round = 0; round < 20; ++round) {
    const Points points = room(14, 5.0);
    Points twin = moved_by(points, {20.0, 3.0, 1.0});
    twin.front() += Eigen::Vector2d(0.7, 0.7);
    const Relocaliser relocaliser(map_of(joined(points, twin)));
    EXPECT_FALSE(relocaliser.find(map_of(measured(points, somewhere())))) << "round " << round;
  }
}

TEST_F(RelocaliserTest, APlaceThatIsNotInTheMapIsNotFound) {
  for (int round = 0; round < kElsewhereRounds; ++round) {
    const Relocaliser relocaliser(map_of(corridor(60, 0.6)));
    for (int count = 7; count <= 11; count += 2) {
      Points elsewhere = corridor(6, 0.6);
      elsewhere.resize(static_cast<std::size_t>(count));
      EXPECT_FALSE(relocaliser.find(map_of(measured(elsewhere, somewhere()))))
          << "round " << round << ", " << count << " landmarks";
    }
  }
}

TEST_F(RelocaliserTest, FiveLandmarksAreTooFewHoweverWellTheyFit) {
  const Points points = room(30, 8.0);
  const Points seen(points.begin(), points.begin() + 5);
  EXPECT_FALSE(Relocaliser(map_of(points)).find(map_of(measured(seen, {}))));
}

}  // namespace
}  // namespace roomwise::ekf
