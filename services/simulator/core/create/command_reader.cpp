#include "services/simulator/core/create/command_reader.h"

#include <algorithm>
#include <array>

namespace roomwise::simulator {
namespace {

enum class Models { kBoth, kOnly1, kOnly2 };
enum class Modes { kAny, kPassive, kNotOff, kSafeOrFull };

struct Opcode {
  std::uint8_t opcode;
  std::size_t arguments;  ///< before any that are counted
  Modes modes;
  Models models = Models::kBoth;
  std::size_t bytes_per_count = 0;  ///< the last of `arguments` counts more, each so long
};

constexpr std::array kOpcodes = {
    Opcode{op::kReset, 0, Modes::kAny, Models::kOnly2},
    Opcode{op::kStart, 0, Modes::kAny},
    Opcode{op::kBaud, 1, Modes::kNotOff},
    Opcode{op::kControl, 0, Modes::kPassive},
    Opcode{op::kSafe, 0, Modes::kNotOff},
    Opcode{op::kFull, 0, Modes::kNotOff},
    Opcode{op::kPower, 0, Modes::kNotOff},
    Opcode{op::kSpot, 0, Modes::kNotOff},
    Opcode{op::kClean, 0, Modes::kNotOff},
    Opcode{op::kMax, 0, Modes::kNotOff, Models::kOnly2},
    Opcode{op::kMax, 1, Modes::kNotOff, Models::kOnly1},
    Opcode{op::kDrive, 4, Modes::kSafeOrFull},
    Opcode{op::kMotors, 1, Modes::kSafeOrFull},
    Opcode{op::kLeds, 3, Modes::kSafeOrFull},
    Opcode{op::kSong, 2, Modes::kNotOff, Models::kBoth, 2},
    Opcode{op::kPlay, 1, Modes::kSafeOrFull},
    Opcode{op::kSensors, 1, Modes::kNotOff},
    Opcode{op::kSeekDock, 0, Modes::kNotOff},
    Opcode{op::kPwmMotors, 3, Modes::kSafeOrFull},
    Opcode{op::kDriveDirect, 4, Modes::kSafeOrFull},
    Opcode{op::kDrivePwm, 4, Modes::kSafeOrFull, Models::kOnly2},
    Opcode{op::kDigitalOutputs, 1, Modes::kSafeOrFull, Models::kOnly1},
    Opcode{op::kStream, 1, Modes::kNotOff, Models::kBoth, 1},
    Opcode{op::kQueryList, 1, Modes::kNotOff, Models::kBoth, 1},
    Opcode{op::kPauseResume, 1, Modes::kNotOff},
    Opcode{op::kSendIr, 1, Modes::kSafeOrFull, Models::kOnly1},
    Opcode{op::kScript, 1, Modes::kNotOff, Models::kOnly1, 1},
    Opcode{op::kPlayScript, 0, Modes::kNotOff, Models::kOnly1},
    Opcode{op::kShowScript, 0, Modes::kNotOff, Models::kOnly1},
    Opcode{op::kWaitTime, 1, Modes::kNotOff, Models::kOnly1},
    Opcode{op::kWaitDistance, 2, Modes::kNotOff, Models::kOnly1},
    Opcode{op::kWaitAngle, 2, Modes::kNotOff, Models::kOnly1},
    Opcode{op::kWaitEvent, 1, Modes::kNotOff, Models::kOnly1},
    Opcode{op::kSchedulingLeds, 2, Modes::kSafeOrFull, Models::kOnly2},
    Opcode{op::kDigitLedsRaw, 4, Modes::kSafeOrFull, Models::kOnly2},
    Opcode{op::kDigitLedsAscii, 4, Modes::kSafeOrFull, Models::kOnly2},
    Opcode{op::kButtons, 1, Modes::kNotOff, Models::kOnly2},
    Opcode{op::kSchedule, 15, Modes::kNotOff, Models::kOnly2},
    Opcode{op::kSetClock, 3, Modes::kNotOff, Models::kOnly2},
    Opcode{op::kStop, 0, Modes::kNotOff, Models::kOnly2},
};

const Opcode* find(CreateModel model, std::uint8_t opcode) {
  const Models other = model == CreateModel::kCreate1 ? Models::kOnly2 : Models::kOnly1;
  const auto found = std::find_if(kOpcodes.begin(), kOpcodes.end(), [&](const Opcode& candidate) {
    return candidate.opcode == opcode && candidate.models != other;
  });
  return found == kOpcodes.end() ? nullptr : &*found;
}

}  // namespace

bool CommandReader::push(std::uint8_t byte) {
  if (complete_) {
    command_.opcode = byte;
    command_.arguments.clear();
  } else {
    command_.arguments.push_back(byte);
  }
  complete_ = command_.arguments.size() == length_so_far();
  return complete_;
}

/// How many arguments the command has, as far as those received tell.
std::size_t CommandReader::length_so_far() const {
  const Opcode* opcode = find(model_, command_.opcode);
  if (opcode == nullptr) return 0;
  const bool counts = opcode->bytes_per_count > 0 && command_.arguments.size() >= opcode->arguments;
  const std::size_t count = counts ? command_.arguments[opcode->arguments - 1] : 0;
  return opcode->arguments + count * opcode->bytes_per_count;
}

bool has_opcode(CreateModel model, std::uint8_t opcode) { return find(model, opcode) != nullptr; }

bool accepts(CreateModel model, OiMode mode, std::uint8_t opcode) {
  const Opcode* known = find(model, opcode);
  if (known == nullptr) return false;
  switch (known->modes) {
    case Modes::kAny:
      return true;
    case Modes::kPassive:
      return mode == OiMode::kPassive;
    case Modes::kNotOff:
      return mode != OiMode::kOff;
    case Modes::kSafeOrFull:
      return mode == OiMode::kSafe || mode == OiMode::kFull;
  }
  return false;
}

}  // namespace roomwise::simulator
