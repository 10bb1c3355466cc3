#pragma once
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "common/bus/bus.h"
#include "services/ekf_svc/core/ekf_params.h"
#include "services/ekf_svc/core/estimator.h"
#include "services/ekf_svc/ekf_messages.h"
#include "services/ekf_svc/map_file.h"

namespace roomwise {

/// ODOMETRY and LANDMARKS in; POSE at the rate of odometry and LANDMARK_MAP out, the latter once a
/// second of odometry time and whenever the number of landmarks changes.
///
/// A frame waits until odometry has passed the instant it was taken, and frames are used in order
/// of that instant. What is published depends on the messages and their order alone.
class EkfService {
 public:
  using Params = ekf::EkfParams;
  /// Goes on with the map kept in params.map_path, lost until relocalised. Throws
  /// std::runtime_error in mode "localise" without a map.
  EkfService(Bus& bus, const Params& params);
  EkfService(const EkfService&) = delete;
  EkfService& operator=(const EkfService&) = delete;
  /// Keeps the map.
  ~EkfService();

 private:
  struct WaitingFrame {
    Time time{};
    std::vector<ekf::Sighting> sightings;
    ScanBeams beams;
  };

  void on_odometry(const odometry_t& message);
  void on_landmarks(const landmark_list_t& message);
  void use_waiting_frames();
  void use(const WaitingFrame& frame);
  void publish_map_if_due();
  void load_map();
  void keep_map_if_due();
  void keep_map();

  Bus& bus_;
  Params params_;
  std::optional<MapFile> map_file_;
  ekf::MapSnapshot kept_;                // as last written
  std::int64_t keep_period_number_ = 0;  // of odometry time, when the map was last written
  ekf::Estimator estimator_;
  std::deque<WaitingFrame> waiting_;  // in order of time
  std::vector<ekf::Verdict> verdicts_;
  ekf::FrameResult last_frame_;
  std::int64_t map_second_ = 0;  // of odometry time, when the map was last sent
  std::size_t map_count_ = 0;    // landmarks in it
};

}  // namespace roomwise
