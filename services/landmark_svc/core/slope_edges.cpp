#include "services/landmark_svc/core/slope_edges.h"

#include <cmath>
#include <cstdlib>

namespace roomwise::landmark {
namespace {

constexpr double kSqrt6 = 2.449489742783178;

/// A good pixel of the row being scanned.
struct Reading {
  int u_px = -1;
  std::uint16_t step = 0;
};

class RowScan {
 public:
  RowScan(int v_px, const DisparityTable& table, const ColorAtDepth& color,
          const SlopeEdgeParams& params, double alpha_ratio, double color_sigma_levels)
      : v_px_(v_px),
        table_(table),
        color_(color),
        params_(params),
        alpha_ratio_(alpha_ratio),
        color_sigma_levels_(color_sigma_levels) {}

  /// Judges `middle` between its two neighbours and appends it if it is an edge.
  void judge(const Reading& left, const Reading& middle, const Reading& right,
             std::vector<EdgePixel>& edges, RejectCounts& rejected) const {
    if (middle.step >= left.step && middle.step >= right.step) return;
    const bool right_is_farther = right.step > left.step;
    const Reading& far = right_is_farther ? right : left;
    if (weight_sigmas(left, middle, right, far) <= 0.0) return;
    const double z_m = table_.depth_m(middle.step);
    if (z_m < params_.range_min_m || z_m > params_.range_max_m) {
      rejected.add(RejectReason::kEdgeOutOfRange);
      return;
    }
    edges.push_back({.u_px = static_cast<std::int16_t>(middle.u_px),
                     .v_px = static_cast<std::int16_t>(v_px_),
                     .near_steps = middle.step,
                     .far_steps = far.step,
                     .gap_px = static_cast<std::uint16_t>(std::abs(far.u_px - middle.u_px)),
                     .near_run_px = 1,
                     .side = right_is_farther ? EdgeSide::kRight : EdgeSide::kLeft});
  }

 private:
  /// By how much the pixel's weight exceeds the threshold, in sigmas.
  double weight_sigmas(const Reading& left, const Reading& middle, const Reading& right,
                       const Reading& far) const {
    const double slope_excess =
        slope_difference_mm_px(left, middle, right) - params_.threshold_mm_per_px;
    if (alpha_ratio_ == 0.0) return slope_excess;
    const double z_m = table_.depth_m(middle.step);
    const double slope_sigma_mm_px = kSqrt6 * 0.5 * 1000.0 * table_.quantum_m(z_m);
    const double distance = color_.distance_levels(middle.u_px, v_px_, far.u_px, v_px_);
    // alpha C / sigma_C + (1 - alpha) D / sigma_D - threshold / sigma_D
    return alpha_ratio_ * distance / color_sigma_levels_ +
           (slope_excess - alpha_ratio_ * (slope_excess + params_.threshold_mm_per_px)) /
               slope_sigma_mm_px;
  }

  double slope_difference_mm_px(const Reading& left, const Reading& middle,
                                const Reading& right) const {
    const double right_slope =
        static_cast<double>(right.step - middle.step) / (right.u_px - middle.u_px);
    const double left_slope =
        static_cast<double>(middle.step - left.step) / (middle.u_px - left.u_px);
    return std::abs(right_slope - left_slope) * 1000.0 * table_.depth_m(1);
  }

  int v_px_;
  const DisparityTable& table_;
  const ColorAtDepth& color_;
  const SlopeEdgeParams& params_;
  double alpha_ratio_;
  double color_sigma_levels_;
};

}  // namespace

void SlopeEdgeFinder::find(const DepthImage& depth, const DisparityTable& table,
                           const ColorAtDepth& color, const PixelRectangle& region,
                           const SlopeEdgeParams& params, const ColorWeightParams& color_params,
                           double alpha_ratio, std::vector<EdgePixel>& edges,
                           RejectCounts& rejected) const {
  const double alpha = color.available() ? alpha_ratio : 0.0;
  const double color_sigma_levels = kSqrt6 * color_params.noise_levels;
  for (int v = region.v_begin_px; v < region.v_end_px; ++v) {
    const RowScan scan(v, table, color, params, alpha, color_sigma_levels);
    Reading left;
    Reading middle;
    for (int u = region.u_begin_px; u < region.u_end_px; ++u) {
      const std::uint16_t step = depth.at(u, v);
      if (!table.is_good(step)) continue;
      const Reading right{u, step};
      if (left.u_px >= 0) scan.judge(left, middle, right, edges, rejected);
      left = middle;
      middle = right;
    }
  }
}

}  // namespace roomwise::landmark
