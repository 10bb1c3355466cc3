#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "tests/simulator/support/disparity_statistics.h"
#include "tests/simulator/support/simulated_disparity.h"
#include "tests/support/shared_data.h"

namespace roomwise::simulator {
namespace {

constexpr const char* kKitchen = "rgbd_7scenes_redkitchen_000_119";
constexpr const char* kResting = "fakenect_dump";
constexpr double kShare = 0.2;

/// Floor pixels of every fifth frame of a hand-held Kinect.
std::vector<DisparityImage> kitchen_floor() {
  std::vector<DisparityImage> images;
  for (int i = 0; i < 120; i += 5) {
    std::string digits = std::to_string(i);
    digits.insert(0, 6 - digits.size(), '0');
    const auto stem = shared_data() / kKitchen / ("frame-" + digits);
    const cv::Mat1w depth = cv::imread(stem.string() + ".depth.png", cv::IMREAD_UNCHANGED);
    const cv::Mat1b floor = cv::imread(stem.string() + ".floor.png", cv::IMREAD_GRAYSCALE);
    DisparityImage image{depth.cols, depth.rows, {}};
    for (int k = 0; k < depth.cols * depth.rows; ++k) {
      const int mm = depth(k / depth.cols, k % depth.cols);
      const bool is_floor = floor(k / depth.cols, k % depth.cols) == 255;
      image.quanta.push_back(is_floor && mm > 0 && mm < 60000 ? 351000.0F / static_cast<float>(mm)
                                                              : 0.0F);
    }
    images.push_back(image);
  }
  return images;
}

/// One raw image of 11-bit shifts: a PGM whose payload is little-endian.
DisparityImage read_raw(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string magic;
  int width_px = 0, height_px = 0, largest = 0;
  file >> magic >> width_px >> height_px >> largest;
  file.get();
  DisparityImage image{width_px, height_px, {}};
  std::vector<unsigned char> bytes(2 * static_cast<std::size_t>(width_px * height_px));
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  for (std::size_t i = 0; i < bytes.size(); i += 2) {
    const int raw = bytes[i] | bytes[i + 1] << 8;
    image.quanta.push_back(raw == 2047 ? 0.0F : static_cast<float>(1090 - raw));
  }
  return image;
}

std::vector<DisparityImage> resting_camera() {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(shared_data() / kResting)) {
    if (entry.path().extension() == ".pgm") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  std::vector<DisparityImage> images;
  for (const auto& path : paths) images.push_back(read_raw(path));
  return images;
}

/// For the reader of a report: what was measured.
void report(const std::string& figure, double simulated, double recorded) {
  std::cout << "    " << figure << ": simulated " << simulated << ", recorded " << recorded << "\n";
}

void expect_alike(const PlaneScatter& simulated, const PlaneScatter& recorded) {
  report("scatter about a plane, quanta", simulated.sigma_quanta, recorded.sigma_quanta);
  report("second difference, quanta", simulated.second_difference_quanta,
         recorded.second_difference_quanta);
  EXPECT_GT(recorded.windows, 1000);
  EXPECT_NEAR(simulated.sigma_quanta, recorded.sigma_quanta, kShare * recorded.sigma_quanta);
  EXPECT_NEAR(simulated.second_difference_quanta, recorded.second_difference_quanta,
              kShare * recorded.second_difference_quanta);
  for (std::size_t i = 1; i < 5; ++i) {
    EXPECT_NEAR(simulated.across[i], recorded.across[i], 0.15) << i;
    EXPECT_NEAR(simulated.down[i], recorded.down[i], 0.2) << i;
  }
}

TEST(RecordedDisparity, OfAFloorScattersAsTheSimulatedOne) {
  ROOMWISE_NEED_DATA(kKitchen);
  expect_alike(plane_scatter(disparities_of_floor()), plane_scatter(kitchen_floor()));
}

TEST(RecordedDisparity, OfARestingCameraScattersInSpaceAndTimeAsTheSimulatedOne) {
  ROOMWISE_NEED_DATA(kResting);
  const std::vector<DisparityImage> simulated = disparities_of_wall(), recorded = resting_camera();
  expect_alike(plane_scatter(simulated), plane_scatter(recorded));
  const double recorded_quanta = frame_difference_quanta(recorded);
  report("change from frame to frame, quanta", frame_difference_quanta(simulated), recorded_quanta);
  EXPECT_NEAR(frame_difference_quanta(simulated), recorded_quanta, kShare * recorded_quanta);
}

}  // namespace
}  // namespace roomwise::simulator
