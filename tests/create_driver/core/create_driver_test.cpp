#include "services/create_driver/core/create_driver.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace roomwise::create {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// The driver and a robot that streams a frame every 15 ms, in steps of 5 ms.
class Ride {
 public:
  explicit Ride(const CreateParams& params = {}) : driver(params), model(model_of(params)) {
    packets.set(Packet::kOiMode, 1);
    driver.port_opened(now);
  }

  void run(Duration time) {
    for (Duration spent{}; spent < time; spent += milliseconds(5)) step();
  }
  void step() {
    advance(milliseconds(5));
    if (commands_drive) command();
    Bytes received;
    std::swap(received, noise);
    if (streams && step_count++ % 3 == 0) append_frame(received);
    const auto sent = driver.step(now, received);
    obey({sent.begin(), sent.end()});
    reports.insert(reports.end(), driver.reports().begin(), driver.reports().end());
  }
  void advance(Duration time) {
    now.steady += time;
    now.wall += time;
  }
  void command() {
    driver.command(now, {.speed_mps = speed_mps,
                         .turn_rate_radps = turn_rate_radps,
                         .decided = now.wall,
                         .expiry = now.wall + milliseconds(200),
                         .session = 1,
                         .sequence = ++sequence,
                         .proof = Proof::kGenuine});
  }
  bool is_driving() const { return left_mmps != 0 || right_mmps != 0; }

