#include "services/simulator/core/create/oi_script.h"

#include <algorithm>
#include <cstdlib>

namespace roomwise::simulator {
namespace {

constexpr std::size_t kLongest = 100;

/// Events of opcode 158, as the Create's manual of 2006 numbers them.
bool has_event(int event, const BodyReadings& body, OiMode mode) {
  switch (event) {
    case 1:
      return body.any_wheel_drop();
    case 2:
      return body.caster_drop;
    case 3:
      return body.wheel_drop.left;
    case 4:
      return body.wheel_drop.right;
    case 5:
      return body.bump.left || body.bump.right;
    case 6:
      return body.bump.left;
    case 7:
      return body.bump.right;
    case 8:
      return body.virtual_wall;
    case 9:
      return body.wall;
    case 10:
      return body.any_cliff();
    case 15:
      return body.home_base;
    case 22:
      return mode == OiMode::kPassive;
    default:
      return event >= 11 && event <= 14 && body.cliff[static_cast<std::size_t>(event - 11)];
  }
}

bool has_gone(double way, int wanted) { return wanted >= 0 ? way >= wanted : way <= wanted; }

bool is_over(const OiCommand& wait, const WaitInputs& since, const WaitInputs& inputs,
             const BodyReadings& body) {
  switch (wait.opcode) {
    case op::kWaitTime:
      return inputs.now - since.now >= wait.arguments[0] * std::chrono::milliseconds(100);
    case op::kWaitDistance:
      return has_gone(inputs.distance_mm - since.distance_mm, wait.word(0));
    case op::kWaitAngle:
      return has_gone(inputs.angle_deg - since.angle_deg, wait.word(0));
    default: {  // a negative event waits for its end
      const int byte = wait.arguments[0];
      const int event = byte < 128 ? byte : byte - 256;
      return has_event(std::abs(event), body, inputs.mode) == (event > 0);
    }
  }
}

}  // namespace

void OiScript::store(const std::vector<std::uint8_t>& bytes) {
  stored_.assign(bytes.begin(),
                 bytes.begin() + static_cast<std::ptrdiff_t>(std::min(bytes.size(), kLongest)));
}

void OiScript::clear() { *this = OiScript(); }

void OiScript::wait(const OiCommand& command, const WaitInputs& inputs) {
  wait_ = Wait{command, inputs};
}

void OiScript::update(const WaitInputs& inputs, const BodyReadings& body) {
  if (wait_ && is_over(wait_->command, wait_->since, inputs, body)) wait_.reset();
}

std::optional<std::uint8_t> OiScript::next_byte() {
  if (wait_ || pending_.empty()) return std::nullopt;
  const std::uint8_t byte = pending_.front();
  pending_.pop_front();
  return byte;
}

}  // namespace roomwise::simulator
