// How true the edge pixels of each method are, on one drive recorded twice: as a Kinect sees it,
// and without its failings. scripts/experiments landmark_thresholds makes both and reads the lines:
//   METHOD THRESHOLD EDGES_PER_FRAME PRECISION RECALL
//
// usage: landmark_edges SEEN.lcmlog TRUE.lcmlog
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "common/bus/log_file.h"
#include "common/channels.h"
#include "common/frames/frame_decoder.h"
#include "services/landmark_svc/core/landmark_detector.h"

namespace roomwise {
namespace {

using landmark::EdgePixel;
using landmark::LandmarkDetector;
using landmark::LandmarkParams;

constexpr int kSlack_px = 2;  // between an edge pixel and the jump it shows
constexpr int kBridged_px = 64;
constexpr double kFarthest_m = 3.81;  // what both methods look at
constexpr double kNearest_m = 1.22;

/// The frames of a log, one after the other.
class Frames {
 public:
  explicit Frames(const char* path) : log_(path), decoder_(ColorUse::kDecode) {}

  bool next(RgbdFrame& frame) {
    while (log_.next(event_)) {
      if (event_.channel != channels::kKinectFrame.name) continue;
      if (decode(event_.data, message_) != DecodeResult::kOk ||
          decoder_.decode(message_, frame) != FrameResult::kOk) {
        throw std::runtime_error("a frame cannot be decoded");
      }
      return true;
    }
    return false;
  }

 private:
  LogReader log_;
  LogEvent event_;
  kinect_frame_t message_;
  FrameDecoder decoder_;
};

/// Which pixels of an image are marked.
class Marks {
 public:
  void clear(const DepthImage& like) {
    width_px_ = like.width_px;
    height_px_ = like.height_px;
    marked_.assign(like.size(), 0);
  }
  void add(int u_px, int v_px) { marked_[index(u_px, v_px)] = 1; }
  bool at(int u_px, int v_px) const { return marked_[index(u_px, v_px)] != 0; }

  /// Whether there is one within kSlack_px, along rows and across.
  bool near(int u_px, int v_px) const {
    for (int v = std::max(0, v_px - kSlack_px); v <= std::min(height_px_ - 1, v_px + kSlack_px);
         ++v) {
      for (int u = std::max(0, u_px - kSlack_px); u <= std::min(width_px_ - 1, u_px + kSlack_px);
           ++u) {
        if (at(u, v)) return true;
      }
    }
    return false;
  }

 private:
  std::size_t index(int u_px, int v_px) const {
    return static_cast<std::size_t>(v_px) * static_cast<std::size_t>(width_px_) +
           static_cast<std::size_t>(u_px);
  }

  int width_px_ = 0;
  int height_px_ = 0;
  std::vector<char> marked_;
};

bool is_looked_at(double z_m) { return z_m >= kNearest_m && z_m <= kFarthest_m; }

/// The near sides of depth jumps: where depth to one neighbour, in the row or in the column, grows
/// by 6 cm and 4 quanta more than the slope on the other side tells.
class TrueJumps {
 public:
  void look(const DepthImage& depth, double quanta_m) {
    along_rows_.clear(depth);
    anywhere_.clear(depth);
    for (int v = 0; v < depth.height_px; ++v) {
      gather(depth.width_px, [&](int u) { return depth.at(u, v) * depth.unit_m; });
      mark(quanta_m, [&](int u) {
        along_rows_.add(u, v);
        anywhere_.add(u, v);
      });
    }
    for (int u = 0; u < depth.width_px; ++u) {
      gather(depth.height_px, [&](int v) { return depth.at(u, v) * depth.unit_m; });
      mark(quanta_m, [&](int v) { anywhere_.add(u, v); });
    }
  }
  /// What a method that goes along rows can find.
  const Marks& along_rows() const { return along_rows_; }
  const Marks& anywhere() const { return anywhere_; }

 private:
  struct Reading {
    int at_px;
    double z_m;
  };

  template <class Depth>
  void gather(int length_px, Depth depth_m) {
    readings_.clear();
    for (int i = 0; i < length_px; ++i) {
      if (depth_m(i) > 0.0) readings_.push_back({i, depth_m(i)});
    }
  }