  CreateDriver driver;
  Model model;
  Instant now{std::chrono::hours(1), time_from_utime(1'700'000'000'000'000)};
  SensorPackets packets;
  bool streams = true;
  bool commands_drive = true;
  double speed_mps = 0.2;
  double turn_rate_radps = 0.0;
  std::int64_t sequence = 0;
  Bytes noise;  // received before the next frame
  int left_mmps = 0;
  int right_mmps = 0;
  int starts = 0;
  int questions = 0;
  std::vector<FrameReport> reports;

 private:
  void append_frame(Bytes& bytes) {
    if (model == Model::kCreate1) {
      append_stream_frame(Bytes{1, 3, 4, 5}, packets, bytes);
    } else {
      append_stream_frame(Bytes{100}, packets, bytes);
    }
  }
  static int word(const Bytes& bytes, std::size_t at) {
    return static_cast<std::int16_t>(bytes[at] << 8 | bytes[at + 1]);
  }
  void obey(const Bytes& bytes) {
    for (std::size_t i = 0; i < bytes.size();) {
      i += obey_one(bytes, i);
    }
  }
  std::size_t obey_one(const Bytes& bytes, std::size_t at) {
    switch (bytes[at]) {
      case 128:
        ++starts;
        packets.set(Packet::kOiMode, 1);
        left_mmps = right_mmps = 0;
        return 1;
      case 131:
        packets.set(Packet::kOiMode, 2);
        return 1;
      case 142:
        ++questions;
        append_packets(2, packets, noise);
        return 2;
      case 145:
        if (packets[Packet::kOiMode] != 2) return 5;
        right_mmps = word(bytes, at + 1);
        left_mmps = word(bytes, at + 3);
        return 5;
      case 148:
        return 2U + bytes[at + 1];
      default:
        return 1;
    }
  }
  int step_count = 0;
};

TEST(CreateDriver, DrivesAsCommanded) {
  Ride ride;
  ride.turn_rate_radps = 1.0;
  ride.run(milliseconds(500));
  EXPECT_EQ(ride.left_mmps, 83);  // 200 - 117.5, to the nearest
  EXPECT_EQ(ride.right_mmps, 318);
  EXPECT_EQ(ride.reports.back().state, DriverState::kDriving);
}

TEST(CreateDriver, TooFastACurveIsDrivenSlowerNotWider) {
  Ride ride;
  ride.speed_mps = 0.8;
  ride.turn_rate_radps = 2.0;
  ride.run(milliseconds(500));
  EXPECT_EQ(ride.right_mmps, 500);
  EXPECT_EQ(ride.left_mmps, 273);  // 500 * (0.8 - 0.235) / (0.8 + 0.235)
}

TEST(CreateDriver, StopsWhenNoCommandComesForItsLife) {
  Ride ride;
  ride.run(milliseconds(500));
  ASSERT_TRUE(ride.is_driving());
  ride.commands_drive = false;
  ride.run(milliseconds(190));
  EXPECT_TRUE(ride.is_driving());
  ride.run(milliseconds(15));
  EXPECT_FALSE(ride.is_driving());
  ride.run(milliseconds(15));
  EXPECT_EQ(ride.reports.back().state, DriverState::kSilent);
  EXPECT_EQ(ride.driver.counts()[DriverEvent::kCommandsSilent], 1);
}

TEST(CreateDriver, DoesNotDriveBlind) {
  Ride ride;
  ride.run(milliseconds(500));
  ride.streams = false;
  ride.run(milliseconds(220));
  EXPECT_FALSE(ride.is_driving());
  ride.streams = true;
  ride.run(milliseconds(50));
  EXPECT_TRUE(ride.is_driving());
}

TEST(CreateDriver, HeldUpItBeginsAgainAndForgetsTheCommand) {
  Ride ride;
  ride.run(milliseconds(500));
  const int starts = ride.starts;
  ride.commands_drive = false;
  ride.advance(milliseconds(100));
  ride.step();
  EXPECT_EQ(ride.starts, starts + 1);
  EXPECT_FALSE(ride.is_driving());
  EXPECT_EQ(ride.driver.counts()[DriverEvent::kHostStalled], 1);
  ride.commands_drive = true;
  ride.run(milliseconds(400));
  EXPECT_TRUE(ride.is_driving());
}

TEST(CreateDriver, AnUpsetOfALittleLessIsTolerated) {
  Ride ride;
  ride.run(milliseconds(500));
  ride.advance(milliseconds(90));
  ride.step();
  EXPECT_TRUE(ride.is_driving());
  EXPECT_EQ(ride.driver.counts()[DriverEvent::kHostStalled], 0);
}

TEST(CreateDriver, ReportsEncoderSteps) {
  Ride ride;
  ride.packets.set(Packet::kEncoderLeft, 65530);
  ride.packets.set(Packet::kEncoderRight, 65530);
  ride.run(milliseconds(15));
  ride.packets.set(Packet::kEncoderLeft, 4);
  ride.packets.set(Packet::kEncoderRight, 4);
  ride.run(milliseconds(15));
  ASSERT_EQ(ride.reports.size(), 2U);
  EXPECT_FALSE(ride.reports[0].odometry);
  ASSERT_TRUE(ride.reports[1].odometry);
  EXPECT_NEAR(ride.reports[1].odometry->distance_m, 10 * 0.000444565, 1e-7);
  EXPECT_EQ(ride.reports[1].odometry->interval, milliseconds(15));
}

TEST(CreateDriver, ANewlyOpenedPortStartsThePoseAnew) {
  Ride ride;
  ride.run(milliseconds(100));
  ride.driver.port_opened(ride.now);
  ride.run(milliseconds(100));
  EXPECT_EQ(ride.reports.back().odometry->reset_counter, 1);
}

TEST(CreateDriver, ABootIsCountedOnceAndStartsThePoseAnew) {
  Ride ride;
  ride.run(milliseconds(500));
  const std::string text = "\r\nRoomba by iRobot!\r\nrelease-stm32-3.7.7:6913 CLEAN\r\n";
  ride.noise.assign(text.begin(), text.end());
  ride.packets.set(Packet::kOiMode, 0);
  ride.left_mmps = ride.right_mmps = 0;
  ride.run(milliseconds(1500));
  EXPECT_EQ(ride.reports.back().robot_restarts, 1);
  EXPECT_EQ(ride.driver.firmware(), (Firmware{3, 7, 7}));
  EXPECT_EQ(ride.reports.back().odometry->reset_counter, 1);
  EXPECT_TRUE(ride.is_driving());
}

TEST(CreateDriver, NoiseIsCountedAndCostsNothing) {
  Ride ride;
  ride.run(milliseconds(500));
  const std::size_t before = ride.reports.size();
  for (int i = 0; i < 20; ++i) {
    ride.noise.assign(50, 19);
    ride.run(milliseconds(15));
  }
  EXPECT_EQ(ride.reports.size(), before + 20);
  EXPECT_EQ(ride.driver.counts()[DriverEvent::kBytesSkipped], 1000);
}

TEST(CreateDriver, ACreateOneIsAskedForItsMotionBesideTheStream) {
  CreateParams params;
  params.model = "create1";
  params.wheels.wheel_base_m = 0.258;
  Ride ride(params);
  ride.run(milliseconds(500));
  ride.packets.set(Packet::kDistance_mm, 30);
  ride.packets.set(Packet::kRequestedLeft_mmps, 200);
  ride.packets.set(Packet::kRequestedRight_mmps, 200);
  ride.reports.clear();
  ride.questions = 0;
  ride.run(seconds(3));
  EXPECT_NEAR(ride.questions, 20, 2);
  const auto steps = std::count_if(ride.reports.begin(), ride.reports.end(),
                                   [](const FrameReport& report) { return report.odometry; });
  EXPECT_NEAR(static_cast<double>(steps), 20.0, 2.0);
  EXPECT_EQ(ride.driver.counts()[DriverEvent::kReadingLost], 0);
  EXPECT_EQ(ride.driver.counts()[DriverEvent::kBytesSkipped], 0);
}

TEST(CreateDriver, TheSameInputGivesTheSameBytes) {
  std::vector<double> first;
  for (int round = 0; round < 2; ++round) {
    Ride ride;
    ride.turn_rate_radps = 0.7;
    std::vector<double> poses;
    for (int i = 0; i < 200; ++i) {
      ride.packets.set(Packet::kEncoderLeft, 7 * i);
      ride.packets.set(Packet::kEncoderRight, 9 * i);
      ride.step();
    }
    for (const FrameReport& report : ride.reports) {
      if (report.odometry) poses.push_back(report.odometry->T_odom_robot.x_m);
    }
    if (round == 0) first = poses;
    EXPECT_FALSE(poses.empty());
    EXPECT_EQ(poses, first);
  }
}

}  // namespace
}  // namespace roomwise::create
