#include "logs/tools/csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstdlib>
#include <sstream>

#include "logs/tools/csv_columns.h"
#include "tests/rwlog/made_log.h"
#include "tests/rwlog/written_files.h"
#include "tests/support/scratch_folder.h"

namespace roomwise {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class Csv : public testing::Test {
 protected:
  std::vector<std::string> lines(const std::vector<LogEvent>& events, const std::string& channel,
                                 const std::string& list = "") {
    write_log(log_, events);
    std::ostringstream out;
    write_csv({log_, channel, list}, out);
    std::istringstream in(out.str());
    std::vector<std::string> all;
    for (std::string line; std::getline(in, line);) all.push_back(line);
    return all;
  }
  ScratchFolder folder_;
  std::filesystem::path log_ = folder_.path() / "a.lcmlog";
};

truth_t truth_with_landmarks() {
  truth_t truth{};
  truth.utime = 5;
  truth.seq = 2;
  truth.true_x_m = 0.1;
  truth.T_world_camera_quat[0] = 1.0;
  truth.true_landmarks = {{7, 6, 3.0, 2.0}, {8, 6, 1.5, -5.0}};
  truth.landmark_count = 2;
  return truth;
}

TEST_F(Csv, HasAHeaderAndARowAMessage) {
  const auto all = lines({event_of(channels::kTruth, 5, truth_with_landmarks())}, "TRUTH");
  EXPECT_THAT(
      all,
      ElementsAre("utime,seq,true_x_m,true_y_m,true_heading_rad,has_camera_pose,"
                  "T_world_camera_translation_m[0],T_world_camera_translation_m[1],"
                  "T_world_camera_translation_m[2],T_world_camera_quat[0],T_world_camera_quat[1],"
                  "T_world_camera_quat[2],T_world_camera_quat[3],contacts,landmark_count,"
                  "true_landmarks.identity,true_landmarks.kind,true_landmarks.true_x_m,"
                  "true_landmarks.true_y_m",
                  "5,2,0.1,0,0,0,0,0,0,1,0,0,0,0,2,7;8,6;6,3;1.5,2;-5"));
}

TEST_F(Csv, AListGetsARowAnElement) {
  const auto all =
      lines({event_of(channels::kTruth, 5, truth_with_landmarks())}, "TRUTH", "true_landmarks");
  EXPECT_THAT(all, ElementsAre("utime,seq,index,identity,kind,true_x_m,true_y_m", "5,2,0,7,6,3,2",
                               "5,2,1,8,6,1.5,-5"));
}

TEST_F(Csv, ListsOfOneCountStandSideBySide) {
  landmark_list_t list{};
  list.edge_u_px = {3, 4};
  list.edge_v_px = {30, 40};
  list.edge_listed = 2;
  const auto all = lines({event_of(channels::kLandmarks, 5, list)}, "LANDMARKS", "edge_v_px");
  EXPECT_THAT(all, ElementsAre("utime,seq,index,edge_u_px,edge_v_px", "0,0,0,3,30", "0,0,1,4,40"));
}

TEST_F(Csv, BlobsAreTheirSizeAndTextIsQuoted) {
  kinect_frame_t frame{};
  frame.depth_data.resize(17);
  frame.depth_size = 17;
  const auto frames = lines({event_of(channels::kKinectFrame, 5, frame)}, "KINECT_FRAME");
  EXPECT_THAT(frames[1], HasSubstr(",17,17,"));
  params_t params{};
  params.toml = "a = \"x\",\nb = 1";
  const auto texts = lines({event_of(channels::kParams, 5, params)}, "PARAMS");
  EXPECT_EQ(texts[1] + "\n" + texts[2], "0,0,,\"a = \"\"x\"\",\nb = 1\"");
}

RC_GTEST_PROP(CsvCells, NumbersReadBackExactly, (double x_m, std::int64_t utime)) {
  RC_PRE(std::isfinite(x_m));
  pose_t pose{};
  pose.utime = utime;
  pose.x_m = x_m;
  const auto header = csv_header<pose_t>();
  const auto row = csv_row(pose);
  RC_ASSERT(header.size() == row.size());
  RC_ASSERT(std::stoll(row[0]) == utime);
  RC_ASSERT(header[2] == "x_m");
  RC_ASSERT(std::strtod(row[2].c_str(), nullptr) == x_m);
}

TEST_F(Csv, UnknownNamesAreErrors) {
  EXPECT_EQ(complaint_of([&] { lines({}, "NOPE"); }), "unknown channel 'NOPE'");
  EXPECT_EQ(complaint_of([&] { lines({}, "TRUTH", "nope"); }), "TRUTH has no list 'nope'");
}

TEST_F(Csv, UndecodableMessagesAreToldAfterTheRest) {
  auto events = made_drive();
  events[0].data.pop_back();
  std::ostringstream out;
  write_log(log_, events);
  const std::string complaint = complaint_of([&] { write_csv({log_, "TRUTH", ""}, out); });
  EXPECT_THAT(complaint, HasSubstr("a.lcmlog: 1 undecodable messages on TRUTH"));
  EXPECT_EQ(std::ranges::count(out.str(), '\n'), 1 + 50);
}

}  // namespace
}  // namespace roomwise
