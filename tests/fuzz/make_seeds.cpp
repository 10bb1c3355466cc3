// Writes a small corpus for every fuzzer into FOLDER/NAME_OF_FUZZER. usage: make_seeds FOLDER
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "common/bus/log_file.h"
#include "common/bus/wire.h"
#include "common/create/sensor_packets.h"
#include "common/frames/frame_encoder.h"
#include "roomwise/all_messages.hpp"
#include "services/ekf_svc/core/map_codec.h"

namespace roomwise {
namespace {

using Bytes = std::vector<std::uint8_t>;

class Corpus {
 public:
  explicit Corpus(const std::filesystem::path& folder) : folder_(folder) {
    std::filesystem::create_directories(folder);
  }
  void add(const Bytes& bytes) {
    std::ofstream file(folder_ / std::to_string(seeds_++), std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  }
  void add(std::string_view text) { add(Bytes(text.begin(), text.end())); }

 private:
  std::filesystem::path folder_;
  int seeds_ = 0;
};

/// A step with a hole; few values far apart, or many.
DepthImage depth_image(bool few_values) {
  DepthImage depth{40, 30, 0.001, {}};
  for (int v = 0; v < 30; ++v) {
    for (int u = 0; u < 40; ++u) {
      const int index = (u > 20 ? 20 : 8) + v / 9;
      const int step = few_values ? 40 * index : 900 + u * u + 3 * v + 700 * (u > 20);
      depth.steps.push_back(static_cast<std::uint16_t>(u / 4 == 5 ? 0 : step));
    }
  }
  return depth;
}

kinect_frame_t frame_message(std::int8_t depth_encoding, std::int8_t color_encoding) {
  kinect_frame_t message{};
  FrameEncoder encoder;
  const DepthImage depth = depth_image(true);
  if (depth_encoding == kinect_frame_t::DEPTH_PLAYER16) {
    encoder.encode_depth_and_players(depth, Bytes(depth.size(), 2), message);
  } else {
    encoder.encode_depth(depth, depth_encoding, message);
  }
  ColorImage color{24, 16, {}};
  for (int i = 0; i < 24 * 16 * 3; ++i) color.rgb.push_back(static_cast<std::uint8_t>(i));
  encoder.encode_color(color, color_encoding, 80, message);
  encode_depth_camera({60.0, 60.0, 19.5, 14.5}, message);
  encode_color_camera({40.0, 40.0, 11.5, 7.5}, message);
  encode_pose(Eigen::Isometry3d::Identity(), message);
  return message;
}

void depth_codec_seeds(Corpus corpus) {
  for (const bool few_values : {false, true}) {
    const DepthImage depth = depth_image(few_values);
    Bytes coded;
    DepthEncoder().encode(depth.steps, depth.width_px, depth.height_px, coded);
    coded.insert(coded.begin(), {1, 39, 29, 16});
    corpus.add(coded);
    Bytes raw{0, 39, 29, 16};
    for (const std::uint16_t step : depth.steps) {
      raw.push_back(static_cast<std::uint8_t>(step));
      raw.push_back(static_cast<std::uint8_t>(step >> 8));
    }
    corpus.add(raw);
  }
}

void frame_seeds(Corpus corpus) {
  for (const auto depth :
       {kinect_frame_t::DEPTH_RAW16, kinect_frame_t::DEPTH_PDZ16, kinect_frame_t::DEPTH_PLAYER16}) {
    for (const auto color : {kinect_frame_t::COLOR_RGB8, kinect_frame_t::COLOR_JPEG}) {
      Bytes bytes;
      encode(frame_message(depth, color), bytes);
      corpus.add(bytes);
    }
  }
}

template <class... Messages>
void wire_seeds(Corpus corpus, const std::tuple<Messages...>&) {
  std::uint8_t type = 0;
  const auto add = [&](const auto& message) {
    Bytes bytes;
    encode(message, bytes);
    bytes.insert(bytes.begin(), type++);
    corpus.add(bytes);
  };
  (add(Messages{}), ...);
}

void params_seeds(Corpus corpus) {
  corpus.add("range_noise_m = 0.1\nrows_min = 7\npublish_edges = true\nmethod = \"disparity\"\n");
  corpus.add("# a comment\nlabel = \"\\u00e9\\n\"\n");
  corpus.add("rows_min = 99999999999\nunknown = [1, {a = 1979-05-27}]\n");
}

/// Two bytes of choices, then what hosts send.
void scenario_seeds(Corpus corpus) {
  corpus.add(R"([robot]
at_m = [1.0, 2.0]
heading_rad = 0.5
[[path]]
name = "loop1"
corners_m = [[2.0, 2.0], [2.0, 0.0]]
[[path]]
name = "loop2"
same_as = "loop1"
rounds = 2
[[fault]]
name = "slip"
at_s = 1
[camera]
pitch_down_rad = 0.1
[light]
lamp_level = 0.5
[[lamp]]
at_m = [0, 0, 2]
power = [1, 1, 1]
)");
  corpus.add(R"([robot]
at_m = [1, 2]
[[material]]
name = "a"
pattern = "checker"
color = [0.5, 0.5, 0.5]
see_through = true
[[pit]]
least_m = [0, 0]
largest_m = [1, 2]
depth_m = 2
material = "a"
steps = 3
tread_m = 0.3
riser_m = 0.1
steps_from = "west"
[[floor]]
least_m = [-3, -3]
largest_m = [3, 3]
material = "a"
[[wall]]
points_m = [[-3, -3], [3, -3], [3, 3]]
closed = true
material = "a"
[[wall.opening]]
leg = 1
from_m = 1
to_m = 2
head_m = 2
[[mesh]]
corners_m = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
triangles = [[0, 1, 2]]
at_m = [0, 0]
material = "a"
)");
  corpus.add(R"([robot]
at_m = [1, 2]
[[material]]
name = "a"
[[box]]
at_m = [0, 0]
size_m = [1, 1, 1]
material = "a"
class = "wall"
[[cylinder]]
at_m = [0, 0]
radius_m = 0.1
height_m = 1
material = "a"
[[panel]]
at_m = [0, 0]
size_m = [1, 1]
material = "a"
[[table]]
at_m = [0, 0]
size_m = [1, 1, 1]
material = "a"
[[chair]]
at_m = [0, 0]
material = "a"
[[sofa]]
at_m = [0, 0]
material = "a"
[[shelf]]
at_m = [0, 0]
material = "a"
boards = 3
[[stairs]]
at_m = [0, 0]
steps = 3
width_m = 1
material = "a"
[[walker]]
name = "anna"
way_m = [[-2, 0], [-2, 2]]
speed_mps = 1
legs = "a"
body = "a"
head = "a"
)");
}

void create_seeds(Corpus corpus) {
  corpus.add(Bytes{0, 0, 128, 131, 148, 1, 100, 145, 0, 200, 0, 200, 142, 35, 150, 0, 150, 1, 173});
  corpus.add(Bytes{4, 6, 128, 132, 137, 255, 56, 1, 244, 149, 3, 7, 43, 20, 129, 7, 7, 133});
  corpus.add(
      Bytes{1, 1, 128, 131, 152, 6, 137, 0, 100, 128, 0, 153, 153, 155, 1, 158, 5, 154, 136});
  corpus.add(Bytes{10, 17, 128, 140, 0, 1, 60, 8, 141, 0, 135, 131, 146, 0, 255, 255, 1, 201});
  // A frame of 425 bytes, cut to the 172 of its slot, which its length byte (425 - 256) fits too.
  corpus.add(Bytes{0, 0, 128, 148, 10, 100, 100, 100, 100, 100, 3, 7, 8, 9, 19, 0, 0});
}

void log_seeds(Corpus corpus, const std::filesystem::path& scratch) {
  {
    LogWriter writer(scratch);
    for (int i = 0; i < 3; ++i) {
      writer.write(LogEvent{Time(std::chrono::microseconds(1000 * i)), "ODOMETRY", Bytes(20, 7)});
    }
    writer.close();
  }
  std::ifstream file(scratch, std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(file)), {});
  std::filesystem::remove(scratch);
  corpus.add(whole);
  corpus.add(whole.substr(0, whole.size() - 9));
  corpus.add("torn" + whole);
}

/// Model, then frames of it, each after a byte that says how long it is.
void serial_seeds(Corpus corpus) {
  for (const Bytes& ids : {Bytes{100}, Bytes{1, 3, 4, 5}}) {
    Bytes stream{static_cast<std::uint8_t>(ids.size() > 1 ? 1 : 0)};
    for (int i = 0; i < 40; ++i) {
      create::SensorPackets packets;
      packets.set(create::Packet::kEncoderLeft, 65500 + 7 * i);
      packets.set(create::Packet::kOiMode, i < 20 ? 1 : 2);
      Bytes frame;
      create::append_stream_frame(ids, packets, frame);
      stream.push_back(static_cast<std::uint8_t>(frame.size()));
      stream.insert(stream.end(), frame.begin(), frame.end());
    }
    corpus.add(stream);
  }
  corpus.add("\x02\x14Roomba by iRobot!\r\n\x1c.release-stm32-3.7.7:6913\r\n");
}

/// What a map file has between its header and its checksum.
void map_seeds(Corpus corpus) {
  for (const std::size_t count : {1U, 9U}) {
    ekf::MapSnapshot map;
    map.calibration_covariance = 1e-4 * Eigen::Matrix3d::Identity();
    for (std::size_t l = 0; l < count; ++l) {
      map.landmarks.push_back({.map_id = map.next_map_id++, .times_seen = 3});
      const auto place = static_cast<double>(l);
      map.positions_m.emplace_back(place, 0.3 * place * place);
    }
    for (std::size_t i = 0; i < 2 * count; ++i) {
      map.covariance_m2.push_back(0.01);
      map.covariance_m2.insert(map.covariance_m2.end(), 2 * count - i - 1, 0.001);
    }
    const Bytes file = ekf::encode_map(map);
    corpus.add(Bytes(file.begin() + 16, file.end() - 4));
  }
}

/// Which channel, length and bytes, as fuzz_landmark_service reads them.
template <class Message>
void append(std::uint8_t channel, const Message& message, Bytes& run) {
  Bytes bytes;
  encode(message, bytes);
  run.insert(run.end(), {channel, static_cast<std::uint8_t>(bytes.size()),
                         static_cast<std::uint8_t>(bytes.size() >> 8)});
  run.insert(run.end(), bytes.begin(), bytes.end());
}

void landmark_seeds(Corpus corpus) {
  Bytes run;
  for (int step = 1; step <= 3; ++step) {
    odometry_t odometry{};
    odometry.utime = 100'000 * step;
    odometry.interval_us = 100'000;
    append(1, odometry, run);
    kinect_frame_t frame = frame_message(kinect_frame_t::DEPTH_PDZ16, kinect_frame_t::COLOR_RGB8);
    frame.utime = odometry.utime;
    append(0, frame, run);
    corpus.add(run);
  }
}

void make_seeds(const std::filesystem::path& folder) {
  depth_codec_seeds(Corpus(folder / "fuzz_depth_codec"));
  frame_seeds(Corpus(folder / "fuzz_frame_decoder"));
  wire_seeds(Corpus(folder / "fuzz_wire"), AllMessages{});
  landmark_seeds(Corpus(folder / "fuzz_landmark_service"));
  params_seeds(Corpus(folder / "fuzz_params"));
  serial_seeds(Corpus(folder / "fuzz_oi_decoder"));
  create_seeds(Corpus(folder / "fuzz_create_emulator"));
  scenario_seeds(Corpus(folder / "fuzz_scenario"));
  map_seeds(Corpus(folder / "fuzz_map_file"));
  log_seeds(Corpus(folder / "fuzz_log_reader"), folder / "seed.lcmlog");
}

}  // namespace
}  // namespace roomwise

int main(int argc, char** argv) try {
  if (argc != 2) throw std::runtime_error("usage: make_seeds FOLDER");
  roomwise::make_seeds(argv[1]);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "make_seeds: %s\n", error.what());
  return 1;
}
