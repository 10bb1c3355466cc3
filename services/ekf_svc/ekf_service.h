#pragma once
#include <cstdint>
#include <deque>
#include <vector>

#include "common/bus/bus.h"
#include "services/ekf_svc/core/ekf_params.h"
#include "services/ekf_svc/core/estimator.h"

namespace roomwise {

/// ODOMETRY and LANDMARKS in; POSE at the rate of odometry and LANDMARK_MAP out, the latter once a
/// second of odometry time and whenever the number of landmarks changes.
///
/// A frame waits until odometry has passed the instant it was taken, and frames are used in order
/// of that instant. What is published depends on the messages and their order alone.
class EkfService {
 public:
  using Params = ekf::EkfParams;
  EkfService(Bus& bus, const Params& params);

 private:
  struct WaitingFrame {
    Time time{};
    std::vector<ekf::Sighting> sightings;
  };

  void on_odometry(const odometry_t& message);
  void on_landmarks(const landmark_list_t& message);
  void use_waiting_frames();
  void use(const WaitingFrame& frame);
  void publish_map_if_due();

  Bus& bus_;
  ekf::Estimator estimator_;
  std::deque<WaitingFrame> waiting_;  // in order of time
  std::vector<ekf::Verdict> verdicts_;
  ekf::FrameResult last_frame_;
  std::int64_t map_second_ = 0;  // of odometry time, when the map was last sent
  std::size_t map_count_ = 0;    // landmarks in it
};

}  // namespace roomwise
