// MRPT's range-bearing EKF-SLAM in the place of ekf_svc: ODOMETRY and LANDMARKS in, POSE and
// LANDMARK_MAP out, so that `rwlog score` judges both by the same log.
//
//   mrpt_slam --replay IN --record OUT [--range_sigma_m S] [--bearing_sigma_rad S] ...
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/slam/CRangeBearingKFSLAM2D.h>

#include "common/channels.h"
#include "common/service_main.h"
#include "services/ekf_svc/core/motion.h"

namespace roomwise {
namespace {

/// What MRPT asks for; it knows one noise for all sightings and trusts no message's covariance.
struct MrptParams {
  double range_sigma_m = 0.1;
  double bearing_sigma_rad = 0.03;
  std::string association = "nearest";  ///< of landmarks without identity
  double gate_probability_ratio = 0.99;

  template <class Field>
  void visit_fields(Field&& field) {
    field("range_sigma_m", range_sigma_m, 1e-3, 10.0);
    field("bearing_sigma_rad", bearing_sigma_rad, 1e-4, 1.0);
    field("association", association, {"nearest", "joint"});
    field("gate_probability_ratio", gate_probability_ratio, 0.5, 0.999999);
  }
};

mrpt::obs::CSensoryFrame::Ptr to_frame(const landmark_list_t& message) {
  auto observation = mrpt::obs::CObservationBearingRange::Create();
  observation->fieldOfView_yaw = 6.28F;
  observation->maxSensorDistance = 20.0F;
  for (const landmark_observation_t& seen : message.landmarks) {
    if (seen.moving != 0) continue;
    auto& measured = observation->sensedData.emplace_back();
    measured.landmarkID = seen.identity;
    measured.range = static_cast<float>(seen.range_m);
    measured.yaw = static_cast<float>(seen.bearing_rad);
    measured.pitch = 0.0F;
  }
  auto frame = mrpt::obs::CSensoryFrame::Create();
  frame->insert(observation);
  return frame;
}

mrpt::obs::CActionCollection::Ptr to_action(const ekf::MotionIncrement& motion) {
  mrpt::obs::CActionRobotMovement2D action;
  action.computeFromOdometry({motion.translation_m.x(), motion.translation_m.y(), motion.turn_rad},
                             {});
  mrpt::math::CMatrixDouble33 covariance;  // of (x, y, turn), where ours is of (turn, x, y)
  constexpr Eigen::Index kOurs[] = {1, 2, 0};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) covariance(i, j) = motion.covariance(kOurs[i], kOurs[j]);
  }
  action.poseChange->copyFrom(mrpt::poses::CPosePDFGaussian(
      {motion.translation_m.x(), motion.translation_m.y(), motion.turn_rad}, covariance));
  auto actions = mrpt::obs::CActionCollection::Create();
  actions->insert(action);
  return actions;
}

class MrptSlam {
 public:
  using Params = MrptParams;

  MrptSlam(Bus& bus, const Params& params) : bus_(bus) {
    slam_.KF_options.method = mrpt::bayes::kfEKFNaive;
    slam_.options.std_sensor_range = static_cast<float>(params.range_sigma_m);
    slam_.options.std_sensor_yaw = static_cast<float>(params.bearing_sigma_rad);
    slam_.options.data_assoc_IC_chi2_thres = params.gate_probability_ratio;
    slam_.options.data_assoc_method =
        params.association == "joint" ? mrpt::slam::assocJCBB : mrpt::slam::assocNN;
    bus_.subscribe(channels::kOdometry, [this](const odometry_t& m) { add(m); });
    bus_.subscribe(channels::kLandmarks, [this](const landmark_list_t& m) {
      if (m.count > 0) use(m);
    });
  }

 private:
  void add(const odometry_t& message) {
    Eigen::Matrix2d covariance;
    covariance << message.covariance_distance_distance_m2, message.covariance_distance_turn_m_rad,
        message.covariance_distance_turn_m_rad, message.covariance_turn_turn_rad2;
    motion_.append(
        ekf::arc_step(message.distance_increment_m, message.turn_increment_rad, covariance));
  }

  void use(const landmark_list_t& message) {
    auto frame = to_frame(message);
    auto action = to_action(motion_);
    motion_ = {};
    for (const landmark_observation_t& seen : message.landmarks) {
      has_identities_ = has_identities_ || seen.identity >= 0;
    }
    slam_.processActionObservation(action, frame);
    publish(message.utime);
  }

  void publish(std::int64_t utime) {
    mrpt::poses::CPosePDFGaussian robot;
    std::vector<mrpt::math::TPoint2D> places;
    std::map<unsigned int, mrpt::maps::CLandmark::TLandmarkID> identities;
    mrpt::math::CVectorDouble state;
    mrpt::math::CMatrixDouble covariance;
    slam_.getCurrentState(robot, places, identities, state, covariance);
    pose_t pose{};
    pose.utime = utime;
    pose.x_m = robot.mean.x();
    pose.y_m = robot.mean.y();
    pose.heading_rad = robot.mean.phi();
    pose.state = pose_t::STATE_TRACKING;
    bus_.publish(channels::kPose, pose);
    landmark_map_t map{};
    map.utime = utime;
    for (std::size_t i = 0; i < places.size(); ++i) {
      map_landmark_t& landmark = map.map_landmarks.emplace_back();
      const auto identity = identities.find(static_cast<unsigned>(i));
      const bool is_known = has_identities_ && identity != identities.end();
      landmark.map_id = static_cast<std::int64_t>(i);
      landmark.identity = is_known ? static_cast<int>(identity->second) : -1;
      landmark.map_x_m = places[i].x;
      landmark.map_y_m = places[i].y;
    }
    map.map_count = static_cast<std::int32_t>(places.size());
    bus_.publish(channels::kLandmarkMap, map);
  }

  Bus& bus_;
  mrpt::slam::CRangeBearingKFSLAM2D slam_;
  ekf::MotionIncrement motion_;
  bool has_identities_ = false;  ///< or else those it hands out are its own
};

}  // namespace
}  // namespace roomwise

int main(int argc, char** argv) {
  return roomwise::service_main<roomwise::MrptSlam>("mrpt_slam", argc, argv);
}
