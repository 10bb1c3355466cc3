// The program itself, as a person runs it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "logs/tools/trajectory_file.h"
#include "tests/rwlog/images.h"
#include "tests/rwlog/made_log.h"
#include "tests/rwlog/written_files.h"
#include "tests/support/build_paths.h"
#include "tests/support/child_process.h"
#include "tests/support/scratch_folder.h"

namespace roomwise {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

class Rwlog : public testing::Test {
 protected:
  Rwlog() { write_log(log_, made_drive()); }

  /// Runs rwlog; its output and status are kept.
  int run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), program("rwlog"));
    return run_to_end(arguments, output_);
  }
  std::string path(const char* name) const { return (folder_.path() / name).string(); }

  ScratchFolder folder_;
  std::string log_ = path("drive.lcmlog");
  std::string output_;
};

TEST_F(Rwlog, WithoutASubcommandSaysWhatIsNeeded) {
  EXPECT_NE(run({}), 0);
  EXPECT_THAT(output_, HasSubstr("subcommand is required"));
  EXPECT_NE(run({"import"}), 0);
  EXPECT_EQ(run({"--help"}), 0);
}

TEST_F(Rwlog, InfoOfADamagedLogPrintsWhatWasWholeAndFails) {
  EXPECT_EQ(run({"info", log_}), 0);
  std::filesystem::resize_file(log_, std::filesystem::file_size(log_) - 5);
  EXPECT_EQ(run({"info", log_}), 1);
  EXPECT_THAT(output_, ContainsRegex("POSE +pose_t +51"));
  EXPECT_THAT(output_, ContainsRegex("rwlog: .*drive.lcmlog: damaged at byte [0-9]+"));
}

TEST_F(Rwlog, ProgressIsSilentInAPipe) {
  EXPECT_EQ(run({"info", log_}), 0);
  EXPECT_THAT(output_, Not(HasSubstr("%")));
  EXPECT_THAT(output_, Not(HasSubstr("\r")));
}

TEST_F(Rwlog, ScoresTrajectoryAndMap) {
  EXPECT_EQ(run({"score", log_}), 0);
  EXPECT_THAT(output_, HasSubstr("ate_raw_m 0\nate_aligned_m 0\nheading_rmse_rad 0\nposes 51\n"));
  EXPECT_THAT(output_, ContainsRegex("odometry_ate_raw_m 1\\.[0-9]+\n"));
  EXPECT_THAT(output_, HasSubstr("map_raw_m 0\nmap_aligned_m 0\nmap_matched 2\nlandmarks 2\n"));
  EXPECT_EQ(run({"score", log_, "--json"}), 0);
  EXPECT_THAT(output_, testing::StartsWith("{\"ate_raw_m\": 0, \"ate_aligned_m\": 0, "));
}

TEST_F(Rwlog, SaysWhenNothingCanBeScored) {
  write_log(log_, {});
  EXPECT_EQ(run({"score", log_}), 1);
  EXPECT_THAT(output_, HasSubstr("nothing to score: needs POSE or ODOMETRY with TRUTH"));
}

TEST_F(Rwlog, RefusedNumbersAreCountedNotScored) {
  auto events = made_drive();
  pose_t broken{};
  broken.utime = kMade_utime;
  broken.x_m = std::nan("");
  events.push_back(event_of(channels::kPose, kMade_utime, broken));
  write_log(log_, events);
  EXPECT_EQ(run({"score", log_}), 1);
  EXPECT_THAT(output_, HasSubstr("ate_raw_m 0\n"));
  EXPECT_THAT(output_, HasSubstr("1 times pose_not_usable"));
}

TEST_F(Rwlog, ExportedTrajectoryReadsBack) {
  EXPECT_EQ(run({"export", "trajectory", log_, "-o", path("t.txt"), "--channel", "TRUTH"}), 0);
  const Trajectory truth = read_tum_trajectory(path("t.txt"));
  ASSERT_EQ(truth.size(), 51U);
  EXPECT_EQ(truth[50].utime, kMade_utime + 5'000'000);
  EXPECT_NEAR(truth[50].pose.x_m, 1.0 - std::sin(5.0), 1e-9);
  EXPECT_NEAR(truth[50].pose.heading_rad, std::numbers::pi / 2, 1e-8);
  EXPECT_EQ(run({"export", "trajectory", log_, "-o", path("t.txt"), "--channel", "HEALTH"}), 105);
}

TEST_F(Rwlog, MapPictureShowsWhatIsThere) {
  EXPECT_EQ(run({"export", "map-png", log_, "-o", path("map.png")}), 0);
  const cv::Mat map = cv::imread(path("map.png"));
  ASSERT_EQ(map.size(), cv::Size(1400, 1000));
  write_log(log_, {});
  EXPECT_EQ(run({"export", "map-png", log_, "-o", path("none.png")}), 1);
  EXPECT_FALSE(std::filesystem::exists(path("none.png")));
}

/// A 7-Scenes folder of one frame, imported, with what services would answer.
class RwlogFrames : public Rwlog {
 protected:
  RwlogFrames() {
    write_image(path("seq/frame-000000.color.png"), made_color());
    write_image(path("seq/frame-000000.depth.png"), made_depth());
    cv::Mat1b mask(kMadeHeight_px, kMadeWidth_px, std::uint8_t{0});
    mask.rowRange(120, 240) = 255;
    write_image(path("seq/frame-000000.floor.png"), mask);
    EXPECT_EQ(run({"import", "7scenes", path("seq"), "-o", log_}), 0) << output_;
  }

