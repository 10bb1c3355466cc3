// libRoomwiseSim.so.0 as any client of OpenNI2 meets it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>
#include <numbers>

#include "tests/simulator/openni2/fed_door.h"
#include "tests/simulator/openni2/opened_camera.h"
#include "tests/support/scratch_folder.h"

namespace roomwise::simulator {
namespace {

class SimDriverTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { start_openni(); }

  const FedDoor& serve() {
    door_ = std::make_unique<FedDoor>(path_);
    return *door_;
  }

  bool is_listed() const {
    openni::Array<openni::DeviceInfo> devices;
    openni::OpenNI::enumerateDevices(&devices);
    for (int i = 0; i < devices.getSize(); ++i) {
      if (devices[i].getUri() == uri_of(default_door())) return true;
    }
    return false;
  }

  ScratchFolder folder_;
  const std::filesystem::path path_ = folder_.path() / "kinect";
  std::unique_ptr<FedDoor> door_;
};

openni::VideoMode mode(openni::PixelFormat format, int width_px, int height_px, int rate_hz) {
  openni::VideoMode made;
  made.setPixelFormat(format);
  made.setResolution(width_px, height_px);
  made.setFps(rate_hz);
  return made;
}

TEST_F(SimDriverTest, DepthAndColourArePixelExactWithTheirTime) {
  serve();
  OpenedCamera camera(uri_of(path_));
  camera.mirror(false);
  camera.start();
  for (int i = 0; i < 5; ++i) {
    const openni::VideoFrameRef depth = next_image(camera.depth);
    ASSERT_TRUE(depth.isValid());
    const std::int64_t number = made_number(static_cast<std::int64_t>(depth.getTimestamp()));
    EXPECT_EQ(static_cast<std::int64_t>(depth.getTimestamp()), made_device_time_us(number));
    EXPECT_EQ(pixels_of<std::uint16_t>(depth), made_frame(number).depth.steps);
    const openni::VideoFrameRef color = next_image(camera.color);
    ASSERT_TRUE(color.isValid());
    const std::int64_t color_number = made_number(static_cast<std::int64_t>(color.getTimestamp()));
    EXPECT_EQ(pixels_of<std::uint8_t>(color), made_frame(color_number).color.rgb);
  }
}

TEST_F(SimDriverTest, QuarterResolutionIsWhatTheSimulatorMakes) {
  const FedDoor& door = serve();
  OpenedCamera camera(uri_of(path_));
  camera.mirror(false);
  ASSERT_EQ(camera.depth.setVideoMode(mode(openni::PIXEL_FORMAT_DEPTH_1_MM, 320, 240, 30)),
            openni::STATUS_OK);
  camera.start();
  EXPECT_EQ(door.request(), (FrameRequest{320, 640, false}));
  const openni::VideoFrameRef depth = next_image(camera.depth);
  ASSERT_TRUE(depth.isValid());
  const std::int64_t number = made_number(static_cast<std::int64_t>(depth.getTimestamp()));
  EXPECT_EQ(depth.getWidth(), 320);
  EXPECT_EQ(pixels_of<std::uint16_t>(depth), made_frame(number, {320, 640, false}).depth.steps);
}

TEST_F(SimDriverTest, ModesItDoesNotHaveAreRefused) {
  serve();
  OpenedCamera camera(uri_of(path_));
  for (const openni::VideoMode& refused : {mode(openni::PIXEL_FORMAT_DEPTH_1_MM, 1280, 960, 30),
                                           mode(openni::PIXEL_FORMAT_DEPTH_1_MM, 640, 480, 60),
                                           mode(openni::PIXEL_FORMAT_RGB888, 640, 480, 30)}) {
    EXPECT_NE(camera.depth.setVideoMode(refused), openni::STATUS_OK);
  }
  camera.start();
  EXPECT_NE(camera.depth.setVideoMode(mode(openni::PIXEL_FORMAT_DEPTH_1_MM, 320, 240, 30)),
            openni::STATUS_OK)
      << "changed under a running stream";
}

TEST_F(SimDriverTest, RegistrationIsOffUntilAskedForAndThenHoldsForEveryFrame) {
  serve();
  OpenedCamera camera(uri_of(path_));
  camera.mirror(false);
  EXPECT_EQ(camera.device.getImageRegistrationMode(), openni::IMAGE_REGISTRATION_OFF);
  camera.start();
  ASSERT_TRUE(next_image(camera.depth).isValid());
  ASSERT_EQ(camera.device.setImageRegistrationMode(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR),
            openni::STATUS_OK);
  EXPECT_EQ(camera.device.getImageRegistrationMode(), openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR);
  next_image(camera.depth);  // may have been waiting since before
  for (int i = 0; i < 3; ++i) {
    const openni::VideoFrameRef depth = next_image(camera.depth);
    ASSERT_TRUE(depth.isValid());
    const std::int64_t number = made_number(static_cast<std::int64_t>(depth.getTimestamp()));
    EXPECT_EQ(pixels_of<std::uint16_t>(depth), made_frame(number, {640, 640, true}).depth.steps);
  }
}

TEST_F(SimDriverTest, IsMirroredUntilToldOtherwiseAsRealCamerasAre) {
  serve();
  OpenedCamera camera(uri_of(path_));
  EXPECT_TRUE(camera.depth.getMirroringEnabled());
  camera.start();
  const openni::VideoFrameRef depth = next_image(camera.depth);
  ASSERT_TRUE(depth.isValid());
  std::vector<std::uint16_t> expected =
      made_frame(made_number(static_cast<std::int64_t>(depth.getTimestamp()))).depth.steps;
  for (auto row = expected.begin(); row != expected.end(); row += 640) {
    std::reverse(row, row + 640);
  }
  EXPECT_EQ(pixels_of<std::uint16_t>(depth), expected);
}

TEST_F(SimDriverTest, CroppingCutsARectangleOut) {
  serve();
  OpenedCamera camera(uri_of(path_));
  camera.mirror(false);
  ASSERT_EQ(camera.depth.setCropping(100, 50, 200, 30), openni::STATUS_OK);
  EXPECT_NE(camera.depth.setCropping(500, 50, 200, 30), openni::STATUS_OK);
  EXPECT_NE(camera.depth.setCropping(-1, 50, 200, 30), openni::STATUS_OK);
  camera.start();
  const openni::VideoFrameRef depth = next_image(camera.depth);
  ASSERT_TRUE(depth.isValid());
  ASSERT_EQ(depth.getWidth(), 200);
  ASSERT_EQ(depth.getHeight(), 30);
  const RgbdFrame made = made_frame(made_number(static_cast<std::int64_t>(depth.getTimestamp())));
  const auto cropped = pixels_of<std::uint16_t>(depth);
  for (int v = 0; v < 30; ++v) {
    for (int u = 0; u < 200; ++u) {
      ASSERT_EQ(cropped[static_cast<std::size_t>(v * 200 + u)], made.depth.at(100 + u, 50 + v));
    }
  }
}

TEST_F(SimDriverTest, SaysWhatItIs) {
  serve();
  OpenedCamera camera(uri_of(path_));
  char serial[64];
  int size = sizeof serial;
  ASSERT_EQ(camera.device.getProperty(openni::DEVICE_PROPERTY_SERIAL_NUMBER, serial, &size),
            openni::STATUS_OK);
  EXPECT_STREQ(serial, "fed-7");
  EXPECT_NEAR(camera.depth.getHorizontalFieldOfView(), 2.0 * std::atan(320.0 / 575.8), 1e-6);
  EXPECT_NEAR(camera.color.getVerticalFieldOfView(), 2.0 * std::atan(240.0 / 525.0), 1e-6);
  EXPECT_EQ(camera.depth.getMaxPixelValue(), 10000);
  int odd = 3;
  char few[3];
  EXPECT_NE(camera.depth.getProperty(openni::STREAM_PROPERTY_VIDEO_MODE, few, &odd),
            openni::STATUS_OK);
  EXPECT_NE(camera.depth.getProperty(4711, serial, &size), openni::STATUS_OK);
}

TEST_F(SimDriverTest, FrameSyncPairsByNumber) {
  serve();
  OpenedCamera camera(uri_of(path_));
  camera.start();
  ASSERT_EQ(camera.device.setDepthColorSyncEnabled(true), openni::STATUS_OK);
  for (int i = 0; i < 3; ++i) {
    const openni::VideoFrameRef depth = next_image(camera.depth);
    const openni::VideoFrameRef color = next_image(camera.color);
    ASSERT_TRUE(depth.isValid() && color.isValid());
    EXPECT_EQ(depth.getTimestamp(), color.getTimestamp());
  }
  camera.device.setDepthColorSyncEnabled(false);
}

/// Waits for the comings and goings of one device.
class PlugListener : private openni::OpenNI::DeviceConnectedListener,
                     private openni::OpenNI::DeviceDisconnectedListener {
 public:
  explicit PlugListener(std::string uri) : uri_(std::move(uri)) {
    openni::OpenNI::addDeviceConnectedListener(this);
    openni::OpenNI::addDeviceDisconnectedListener(this);
  }
  ~PlugListener() override {
    openni::OpenNI::removeDeviceConnectedListener(this);
    openni::OpenNI::removeDeviceDisconnectedListener(this);
  }
  bool wait_until(int connected, int disconnected) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::seconds(10), [&] {
      return connected_ >= connected && disconnected_ >= disconnected;
    });
  }

 private:
  void onDeviceConnected(const openni::DeviceInfo* info) override { count(info, connected_); }
  void onDeviceDisconnected(const openni::DeviceInfo* info) override { count(info, disconnected_); }
  void count(const openni::DeviceInfo* info, int& counter) {
    if (info->getUri() != uri_) return;
    const std::lock_guard lock(mutex_);
    ++counter;
    changed_.notify_all();
  }
  const std::string uri_;
  std::mutex mutex_;
  std::condition_variable changed_;
  int connected_ = 0;
  int disconnected_ = 0;
};