  template <class Found>
  void mark(double quanta_m, Found found) const {
    for (std::size_t i = 1; i + 1 < readings_.size(); ++i) {
      if (is_jump(readings_[i - 1], readings_[i], readings_[i + 1], quanta_m)) {
        found(readings_[i].at_px);
      }
    }
  }

  static bool is_jump(const Reading& before, const Reading& here, const Reading& after,
                      double quanta_m) {
    if (!is_looked_at(here.z_m)) return false;
    const double least_m = std::max(0.06, 4.0 * here.z_m * here.z_m / quanta_m);
    const auto exceeds = [&](const Reading& far, const Reading& other) {
      const int gap_px = std::abs(far.at_px - here.at_px);
      if (far.z_m <= here.z_m || gap_px > kBridged_px) return false;
      const double slope = (here.z_m - other.z_m) / std::abs(here.at_px - other.at_px);
      const double foretold_m = std::clamp(slope * gap_px, 0.0, far.z_m - here.z_m);
      return far.z_m - here.z_m - foretold_m >= least_m;
    };
    return exceeds(after, before) || exceeds(before, after);
  }

  Marks along_rows_;
  Marks anywhere_;
  std::vector<Reading> readings_;
};

/// What one method found, against the truth.
struct Tally {
  explicit Tally(const LandmarkParams& of) : params(of), detector(of) {}

  LandmarkParams params;
  LandmarkDetector detector;
  Marks found_marks;
  double edges = 0.0;
  double right = 0.0;
  double true_jumps = 0.0;
  double found = 0.0;

  void judge(const RgbdFrame& frame, const TrueJumps& truth) {
    if (detector.detect(frame) != landmark::DetectResult::kOk) throw std::logic_error("refused");
    found_marks.clear(frame.depth);
    for (const EdgePixel& edge : detector.edges()) {
      if (!is_looked_at(edge.near_steps * frame.depth.unit_m)) continue;
      found_marks.add(edge.u_px, edge.v_px);
      edges += 1.0;
      right += truth.anywhere().near(edge.u_px, edge.v_px) ? 1.0 : 0.0;
    }
    for (int v = 0; v < frame.depth.height_px; ++v) {
      for (int u = 0; u < frame.depth.width_px; ++u) {
        if (!truth.along_rows().at(u, v)) continue;
        true_jumps += 1.0;
        found += found_marks.near(u, v) ? 1.0 : 0.0;
      }
    }
  }
};

LandmarkParams thesis(double threshold_mm_per_px) {
  LandmarkParams params;
  params.method = "thesis";
  params.slope.threshold_mm_per_px = threshold_mm_per_px;
  return params;
}

std::vector<Tally> methods() {
  std::vector<Tally> all;
  for (const double threshold : {0.0, 100.0, 1000.0}) all.emplace_back(thesis(threshold));
  all.emplace_back(LandmarkParams{});
  return all;
}

void compare(const char* seen_path, const char* true_path) {
  Frames seen_frames(seen_path);
  Frames true_frames(true_path);
  RgbdFrame seen;
  RgbdFrame truth;
  TrueJumps jumps;
  std::vector<Tally> tallies = methods();
  double frames = 0.0;
  while (seen_frames.next(seen) && true_frames.next(truth)) {
    if (seen.utime != truth.utime || seen.depth.width_px != truth.depth.width_px) {
      throw std::runtime_error("the two logs are not of one drive");
    }
    frames += 1.0;
    jumps.look(truth.depth, tallies.back().params.quanta_m());
    for (Tally& tally : tallies) tally.judge(seen, jumps);
  }
  for (const Tally& tally : tallies) {
    fmt::print("{} {} {:.1f} {:.4f} {:.4f}\n", tally.params.method,
               tally.params.is_thesis() ? tally.params.slope.threshold_mm_per_px
                                        : tally.params.jump.jump_quanta,
               tally.edges / frames, tally.right / tally.edges, tally.found / tally.true_jumps);
  }
}

}  // namespace
}  // namespace roomwise

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "usage: landmark_edges SEEN.lcmlog TRUE.lcmlog\n");
    return EXIT_FAILURE;
  }
  try {
    roomwise::compare(argv[1], argv[2]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "landmark_edges: {}\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
