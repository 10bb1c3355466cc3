#include "services/landmark_svc/core/scan_clusters.h"

#include <cstdint>
#include <cstring>

#include "common/multiversion.h"

namespace roomwise::landmark {
namespace {

using Floats [[gnu::vector_size(32), gnu::may_alias]] = float;
using Mask [[gnu::vector_size(32), gnu::may_alias]] = std::int32_t;
using Tiers = ScanClusters::Tiers;
static_assert(sizeof(Floats) == ScanClusters::kAtOnce * sizeof(float));

constexpr float kApart_quanta = 2.0F;
constexpr float kApart_ratio = 0.03F;

ROOMWISE_IN_EACH_VERSION bool any(const Mask& mask) {
  std::uint64_t parts[sizeof(Mask) / sizeof(std::uint64_t)];
  std::memcpy(parts, &mask, sizeof parts);
  return (parts[0] | parts[1] | parts[2] | parts[3]) != 0;
}

/// One tier's columns as vectors.
struct Cluster {
  ROOMWISE_IN_EACH_VERSION explicit Cluster(ScanClusters::Tier& tier)
      : sum(reinterpret_cast<Floats&>(tier.sum)),
        rows(reinterpret_cast<Floats&>(tier.rows)),
        v_top_px(reinterpret_cast<Floats&>(tier.v_top_px)),
        v_bottom_px(reinterpret_cast<Floats&>(tier.v_bottom_px)) {}

  Floats& sum;
  Floats& rows;
  Floats& v_top_px;
  Floats& v_bottom_px;
};

/// Readings within reach of the cluster's mean join it and are no longer `left`. Both sides of the
/// test are times `rows`, so that nothing divides; an empty cluster is never within reach.
ROOMWISE_IN_EACH_VERSION void join(Cluster cluster, const Floats& quanta, float v_px, Mask& left) {
  const Floats off = quanta * cluster.rows - cluster.sum;
  const Floats apart = off < 0.0F ? -off : off;
  const Mask joins = left & (apart < kApart_quanta * cluster.rows + kApart_ratio * cluster.sum);
  cluster.sum += joins ? quanta : Floats{};
  cluster.rows += joins ? Floats{} + 1.0F : Floats{};
  cluster.v_bottom_px = joins ? Floats{} + v_px : cluster.v_bottom_px;
  left &= ~joins;
}

ROOMWISE_IN_EACH_VERSION void begin(Cluster cluster, const Floats& quanta, float v_px,
                                    const Mask& where) {
  cluster.sum = where ? quanta : cluster.sum;
  cluster.rows = where ? Floats{} + 1.0F : cluster.rows;
  cluster.v_top_px = where ? Floats{} + v_px : cluster.v_top_px;
  cluster.v_bottom_px = where ? Floats{} + v_px : cluster.v_bottom_px;
}

/// Readings `where` there is an empty cluster begin the first such.
ROOMWISE_IN_EACH_VERSION void begin_empty(Tiers& tiers, const Floats& quanta, float v_px,
                                          const Mask& where) {
  Mask left = where;
  for (ScanClusters::Tier& tier : tiers) {
    const Cluster cluster(tier);
    const Mask begins = left & (cluster.rows == 0.0F);
    begin(cluster, quanta, v_px, begins);
    left &= ~begins;
  }
}

/// Readings `where` all clusters are full begin in place of the farthest, if it is farther.
ROOMWISE_IN_EACH_VERSION void begin_for_farthest(Tiers& tiers, const Floats& quanta, float v_px,
                                                 const Mask& where) {
  const Cluster first(tiers[0]);
  const Cluster second(tiers[1]);
  const Cluster third(tiers[2]);
  const Mask is_second = second.sum * first.rows < first.sum * second.rows;
  Floats sum = is_second ? second.sum : first.sum;
  Floats rows = is_second ? second.rows : first.rows;
  const Mask is_third = third.sum * rows < sum * third.rows;
  sum = is_third ? third.sum : sum;
  rows = is_third ? third.rows : rows;
  const Mask begins = where & (sum < quanta * rows);
  if (!any(begins)) return;
  begin(third, quanta, v_px, begins & is_third);
  begin(second, quanta, v_px, begins & ~is_third & is_second);
  begin(first, quanta, v_px, begins & ~is_third & ~is_second);
}

ROOMWISE_MULTIVERSION_256
void add_to_all(Tiers* columns, std::size_t count, float v_px, const float* readings) {
  for (std::size_t i = 0; i < count; ++i) {
    Floats quanta;
    std::memcpy(&quanta, readings + i * ScanClusters::kAtOnce, sizeof quanta);
    Mask left = quanta > 0.0F;
    for (ScanClusters::Tier& tier : columns[i]) {
      if (!any(left)) break;
      join(Cluster(tier), quanta, v_px, left);
    }
    if (!any(left)) continue;
    // The tiers fill in their order.
    const Mask is_full = Cluster(columns[i].back()).rows > 0.0F;
    const Mask finds_empty = left & ~is_full;
    const Mask finds_full = left & is_full;
    if (any(finds_empty)) begin_empty(columns[i], quanta, v_px, finds_empty);
    if (any(finds_full)) begin_for_farthest(columns[i], quanta, v_px, finds_full);
  }
}

}  // namespace

void ScanClusters::reserve(std::size_t columns) { columns_.reserve(padded(columns) / kAtOnce); }

void ScanClusters::clear(std::size_t columns) {
  columns_.assign(padded(columns) / kAtOnce, Tiers{});
}

void ScanClusters::add_row(int v_px, const float* quanta) {
  add_to_all(columns_.data(), columns_.size(), static_cast<float>(v_px), quanta);
}

std::optional<ScanCluster> ScanClusters::nearest(std::size_t column, double rows_min) const {
  std::optional<ScanCluster> nearest;
  const std::size_t i = column % kAtOnce;
  for (const Tier& tier : columns_[column / kAtOnce]) {
    if (tier.rows[i] == 0.0F || tier.rows[i] < rows_min) continue;
    const float quanta = tier.sum[i] / tier.rows[i];
    if (nearest && quanta <= nearest->quanta) continue;
    nearest =
        ScanCluster{quanta, static_cast<int>(tier.rows[i]), static_cast<int>(tier.v_top_px[i]),
                    static_cast<int>(tier.v_bottom_px[i])};
  }
  return nearest;
}

}  // namespace roomwise::landmark
