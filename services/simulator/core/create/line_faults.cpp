#include "services/simulator/core/create/line_faults.h"

#include <algorithm>

namespace roomwise::simulator {
namespace {

constexpr std::uint8_t kFlipped = 0x10;

bool spoils_frames(const Fault& fault) {
  return fault.kind == FaultKind::kByteLoss || fault.kind == FaultKind::kByteFlip ||
         fault.kind == FaultKind::kDuplicateFrame || fault.kind == FaultKind::kWrongLength;
}

void spoil_frame(const Fault& fault, std::vector<std::uint8_t>& bytes) {
  const std::size_t at = std::min(fault.at_byte.value_or(bytes.size() / 2), bytes.size() - 1);
  switch (fault.kind) {
    case FaultKind::kByteLoss:
      bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(at));
      return;
    case FaultKind::kByteFlip:
      bytes[at] ^= kFlipped;
      return;
    case FaultKind::kDuplicateFrame: {
      const std::vector<std::uint8_t> again = bytes;
      bytes.insert(bytes.end(), again.begin(), again.end());
      return;
    }
    default:
      ++bytes[1];
  }
}

}  // namespace

LineFaults::LineFaults(const std::vector<Fault>& faults) {
  std::copy_if(faults.begin(), faults.end(), std::back_inserter(waiting_), spoils_frames);
}

void LineFaults::spoil(Duration now, std::vector<Transmission>& transmissions) {
  for (Transmission& transmission : transmissions) {
    if (!transmission.is_frame || transmission.bytes.size() < 2) continue;
    const auto due = std::find_if(waiting_.begin(), waiting_.end(), [&](const Fault& fault) {
      return fault.count > 0 && now >= fault.at;
    });
    if (due == waiting_.end()) return;
    spoil_frame(*due, transmission.bytes);
    --due->count;
  }
}

}  // namespace roomwise::simulator
