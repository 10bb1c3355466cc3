#include "logs/tools/import_mrclam.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "tests/rwlog/log_messages.h"
#include "tests/rwlog/written_files.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/shared_data.h"

namespace roomwise {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A robot that drives 1 m ahead in 2 s, then turns left by 1 rad while driving 0.5 m in 1 s.
class ImportMrclam : public testing::Test {
 protected:
  ImportMrclam() {
    write_text(folder_ / "Barcodes.dat", "# subject barcode\n 2 14\n 6 63\n 7 81\r\n");
    write_text(folder_ / "Landmark_Groundtruth.dat", "6 1.5 -2.5 0.1 0.1\n7 3 4 0 0\n");
    write_text(folder_ / "Robot1_Odometry.dat",
               "# t v w\n100.000 0.5 0\n102.000 0.5 1.0\n103.000 0 0\n");
    write_text(folder_ / "Robot1_Measurement.dat",
               "101.000 63 2.0 0.1\n101.000 14 1.0 0\n101.000 81 4.0 -0.2\n"
               "102.000 99 1.0 0\n102.500 14 1.0 0\n103.000 63 1.0 7.0\n");
    write_text(folder_ / "Robot1_Groundtruth.dat",
               "100.000 1 2 3\n100.500 1 2 4\n101.000 1 2 -3\n103.000 1 2 0\n");
  }

  std::string import(MrclamImport options = {.odometry_delay_s = 0.0}) {
    options.folder = folder_;
    options.out = out_;
    std::ostringstream notes;
    import_mrclam(options, notes);
    return notes.str();
  }

