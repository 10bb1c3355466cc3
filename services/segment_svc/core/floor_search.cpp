#include "services/segment_svc/core/floor_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace roomwise::segment {
namespace {

constexpr double kHeightBin_m = 0.02;
constexpr int kBandBins = 3;                                      // a plane's band: 6 cm each side
constexpr int kAboveBins = 6;                                     // above the band: 12 cm
constexpr int kApartBins = 5;                                     // between planes: 10 cm
constexpr double kTiltStep_rad = 3.5 * std::numbers::pi / 180.0;  // 6 cm at 1 m
constexpr std::size_t kThinning = 3;  // every third point is enough to start from
constexpr int kVotesMin = 25;
constexpr int kVotesMinShare = 60;  // at least 1 / 60 of the points
constexpr std::size_t kPlanesMax = 8;

}  // namespace

const std::vector<FloorPlane>& FloorSearch::search(const std::vector<FloorPoint>& points,
                                                   const FloorPlane& mounted) {
  best_of_height_.fill(Best{});
  const Eigen::Vector3d first = mounted.normal.unitOrthogonal();
  const Eigen::Vector3d second = mounted.normal.cross(first);
  const int steps = static_cast<int>(limits_.tilt_max_rad / kTiltStep_rad);
  for (int i = -steps; i <= steps; ++i) {
    for (int j = -steps; j <= steps; ++j) {
      if (i * i + j * j > steps * steps) continue;
      const Eigen::Vector3d tilt = kTiltStep_rad * (i * first + j * second);
      try_tilt(points, (mounted.normal + tilt).normalized());
    }
  }
  collect(points.size() / kThinning);
  return found_;
}

void FloorSearch::try_tilt(const std::vector<FloorPoint>& points, const Eigen::Vector3d& normal) {
  below_.fill(0);
  const Eigen::Vector3f per_bin = (normal / -kHeightBin_m).cast<float>();
  for (std::size_t i = 0; i < points.size(); i += kThinning) {
    const auto bin = static_cast<int>(std::min(per_bin.dot(points[i].p_camera_m), kBins - 1.0F));
    if (bin >= 0) ++below_[static_cast<std::size_t>(bin)];
  }
  for (std::size_t i = 1; i < below_.size(); ++i) below_[i] += below_[i - 1];

  const int lowest = static_cast<int>(limits_.camera_height_max_m / kHeightBin_m);
  for (int bin = static_cast<int>(limits_.camera_height_min_m / kHeightBin_m); bin <= lowest;
       ++bin) {
    const int on = up_to(bin + kBandBins) - up_to(bin - kBandBins - 1);
    const int above = up_to(bin - kBandBins - 1) - up_to(bin - kBandBins - kAboveBins - 1);
    const int beneath = below_.back() - up_to(bin + kBandBins + 2);
    Best& best = best_of_height_[static_cast<std::size_t>(std::min(bin, kBins - 1))];
    if (10 * beneath <= on && on - above > best.votes) {
      best = {.votes = on - above, .normal = normal};
    }
  }
}

int FloorSearch::up_to(int bin) const {
  if (bin < 0) return 0;
  return below_[static_cast<std::size_t>(std::min(bin, kBins - 1))];
}

void FloorSearch::collect(std::size_t point_count) {
  found_.clear();
  found_.reserve(kPlanesMax);
  const int votes_min = std::max(kVotesMin, static_cast<int>(point_count) / kVotesMinShare);
  for (int bin = kBins - 1; bin >= 0 && found_.size() < kPlanesMax; --bin) {
    if (best_of_height_[static_cast<std::size_t>(bin)].votes < votes_min) continue;
    int best = bin;
    for (int near = bin; near > std::max(-1, bin - kApartBins); --near) {
      const auto votes = [&](int i) { return best_of_height_[static_cast<std::size_t>(i)].votes; };
      if (votes(near) > votes(best)) best = near;
    }
    found_.push_back({.normal = best_of_height_[static_cast<std::size_t>(best)].normal,
                      .height_m = (best + 0.5) * kHeightBin_m});
    bin = best - kApartBins + 1;
  }
}

}  // namespace roomwise::segment
