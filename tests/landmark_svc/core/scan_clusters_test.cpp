#include "services/landmark_svc/core/scan_clusters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace roomwise::landmark {
namespace {

constexpr std::size_t kPadded = 24;

/// What ScanClusters does, one column and one reading at a time.
class OneColumn {
 public:
  void add(int v_px, float quanta) {
    for (ScanCluster& cluster : clusters_) {
      if (std::abs(quanta - cluster.quanta) >= 2.0F + 0.03F * cluster.quanta) continue;
      const auto rows = static_cast<float>(cluster.rows);
      cluster.quanta = (cluster.quanta * rows + quanta) / (rows + 1.0F);
      ++cluster.rows;
      cluster.v_bottom_px = v_px;
      return;
    }
    const ScanCluster begun{quanta, 1, v_px, v_px};
    if (clusters_.size() < 3) {
      clusters_.push_back(begun);
      return;
    }
    auto farthest = std::min_element(
        clusters_.begin(), clusters_.end(),
        [](const ScanCluster& a, const ScanCluster& b) { return a.quanta < b.quanta; });
    if (farthest->quanta < quanta) *farthest = begun;
  }

  std::optional<ScanCluster> nearest(double rows_min) const {
    std::optional<ScanCluster> found;
    for (const ScanCluster& cluster : clusters_) {
      if (cluster.rows < rows_min || (found && cluster.quanta <= found->quanta)) continue;
      found = cluster;
    }
    return found;
  }

 private:
  std::vector<ScanCluster> clusters_;
};

/// Readings around a few distances, far enough apart that rounding does not choose the cluster.
float any_reading(std::mt19937_64& engine) {
  constexpr float kDistances_quanta[] = {90.0F, 120.0F, 160.0F, 210.0F, 280.0F};
  if (engine() % 4 == 0) return 0.0F;
  const float noise = std::uniform_real_distribution<float>(-0.5F, 0.5F)(engine);
  return kDistances_quanta[engine() % 5] + noise;
}

TEST(ScanClusters, EveryColumnIsSortedAsIfItWereAlone) {
  std::mt19937_64 engine(11);
  for (const std::size_t columns : {1U, 7U, 8U, 19U, 24U}) {
    ScanClusters clusters;
    clusters.clear(columns);
    std::vector<OneColumn> alone(columns);
    for (int v = 0; v < 40; ++v) {
      std::vector<float> row(kPadded, 0.0F);
      for (std::size_t u = 0; u < columns; ++u) {
        row[u] = any_reading(engine);
        if (row[u] > 0.0F) alone[u].add(v, row[u]);
      }
      clusters.add_row(v, row.data());
    }
    for (std::size_t u = 0; u < columns; ++u) {
      for (const double rows_min : {1.0, 4.0, 9.0}) {
        const auto expected = alone[u].nearest(rows_min);
        const auto found = clusters.nearest(u, rows_min);
        ASSERT_EQ(found.has_value(), expected.has_value()) << columns << " " << u;
        if (!found) continue;
        EXPECT_NEAR(found->quanta, expected->quanta, 1e-3);
        EXPECT_EQ(found->rows, expected->rows);
        EXPECT_EQ(found->v_top_px, expected->v_top_px);
        EXPECT_EQ(found->v_bottom_px, expected->v_bottom_px);
      }
    }
  }
}

TEST(ScanClusters, TheFarthestGivesWayToWhatIsNearer) {
  ScanClusters clusters;
  clusters.clear(1);
  int v = 0;
  for (const float quanta : {100.0F, 150.0F, 200.0F, 90.0F, 250.0F}) {
    std::vector<float> row(ScanClusters::kAtOnce, 0.0F);
    row[0] = quanta;
    clusters.add_row(v++, row.data());
  }
  const auto nearest = clusters.nearest(0, 1.0);
  ASSERT_TRUE(nearest);
  EXPECT_EQ(nearest->quanta, 250.0F);
  EXPECT_EQ(nearest->v_top_px, 4);
}

TEST(ScanClusters, FewRowsAreNoCluster) {
  ScanClusters clusters;
  clusters.clear(3);
  EXPECT_FALSE(clusters.nearest(2, 0.0));
  std::vector<float> row(ScanClusters::kAtOnce, 0.0F);
  row[2] = 100.0F;
  clusters.add_row(5, row.data());
  EXPECT_TRUE(clusters.nearest(2, 1.0));
  EXPECT_FALSE(clusters.nearest(2, 2.0));
}

}  // namespace
}  // namespace roomwise::landmark