  ScratchFolder scratch_;
  std::filesystem::path folder_ = scratch_.path() / "mrclam";
  std::filesystem::path out_ = scratch_.path() / "out.lcmlog";
};

TEST_F(ImportMrclam, TheRobotFollowsItsRecordLater) {
  MrclamImport options;
  options.odometry_delay_s = 0.25;
  import(options);
  EXPECT_EQ(messages_on(out_, channels::kOdometry).at(0).utime, 102'250'000);
}

TEST_F(ImportMrclam, SpeedHoldsUntilTheNextRecord) {
  import();
  const auto odometry = messages_on(out_, channels::kOdometry);
  ASSERT_EQ(odometry.size(), 2U);
  EXPECT_EQ(odometry[0].utime, 102'000'000);
  EXPECT_EQ(odometry[0].interval_us, 2'000'000);
  EXPECT_EQ(odometry[0].source, odometry_t::SOURCE_VELOCITY);
  EXPECT_DOUBLE_EQ(odometry[0].distance_increment_m, 1.0);
  EXPECT_DOUBLE_EQ(odometry[0].x_m, 1.0);
  EXPECT_DOUBLE_EQ(odometry[0].covariance_distance_distance_m2, 0.005);
  EXPECT_DOUBLE_EQ(odometry[0].covariance_turn_turn_rad2, 0.01);
  EXPECT_DOUBLE_EQ(odometry[1].turn_increment_rad, 1.0);
  EXPECT_DOUBLE_EQ(odometry[1].covariance_turn_turn_rad2, 0.02 + 0.005);
  // A quarter of a circle of radius 0.5 m would end at radius * (sin 1, 1 - cos 1).
  EXPECT_NEAR(odometry[1].x_m, 1.0 + 0.5 * std::sin(1.0), 1e-12);
  EXPECT_NEAR(odometry[1].y_m, 0.5 * (1.0 - std::cos(1.0)), 1e-12);
  EXPECT_DOUBLE_EQ(odometry[1].heading_rad, 1.0);
}

TEST_F(ImportMrclam, RecordsOfOneInstantMakeNoMessage) {
  write_text(folder_ / "Robot1_Odometry.dat", "1 1 0\n2 9 0\n2 1 0\n3 0 0\n");
  import();
  const auto odometry = messages_on(out_, channels::kOdometry);
  ASSERT_EQ(odometry.size(), 2U);
  EXPECT_DOUBLE_EQ(odometry[1].x_m, 2.0);
}

TEST_F(ImportMrclam, SightingsOfOneInstantAreOneMessage) {
  const std::string notes = import();
  const auto sightings = messages_on(out_, channels::kLandmarks);
  ASSERT_EQ(sightings.size(), 2U);
  ASSERT_EQ(sightings[0].count, 2);
  const landmark_observation_t& first = sightings[0].landmarks[0];
  EXPECT_EQ(first.identity, 6);
  EXPECT_EQ(first.kind, landmark_observation_t::KIND_FIDUCIAL);
  EXPECT_DOUBLE_EQ(first.range_m, 2.0);
  EXPECT_DOUBLE_EQ(first.bearing_rad, 0.1);
  EXPECT_DOUBLE_EQ(first.covariance_range_range_m2, 0.16 * 0.16);
  EXPECT_DOUBLE_EQ(first.covariance_bearing_bearing_rad2, 0.03 * 0.03);
  EXPECT_EQ(sightings[0].landmarks[1].identity, 7);
  EXPECT_NEAR(sightings[1].landmarks[0].bearing_rad, 7.0 - 2 * std::numbers::pi, 1e-12);
  EXPECT_THAT(notes, HasSubstr("dropped: 2 sightings of other robots, 1 of unknown barcodes"));
}

TEST_F(ImportMrclam, IdentitiesCanBeHidden) {
  import({.unknown_identities = true});
  for (const auto& message : messages_on(out_, channels::kLandmarks)) {
    for (const auto& landmark : message.landmarks) EXPECT_EQ(landmark.identity, -1);
  }
}

TEST_F(ImportMrclam, TrueLandmarksComeOnceASecond) {
  import();
  const auto truth = messages_on(out_, channels::kTruth);
  ASSERT_EQ(truth.size(), 4U);
  EXPECT_EQ(truth[0].landmark_count, 2);
  EXPECT_EQ(truth[1].landmark_count, 0);
  EXPECT_EQ(truth[2].landmark_count, 2);
  EXPECT_EQ(truth[3].landmark_count, 2);
  EXPECT_EQ(truth[0].true_landmarks[0].identity, 6);
  EXPECT_DOUBLE_EQ(truth[0].true_landmarks[0].true_y_m, -2.5);
  EXPECT_NEAR(truth[1].true_heading_rad, 4.0 - 2 * std::numbers::pi, 1e-12);
}

TEST_F(ImportMrclam, EventsOfOneTimeHaveAFixedOrder) {
  import();
  EXPECT_THAT(channel_order(out_), ElementsAre("TRUTH", "TRUTH", "LANDMARKS", "TRUTH", "ODOMETRY",
                                               "ODOMETRY", "LANDMARKS", "TRUTH"));
}

TEST_F(ImportMrclam, RowsOutOfOrderAreSorted) {
  import();
  const std::string sorted = read_text(out_);
  write_text(folder_ / "Robot1_Odometry.dat", "102.000 0.5 1.0\n100.000 0.5 0\n103.000 0 0\n");
  import();
  EXPECT_EQ(read_text(out_), sorted);
}

TEST_F(ImportMrclam, ComplaintsNameFileAndLineAndLeaveNothing) {
  write_text(folder_ / "Robot1_Measurement.dat", "101.000 63 2.0 0.1\n101.000 63 -2.0 0.1\n");
  EXPECT_THAT(complaint_of([&] { import(); }),
              HasSubstr("Robot1_Measurement.dat:2: range must be above 0"));
  std::filesystem::remove(folder_ / "Robot1_Measurement.dat");
  EXPECT_THAT(complaint_of([&] { import(); }), HasSubstr("Robot1_Measurement.dat: cannot read"));
  EXPECT_THAT(complaint_of([&] { import({.robot = 4}); }), HasSubstr("Robot4_Odometry.dat"));
  EXPECT_FALSE(std::filesystem::exists(out_));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(scratch_.path()), {}), 1);
}

TEST_F(ImportMrclam, AFailedImportLeavesTheOlderLogAlone) {
  import();
  const std::string older = read_text(out_);
  write_text(folder_ / "Barcodes.dat", "6 63\n7 63\n");
  EXPECT_THAT(complaint_of([&] { import(); }), HasSubstr("Barcodes.dat:2: barcode"));
  EXPECT_EQ(read_text(out_), older);
}

TEST_F(ImportMrclam, RealRunTwiceGivesTheSameBytes) {
  ROOMWISE_NEED_DATA("mrclam7");
  folder_ = shared_data() / "mrclam7";
  const std::string notes = import({.robot = 2});
  EXPECT_THAT(notes, HasSubstr("landmarks 3818 in 2227 messages"));
  EXPECT_THAT(notes, HasSubstr("dropped: 700 sightings of other robots, 0 of unknown barcodes"));
  const std::string first = read_text(out_);
  import({.robot = 2});
  EXPECT_TRUE(first == read_text(out_));
  EXPECT_EQ(messages_on(out_, channels::kTruth).size(), 56'529U);
}

}  // namespace
}  // namespace roomwise
