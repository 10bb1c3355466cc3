#include "services/landmark_svc/landmark_messages.h"

#include <algorithm>
#include <string>

namespace roomwise {
namespace {

using landmark::EdgePixel;
using landmark::LandmarkDetector;
using landmark::LandmarkParams;
using landmark::RejectReason;

void list_edges(const LandmarkDetector& detector, landmark_list_t& message) {
  const auto& edges = detector.edges();
  const auto most = static_cast<std::size_t>(detector.params().edge_pixels_listed_max);
  const std::size_t listed = std::min(edges.size(), most);
  message.edge_count = static_cast<std::int32_t>(edges.size());
  message.edge_listed = static_cast<std::int32_t>(listed);
  message.edge_u_px.resize(listed);
  message.edge_v_px.resize(listed);
  for (std::size_t i = 0; i < listed; ++i) {
    const EdgePixel& edge = edges[i * edges.size() / listed];
    message.edge_u_px[i] = edge.u_px;
    message.edge_v_px[i] = edge.v_px;
  }
}

void list_scan(const LandmarkDetector& detector, landmark_list_t& message) {
  const auto& points = detector.scan().points();
  message.scan_count = static_cast<std::int32_t>(points.size());
  message.scan_x_m.resize(points.size());
  message.scan_y_m.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    message.scan_x_m[i] = static_cast<float>(points[i].p_robot_m.x());
    message.scan_y_m[i] = static_cast<float>(points[i].p_robot_m.y());
  }
}

void list_rejections(const LandmarkDetector& detector, landmark_list_t& message) {
  message.rejection_count = static_cast<std::int32_t>(landmark::kRejectReasons);
  message.rejections.resize(landmark::kRejectReasons);
  for (std::size_t i = 0; i < landmark::kRejectReasons; ++i) {
    const auto reason = static_cast<RejectReason>(i);
    message.rejections[i].name = std::string(name_of(reason));
    message.rejections[i].count = detector.rejected().of(reason);
  }
}

void state_what_was_in_force(const LandmarkDetector& detector, landmark_list_t& message) {
  const LandmarkParams& params = detector.params();
  const bool is_thesis = params.is_thesis();
  message.alpha_ratio = detector.alpha_ratio();
  message.beta_ratio = 1.0 - detector.alpha_ratio();
  message.threshold_mm_per_px = is_thesis ? params.slope.threshold_mm_per_px : 0.0;
  message.threshold_quanta = is_thesis ? 0.0 : params.jump.jump_quanta;
  message.range_min_m = detector.range_min_m();
  message.range_max_m = detector.range_max_m();
}

}  // namespace

landmark_observation_t to_message(const landmark::Landmark& landmark) {
  landmark_observation_t message{};
  message.identity = -1;
  message.kind = static_cast<std::int8_t>(landmark.kind);
  message.moving = landmark.is_moving ? 1 : 0;
  message.range_m = landmark.range_m;
  message.bearing_rad = landmark.bearing_rad;
  message.covariance_range_range_m2 = landmark.covariance(0, 0);
  message.covariance_range_bearing_m_rad = landmark.covariance(0, 1);
  message.covariance_bearing_bearing_rad2 = landmark.covariance(1, 1);
  message.height_low_m = landmark.height_low_m;
  message.height_high_m = landmark.height_high_m;
  message.step_m = landmark.step_m;
  message.chroma_red_log = landmark.chroma.red_log;
  message.chroma_blue_log = landmark.chroma.blue_log;
  message.chroma_variance_log2 = landmark.chroma.variance_log2;
  message.score_ratio = landmark.score_ratio;
  message.rows = landmark.rows;
  message.pixel_u_px = landmark.u_px;
  message.pixel_v_top_px = landmark.v_top_px;
  message.pixel_v_bottom_px = landmark.v_bottom_px;
  return message;
}

void fill_message(const LandmarkDetector& detector, const RgbdFrame& frame,
                  landmark_list_t& message) {
  message.utime = frame.utime;
  message.frame_seq = frame.seq;
  message.width_px = frame.depth.width_px;
  message.height_px = frame.depth.height_px;
  message.landmarks.clear();
  for (const landmark::Landmark& landmark : detector.landmarks()) {
    message.landmarks.push_back(to_message(landmark));
  }
  message.count = static_cast<std::int32_t>(message.landmarks.size());
  list_edges(detector, message);
  list_scan(detector, message);
  list_rejections(detector, message);
  state_what_was_in_force(detector, message);
}

}  // namespace roomwise
