// What a frame costs kinect_pub: copying it out of OpenNI2's memory is left out, making the message
// of it is what there is. PDZ16 + JPEG beside what it would cost to send the images as they are.
#include <benchmark/benchmark.h>

#include <string>

#include "services/kinect_pub/frame_worker.h"
#include "tests/kinect_pub/support/made_frames.h"

namespace roomwise {
namespace {

CapturedFrame captured(std::int64_t number, int width_px) {
  const RgbdFrame made = made_frame(number, {width_px, width_px, true});
  CapturedFrame frame;
  frame.depth = made.depth;
  frame.color = made.color;
  return frame;
}

void to_message(benchmark::State& state, int width_px, const kinect::KinectParams& params) {
  std::vector<CapturedFrame> frames;
  for (int i = 0; i < 8; ++i) frames.push_back(captured(i, width_px));
  FrameToMessage converter(params);
  kinect_frame_t message{};
  std::size_t next = 0;
  for (auto _ : state) {
    converter.convert(frames[next++ % frames.size()], message);
    benchmark::DoNotOptimize(message.depth_data.data());
  }
  state.counters["bytes"] = static_cast<double>(message.depth_size + message.color_size);
}

void add(int width_px, const std::string& depth_encoding, const std::string& color_encoding) {
  kinect::KinectParams params;
  params.depth_encoding = depth_encoding;
  params.color_encoding = color_encoding;
  const std::string name = std::to_string(width_px) + "px/" + depth_encoding + "+" + color_encoding;
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
    to_message(state, width_px, params);
  })->Unit(benchmark::kMillisecond);
}

}  // namespace
}  // namespace roomwise

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  for (const int width_px : {640, 320}) {
    roomwise::add(width_px, "pdz16", "jpeg");
    roomwise::add(width_px, "raw16", "jpeg");
    roomwise::add(width_px, "raw16", "rgb8");
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
