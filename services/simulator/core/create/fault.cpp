#include "services/simulator/core/create/fault.h"

#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string>

namespace roomwise::simulator {
namespace {

struct Kind {
  std::string_view name;
  FaultKind kind;
  double usual_s;  ///< how long it lasts unless said
};

constexpr std::array kKinds = {
    Kind{"byte_loss", FaultKind::kByteLoss, 0.0},
    Kind{"byte_flip", FaultKind::kByteFlip, 0.0},
    Kind{"duplicate_frame", FaultKind::kDuplicateFrame, 0.0},
    Kind{"wrong_length", FaultKind::kWrongLength, 0.0},
    Kind{"silence", FaultKind::kSilence, 0.3},
    Kind{"hang_up", FaultKind::kHangUp, 0.5},
    Kind{"camera_unplug", FaultKind::kCameraUnplug, 2.0},
    Kind{"reboot", FaultKind::kReboot, 0.0},
    Kind{"mode_drop", FaultKind::kModeDrop, 0.0},
    Kind{"mode_32", FaultKind::kMode32, 0.0},
    Kind{"power_button", FaultKind::kPowerButton, 0.0},
    Kind{"rollover_forward", FaultKind::kRolloverForward, 0.0},
    Kind{"rollover_backward", FaultKind::kRolloverBackward, 0.0},
    Kind{"battery_low", FaultKind::kBatteryLow, 0.0},
    Kind{"encoder_stuck", FaultKind::kEncoderStuck, 2.0},
    Kind{"nineteen_in_data", FaultKind::kNineteenInData, 1.0},
    Kind{"charger", FaultKind::kCharger, 2.0},
    Kind{"bump", FaultKind::kBump, 1.0},
    Kind{"wheel_drop", FaultKind::kWheelDrop, 1.0},
    Kind{"cliff", FaultKind::kCliff, 1.0},
};

[[noreturn]] void refuse(std::string_view text, const std::string& what) {
  throw std::runtime_error("fault \"" + std::string(text) + "\": " + what);
}

std::string names_of_kinds() {
  std::string names;
  for (const Kind& kind : kKinds) names += (names.empty() ? "" : ", ") + std::string(kind.name);
  return names;
}

template <class Number>
Number number_in(std::string_view text, std::string_view value, Number smallest, Number largest) {
  Number number{};
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  const bool whole = error == std::errc() && end == value.data() + value.size();
  if (!whole || !(number >= smallest && number <= largest)) {
    refuse(text, "\"" + std::string(value) + "\" must be a number in [" + std::to_string(smallest) +
                     ", " + std::to_string(largest) + "]");
  }
  return number;
}

Duration duration_in(std::string_view text, std::string_view value) {
  const double duration_s = number_in(text, value, 0.0, 1e6);
  return Duration(std::llround(duration_s * 1e6));
}

LeftRight<bool> sides_in(std::string_view text, std::string_view value) {
  if (value == "left") return {true, false};
  if (value == "right") return {false, true};
  if (value != "both") refuse(text, "side must be left, right or both");
  return {true, true};
}

const Kind& kind_in(std::string_view text, std::string_view value) {
  for (const Kind& kind : kKinds) {
    if (kind.name == value) return kind;
  }
  refuse(text, "kind must be one of " + names_of_kinds());
}

/// What the text says, key by key.
struct Reading {
  Fault fault;
  const Kind* kind = nullptr;
  bool has_time = false;
  bool has_duration = false;
};

void read_entry(std::string_view text, std::string_view key, std::string_view value,
                Reading& reading) {
  if (key == "kind") {
    reading.kind = &kind_in(text, value);
  } else if (key == "at_s") {
    reading.fault.at = duration_in(text, value);
    reading.has_time = true;
  } else if (key == "for_s") {
    reading.fault.lasting = duration_in(text, value);
    reading.has_duration = true;
  } else if (key == "side") {
    reading.fault.sides = sides_in(text, value);
  } else if (key == "count") {
    reading.fault.count = number_in(text, value, 1, 1'000'000);
  } else if (key == "byte") {
    reading.fault.at_byte = static_cast<std::size_t>(number_in(text, value, 0, 255));
  } else {
    refuse(text,
           "\"" + std::string(key) + "\" must be one of at_s, kind, for_s, side, count, byte");
  }
}

}  // namespace

Fault parse_fault(std::string_view text) {
  Reading reading;
  for (std::string_view rest = text; !rest.empty();) {
    const std::string_view entry = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(rest.size(), entry.size() + 1));
    const std::size_t equals = entry.find('=');
    if (equals == std::string_view::npos) refuse(text, "entries must be key=value");
    read_entry(text, entry.substr(0, equals), entry.substr(equals + 1), reading);
  }
  if (!reading.has_time || reading.kind == nullptr) refuse(text, "must have at_s and kind");
  reading.fault.kind = reading.kind->kind;
  if (!reading.has_duration) {
    reading.fault.lasting = Duration(static_cast<std::int64_t>(reading.kind->usual_s * 1e6));
  }
  return reading.fault;
}

}  // namespace roomwise::simulator