  void add_answers(landmark_list_t landmarks, segmentation_t segments) {
    LogReader reader(log_);
    LogEvent event;
    std::vector<LogEvent> events;
    while (reader.next(event)) events.push_back(event);
    events.push_back(event_of(channels::kLandmarks, kMade_utime, landmarks));
    events.push_back(event_of(channels::kSegments, kMade_utime, segments));
    write_log(log_, events);
  }

  static landmark_list_t landmarks() {
    landmark_list_t list{};
    list.frame_seq = 1;
    list.width_px = kMadeWidth_px;
    list.height_px = kMadeHeight_px;
    list.landmarks.resize(1);
    list.landmarks[0].kind = landmark_observation_t::KIND_EDGE_LEFT;
    list.landmarks[0].pixel_u_px = 100;
    list.landmarks[0].pixel_v_top_px = 50;
    list.landmarks[0].pixel_v_bottom_px = 200;
    list.count = 1;
    list.edge_u_px = {10};
    list.edge_v_px = {20};
    list.edge_listed = 1;
    return list;
  }

  /// The lower 100 rows are called floor; the mask says 120.
  static segmentation_t segments() {
    segmentation_t message{};
    message.frame_seq = 1;
    message.label_width_px = kMadeWidth_px;
    message.label_height_px = kMadeHeight_px;
    message.label_data.assign(std::size_t{320} * 140, 0);
    message.label_data.resize(std::size_t{320} * 240, 200);
    message.label_size = 320 * 240;
    message.free_range_m = {1.0, 2.5};
    message.unknown_ratio = {0.0, 0.1};
    message.obstacle_range_m = {1.1, 0.0};
    message.bin_count = 2;
    message.bin_step_rad = 0.3;
    return message;
  }
};

TEST_F(RwlogFrames, FloorIsScoredAgainstTheMasks) {
  add_answers(landmarks(), segments());
  EXPECT_EQ(run({"score", log_, "--floor-masks", path("seq")}), 0) << output_;
  EXPECT_THAT(output_, HasSubstr("landmarks_per_frame 1\n"));
  EXPECT_THAT(output_, HasSubstr("floor_iou 0.833333\nfloor_precision 1\nfloor_recall 0.833333\n"
                                 "nonfloor_called_floor 0\nfloor_iou_mean 0.833333\n"
                                 "floor_frames 1\n"));
  EXPECT_EQ(run({"score", log_, "--floor-masks", folder_.path()}), 1);
  EXPECT_THAT(output_, HasSubstr("holds no frame-N.floor.png"));
}

TEST_F(RwlogFrames, PicturesAreDrawnOfTheFrameAskedFor) {
  add_answers(landmarks(), segments());
  for (const char* what : {"landmarks-png", "labels-png"}) {
    EXPECT_EQ(run({"export", what, log_, "-o", path("p.png")}), 0) << output_;
    const cv::Mat3b picture = cv::imread(path("p.png"));
    EXPECT_GT(picture.cols, 1280) << what;
    EXPECT_EQ(run({"export", what, log_, "-o", path("q.png"), "--frame", "0"}), 0);
    EXPECT_EQ(read_text(path("p.png")), read_text(path("q.png")));
    EXPECT_EQ(run({"export", what, log_, "-o", path("r.png"), "--frame", "5"}), 1);
    EXPECT_THAT(output_, HasSubstr("frame 5 is not answered"));
  }
}

TEST_F(RwlogFrames, HostileAnswersMakeNoCrash) {
  landmark_list_t far = landmarks();
  far.width_px = -7;
  far.edge_u_px = {-32768};
  far.landmarks.resize(3, far.landmarks[0]);
  far.count = 3;
  far.landmarks[0].kind = 120;
  far.landmarks[0].pixel_u_px = std::nan("");
  far.landmarks[1].pixel_v_bottom_px = 1e300;
  far.landmarks[2].range_m = -std::numeric_limits<double>::infinity();
  segmentation_t odd = segments();
  odd.free_range_m = {std::nan(""), 1e300};
  odd.bin_step_rad = 1e300;
  odd.camera_pitch_rad = std::nan("");
  add_answers(far, odd);
  EXPECT_EQ(run({"export", "landmarks-png", log_, "-o", path("p.png")}), 0) << output_;
  EXPECT_EQ(run({"export", "labels-png", log_, "-o", path("p.png")}), 0) << output_;
  odd.label_data.resize(10);
  odd.label_size = 10;
  add_answers(far, odd);
  EXPECT_EQ(run({"score", log_, "--floor-masks", path("seq")}), 1);
  EXPECT_THAT(output_, HasSubstr("1 times labels_not_decodable"));
}

TEST_F(Rwlog, TumTakesIntrinsicsAndDepthScale) {
  write_text(path("tum/rgb.txt"), "10 rgb.png\n");
  write_text(path("tum/depth.txt"), "10 depth.png\n");
  write_image(path("tum/rgb.png"), made_color());
  write_image(path("tum/depth.png"), made_depth());
  EXPECT_EQ(run({"import", "tum", path("tum"), "-o", log_, "--intrinsics", "300,301,160,120",
                 "--depth-scale", "4000"}),
            0)
      << output_;
  EXPECT_EQ(run({"csv", log_, "KINECT_FRAME"}), 0);
  EXPECT_THAT(output_, HasSubstr(",0.00025,300,301,160,120,"));
  EXPECT_NE(run({"import", "tum", path("tum"), "-o", log_, "--intrinsics", "300,301"}), 0);
  EXPECT_NE(run({"import", "tum", path("tum"), "-o", log_, "--depth-scale", "0"}), 0);
}

}  // namespace
}  // namespace roomwise
