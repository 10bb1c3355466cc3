// The emulated Create on any bytes from its host: it keeps to its speeds, and every stream frame
// it sends whole has its length and its sum right.
// Input: model and quirks (1), kind of fault (1), then the host's bytes, eight every 5 ms.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "services/simulator/core/create/simulated_create.h"

namespace {

using namespace roomwise;
using namespace roomwise::simulator;

constexpr int kStepsPerRound = 5;
constexpr std::size_t kBytesPerRound = 8;
constexpr std::size_t kMostBytes = 512;

void require(bool holds) {
  if (!holds) __builtin_trap();
}

OpenInterfaceParams params_of(std::uint8_t choices) {
  OpenInterfaceParams params;
  if (choices & 1U) params.model = "create1";
  if (choices & 2U) params.odometry_rounding = "carry";
  if (choices & 4U) params.locks_after_trip = true;
  if (choices & 8U) params.mode_settle_s = 0.02;
  params.boot_s = 0.2;
  params.sleep_after_s = 1.0;
  return params;
}

/// What is sent in one slot is whole if its length is as it says and it does not fill the slot: a
/// frame cut where its slot ends may chance to be as long as its length byte, modulo 256, says.
void require_sum_of_whole_frame(const Transmission& sent, std::size_t slot_bytes) {
  if (!sent.is_frame || sent.bytes.size() >= slot_bytes) return;
  require(sent.bytes.size() == sent.bytes[1] + 3U);
  unsigned sum = 0;
  for (const std::uint8_t part : sent.bytes) sum += part;
  require((sum & 0xFFU) == 0);
}

/// The bytes straight into the firmware, without a line.
void fuzz_interface(const OpenInterfaceParams& params, std::span<const std::uint8_t> bytes) {
  OpenInterface interface(params);
  BodyReadings readings;
  Duration now{};
  for (const std::uint8_t byte : bytes) {
    now += Duration(3'000);
    interface.step(now);
    interface.receive(byte);
    readings.turned_m.left += 1e-4 * byte;
    readings.bump.left = byte == 200;
    readings.wheel_drop.right = byte == 201;
    if (byte % 5 == 0) interface.sense(readings);
    const LeftRight<double> wheels = interface.wheel_command_mps();
    require(std::abs(wheels.left) <= 0.5 + 1e-9 && std::abs(wheels.right) <= 0.5 + 1e-9);
    require(interface.mode() != OiMode::kOff || wheels == LeftRight<double>{});
    for (const Transmission& sent : interface.take_transmissions()) {
      require_sum_of_whole_frame(sent, interface.bytes_per_slot());
    }
  }
}

/// And through the whole robot, in a room with a hole, with something going wrong.
void fuzz_robot(const OpenInterfaceParams& params, std::uint8_t fault,
                std::span<const std::uint8_t> bytes) {
  SimulatedCreate::Setup setup;
  setup.interface = params;
  setup.faults = {{.kind = static_cast<FaultKind>(fault % 19),
                   .at = Duration(50'000),
                   .lasting = Duration(100'000),
                   .sides = {true, (fault & 1U) != 0},
                   .count = 3,
                   .at_byte = {}}};
  SimulatedCreate create(setup);
  const GroundPlan plan{.walls = {{{0.3, -1.0}, {0.3, 1.0}}},
                        .discs = {},
                        .holes = {{{{-2.0, -1.0}, {-0.3, -1.0}, {-0.3, 1.0}, {-2.0, 1.0}}}}};
  std::vector<std::uint8_t> to_host;
  for (std::size_t i = 0; i < bytes.size(); i += kBytesPerRound) {
    create.receive(bytes.subspan(i, std::min(kBytesPerRound, bytes.size() - i)));
    for (int step = 0; step < kStepsPerRound; ++step) create.step(plan, to_host);
    require(create.motion().pose().x_m < 0.3 - 0.17 + 1e-6);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  const OpenInterfaceParams params = params_of(data[0]);
  const std::span bytes(data + 2, std::min(size - 2, kMostBytes));
  fuzz_interface(params, bytes);
  fuzz_robot(params, data[1], bytes);
  return 0;
}
