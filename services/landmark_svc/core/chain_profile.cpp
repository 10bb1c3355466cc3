#include "services/landmark_svc/core/chain_profile.h"

#include <algorithm>
#include <cmath>

namespace roomwise::landmark {
namespace {

constexpr double kStep_m = 0.08;  // a larger one between neighbours ends the surface

/// Whole pixels, 0 to `most`, of what a hostile camera may have made anything.
int pixels_of(double pixels, int most) {
  if (!(pixels < most)) return most;
  return pixels > 0.0 ? static_cast<int>(pixels) : 0;
}

}  // namespace

void ChainProfile::gather(const DepthImage& depth, const PinholeCamera& camera,
                          const DisparityTable& table, std::span<const EdgePixel> chain,
                          double along_ratio, double arc_m) {
  std::array<double, kMost> sum{};  // of disparity beyond the reference pixel's
  std::array<double, kMost> rows{};
  constexpr int kReference_px = 1;  // the near pixel itself is often a mixture
  double reference = 0.0;
  double column = 0.0;
  double used = 0.0;
  const double z_near_m = table.depth_m(chain.front().near_steps);
  const int most = pixels_of(2.0 + arc_m * camera.fx_px / z_near_m, kMost);
  // A few dozen rows average as well as hundreds.
  const std::size_t stride = std::max<std::size_t>(1, chain.size() / 48);
  for (std::size_t i = 0; i < chain.size(); i += stride) {
    const EdgePixel& pixel = chain[i];
    const int inward = pixel.inward_px();
    double first = 0.0;
    double before_m = table.depth_m(pixel.near_steps);
    for (int k = kReference_px; k < most; ++k) {
      const int u = pixel.u_px + k * inward;
      if (u < 0 || u >= depth.width_px) break;
      const std::uint16_t step = depth.at(u, pixel.v_px);
      const double z_m = table.depth_m(step);
      if (!table.is_good(step) || std::abs(z_m - before_m) > kStep_m) break;
      before_m = z_m;
      if (k == kReference_px) {
        first = table.parts(step);
        reference += first;
        column += pixel.u_px - 0.5 * inward;
        used += 1.0;
      }
      sum[static_cast<std::size_t>(k)] += table.parts(step) - first;
      rows[static_cast<std::size_t>(k)] += 1.0;
    }
  }
  count_ = 0;
  if (used < 3.0) return;
  const int inward = chain.front().inward_px();
  const double edge_u = column / used;
  inward_left_ = inward < 0;
  edge_ray_ = {along_ratio, -(edge_u - camera.cx_px) / camera.fx_px};
  double arc_so_far_m = 0.0;
  for (std::size_t k = kReference_px; k < kMost && rows[k] >= 0.6 * used; ++k) {
    const double quanta = (reference / used + sum[k] / rows[k]) / DisparityTable::kPartsPerQuantum;
    if (!(quanta > 0.5)) break;
    const double z_m = table.depth_from_quanta_m(quanta);
    const double u = edge_u + (static_cast<double>(k) + 0.5) * inward;
    const Eigen::Vector2d p_m(z_m * along_ratio, -z_m * (u - camera.cx_px) / camera.fx_px);
    if (count_ > 0) arc_so_far_m += (p_m - points_m_[count_ - 1]).norm();
    if (arc_so_far_m > arc_m) break;
    points_m_[count_++] = p_m;
  }
}

ProfileShape ChainProfile::shape(const DisparityTable& table, const RoundParams& params,
                                 TangentCircle& circle) const {
  const auto points = points_m();
  if (points.empty()) return ProfileShape::kFlat;
  const double line_m = line_rms_m(points);
  const double quantum_m = table.quantum_m(points.front().x());
  if (line_m < params.bend_quanta * quantum_m) return ProfileShape::kFlat;
  const auto fitted = fit_tangent_circle(points, edge_ray_, inward_left_);
  if (!fitted || fitted->rms_m > params.better_ratio * line_m ||
      fitted->radius_m < params.pole_radius_min_m || fitted->radius_m > params.limb_radius_max_m) {
    return ProfileShape::kFlat;
  }
  circle = *fitted;
  return fitted->radius_m <= params.pole_radius_max_m ? ProfileShape::kPole : ProfileShape::kLimb;
}

}  // namespace roomwise::landmark
