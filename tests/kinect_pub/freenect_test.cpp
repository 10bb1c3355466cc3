// Our Kinect v1 driver on a recorded Kinect: libfreenect's fakenect in the place of the device.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstring>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

#include "common/frames/frame_decoder.h"
#include "services/kinect_pub/core/shift_depth.h"
#include "tests/kinect_pub/support/kinect_run.h"
#include "tests/support/build_paths.h"
#include "tests/support/private_network.h"
#include "tests/support/shared_data.h"

namespace roomwise {
namespace {

using Words = std::vector<std::uint16_t>;
constexpr std::size_t kPixels = 640 * 480;
constexpr const char* kFakenect = "/usr/lib/x86_64-linux-gnu/fakenect/libfreenect.so";

std::filesystem::path dump() { return shared_data() / "fakenect_dump"; }

std::string read_whole(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

Words words_in(const std::string& bytes, std::size_t offset) {
  Words words(kPixels);
  std::memcpy(words.data(), bytes.data() + offset, 2 * kPixels);
  return words;
}

/// The disparity words of every depth image of the dump: after one line of header.
std::set<Words> recorded_words() {
  std::set<Words> images;
  for (const auto& entry : std::filesystem::directory_iterator(dump())) {
    if (entry.path().extension() != ".pgm") continue;
    const std::string bytes = read_whole(entry.path());
    images.insert(words_in(bytes, bytes.find('\n') + 1));
  }
  return images;
}

std::set<Words> recorded_depths() {
  const kinect::ShiftTable table = kinect::shift_table({});
  std::set<Words> images;
  for (Words words : recorded_words()) {
    kinect::shifts_to_depths(table, words);
    images.insert(words);
  }
  return images;
}

/// The dump once after the other, as one long recording: fakenect plays but once. Its clock starts
/// anew each time.
void repeat_dump(const std::filesystem::path& folder) {
  std::filesystem::create_directory(folder);
  for (const auto& entry : std::filesystem::directory_iterator(dump())) {
    if (entry.path().filename() == "INDEX.txt") continue;
    std::filesystem::create_symlink(std::filesystem::absolute(entry.path()),
                                    folder / entry.path().filename());
  }
  std::ofstream index(folder / "INDEX.txt");
  for (int i = 0; i < 40; ++i) index << read_whole(dump() / "INDEX.txt");
}

KinectRun::Environment fakenect(const std::filesystem::path& recording) {
  // Sanitized programs insist on being loaded first.
  return {std::string("LD_PRELOAD=") + kFakenect, "FAKENECT_PATH=" + recording.string(),
          "ASAN_OPTIONS=verify_asan_link_order=0"};
}

class FreenectTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { enter_private_network(); }

  KinectRun run_;
};

TEST_F(FreenectTest, FramesOfKinectPubAreThoseOfTheDump) {
  ROOMWISE_NEED_DATA("fakenect_dump");
  repeat_dump(run_.folder() / "dump");
  run_.start_kinect_pub("device = 'freenect://0'\nuse_color = false",
                        fakenect(run_.folder() / "dump"));
  const auto messages = run_.frames(20);
  ASSERT_EQ(messages.size(), 20U) << run_.kinect_pub().output();
  const std::set<Words> recorded = recorded_depths();
  FrameDecoder decoder(ColorUse::kDecode);
  for (const kinect_frame_t& message : messages) {
    RgbdFrame frame;
    ASSERT_EQ(decoder.decode(message, frame), FrameResult::kOk);
    EXPECT_TRUE(recorded.contains(frame.depth.steps));
    EXPECT_TRUE(frame.color.empty());
    EXPECT_FALSE(frame.depth_registered);
  }
}

TEST_F(FreenectTest, ClientThatAsksForDisparityGetsTheSensorsOwnWords) {
  ROOMWISE_NEED_DATA("fakenect_dump");
  const std::string file = run_.folder() / "words";
  std::vector<std::string> command = {"env"};
  for (const std::string& variable : fakenect(dump())) command.push_back(variable);
  for (const std::string& word :
       {test_program("read_kinect"), std::string("freenect://0"), file, std::string("12")}) {
    command.push_back(word);
  }
  std::string said;
  ASSERT_EQ(run_to_end(command, said), 0) << said;
  const std::string bytes = read_whole(file);
  ASSERT_EQ(bytes.size(), 12 * 2 * kPixels);
  const std::set<Words> recorded = recorded_words();
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_TRUE(recorded.contains(words_in(bytes, 2 * kPixels * i))) << "image " << i;
  }
  double tilt_rad = 9.0;
  double x_mps2 = 0.0;
  double y_mps2 = 0.0;
  double z_mps2 = 0.0;
  std::istringstream(said.substr(said.rfind('\n', said.size() - 2) + 1)) >> tilt_rad >> x_mps2 >>
      y_mps2 >> z_mps2;
  EXPECT_LT(std::abs(tilt_rad), 0.6) << said;
  EXPECT_NEAR(std::hypot(x_mps2, y_mps2, z_mps2), 9.81, 1.0) << "at rest it feels its weight";
}

TEST_F(FreenectTest, ColourThatNeverComesIsSaid) {
  ROOMWISE_NEED_DATA("fakenect_dump");
  run_.start_kinect_pub("device = 'freenect://0'\nstart_max_s = 0.3", fakenect(dump()));
  const auto status = run_.status([](const device_status_t& s) { return !s.last_error.empty(); });
  ASSERT_TRUE(status) << run_.kinect_pub().output();
  EXPECT_EQ(status->last_error, "freenect://0: sends no pair of images");
  EXPECT_EQ(status->registration_asked, 1);
  EXPECT_EQ(status->registration_in_force, 0) << "the recorded Kinect cannot";
}

TEST_F(FreenectTest, KinectThatIsNotThereIsNamed) {
  run_.start_kinect_pub("device = 'freenect://A00000000000000A'");
  const auto status = run_.status([](const device_status_t& s) { return !s.last_error.empty(); });
  ASSERT_TRUE(status) << run_.kinect_pub().output();
  EXPECT_THAT(status->last_error, ::testing::StartsWith("freenect://A00000000000000A: cannot be "));
  EXPECT_EQ(status->state, device_status_t::STATE_SEARCHING);
}

}  // namespace
}  // namespace roomwise