TEST_F(SimDriverTest, IsListedWhileASimulatorServesTheDefaultDoor) {
  PlugListener listener(uri_of(default_door()));
  EXPECT_FALSE(is_listed());
  door_ = std::make_unique<FedDoor>(default_door());
  ASSERT_TRUE(listener.wait_until(1, 0));
  EXPECT_TRUE(is_listed());
  door_.reset();
  ASSERT_TRUE(listener.wait_until(1, 1));
  EXPECT_FALSE(is_listed());
}

TEST_F(SimDriverTest, UnpluggedCameraGoesSilentAndOpensAgainOncePluggedIn) {
  const std::filesystem::path other = folder_.path() / "another";
  PlugListener listener(uri_of(other));
  door_ = std::make_unique<FedDoor>(other);
  {
    OpenedCamera camera(uri_of(other));
    camera.start();
    ASSERT_TRUE(next_image(camera.depth).isValid());
    door_.reset();
    ASSERT_TRUE(listener.wait_until(1, 1));
    door_ = std::make_unique<FedDoor>(other);
    ASSERT_TRUE(listener.wait_until(2, 1));
    next_image(camera.depth, 100);  // may have been waiting since before
    EXPECT_FALSE(next_image(camera.depth, 200).isValid()) << "a device came back by itself";
  }
  OpenedCamera again(uri_of(other));
  again.start();
  EXPECT_TRUE(next_image(again.depth).isValid());
}

TEST_F(SimDriverTest, MissingDoorIsAnErrorThatNamesIt) {
  openni::Device device;
  EXPECT_NE(device.open("roomwise-sim:///nowhere/kinect"), openni::STATUS_OK);
  EXPECT_THAT(openni::OpenNI::getExtendedError(), ::testing::HasSubstr("/nowhere/kinect"));
}

}  // namespace
}  // namespace roomwise::simulator
