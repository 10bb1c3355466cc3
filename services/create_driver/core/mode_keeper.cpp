#include "services/create_driver/core/mode_keeper.h"

#include <chrono>

namespace roomwise::create {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Duration kModeSpacing = milliseconds(20);  // after a mode command nothing else is sent
constexpr Duration kAfterStart = milliseconds(60);
constexpr Duration kStreamPatience = milliseconds(300);
constexpr Duration kStreamSettles =
    milliseconds(60);  // what was on its way before Start is through
constexpr Duration kWakePulse =
    milliseconds(1000);  // 50 to 500 ms, three times, would set the baud
constexpr Duration kAfterWake = milliseconds(500);
constexpr Duration kAfterBootText = milliseconds(500);
constexpr Duration kAfterDrop = milliseconds(500);
constexpr Duration kEntryPatience = milliseconds(500);
constexpr Duration kStreamLost = milliseconds(500);
constexpr Duration kBetweenResets = seconds(10);
constexpr Duration kBootPatience = seconds(6);
constexpr int kMostRefusals = 3;
constexpr int kStartsBeforeWaking = 3;  // a byte may have got lost

constexpr int kWheelDropBits = 0x1C;  // right, left, caster of a Create 1
constexpr int kChargerBit = 1;
constexpr int kHomeBaseBit = 2;

bool sees_cliff(const SensorPackets& packets) {
  return packets[Packet::kCliffLeft] != 0 || packets[Packet::kCliffFrontLeft] != 0 ||
         packets[Packet::kCliffFrontRight] != 0 || packets[Packet::kCliffRight] != 0;
}

}  // namespace

ModeKeeper::ModeKeeper(Model model, OiMode target, std::vector<std::uint8_t> ids)
    : model_(model), target_(target), ids_(std::move(ids)) {}

void ModeKeeper::enter(Phase phase, Duration until) {
  phase_ = phase;
  until_ = until;
}

void ModeKeeper::begin(Duration now) { enter(Phase::kStopping, now); }

void ModeKeeper::robot_boots(Duration now) { enter(Phase::kBooting, now + kAfterBootText); }

void ModeKeeper::see(Duration now, const SensorPackets& packets) {
  packets_ = packets;
  mode_ = reading_.mode(packets[Packet::kOiMode]);
  last_frame_ = now;
  has_frame_ = true;
}

void ModeKeeper::step(Duration now, Wish wish, DriverCounts& counts, Bytes& bytes) {
  if (stream_is_silent(now)) {
    counts.add(DriverEvent::kRobotSilent);
    append_drive({}, bytes);
    begin(now);
  }
  switch (phase_) {
    case Phase::kStopping:
      return start(now, bytes);
    case Phase::kStarting:
      return ask_for_stream(now, bytes);
    case Phase::kAsking:
      return look_for_passive(now, counts, bytes);
    case Phase::kWaking:
      if (now >= until_ + kAfterWake) begin(now);
      return;
    case Phase::kBooting:
      if (now >= until_) begin(now);
      return;
    case Phase::kResting:
      return rest(now, wish, bytes);
    case Phase::kEntering:
      return check_entry(now, counts);
    case Phase::kDriving:
      return check_mode(now, counts, bytes);
  }
}

void ModeKeeper::start(Duration now, Bytes& bytes) {
  bytes.insert(bytes.end(), kStopAndRest.begin(), kStopAndRest.end());
  enter(Phase::kStarting, now + kAfterStart);
}

void ModeKeeper::ask_for_stream(Duration now, Bytes& bytes) {
  if (now < until_) return;
  append_stream_request(ids_, bytes);
  has_frame_ = false;
  refusals_ = 0;
  ++starts_;
  asked_ = now;
  enter(Phase::kAsking, now + kStreamPatience);
}

void ModeKeeper::look_for_passive(Duration now, DriverCounts& counts, Bytes& bytes) {
  const bool has_settled = has_frame_ && now >= asked_ + kStreamSettles;
  const int byte = packets_[Packet::kOiMode];
  // Safe, because Start got lost, or Passive plus one? A second Start tells.
  const bool is_doubtful = byte == 2 && starts_ == 1;
  if (has_settled && is_doubtful) return begin(now);
  if (has_settled && reading_.learn_in_passive(byte)) {
    if (reading_.is_offset()) counts.add(DriverEvent::kModeByteOffset);
    mode_ = OiMode::kPassive;
    starts_ = 0;
    return enter(Phase::kResting, now);
  }
  if (now >= until_) give_up_asking(now, counts, bytes);
}

void ModeKeeper::give_up_asking(Duration now, DriverCounts& counts, Bytes& bytes) {
  if (has_frame_ && mode_ == OiMode::kUnknown) return leave_unknown_mode(now, counts, bytes);
  if (starts_ < kStartsBeforeWaking) return begin(now);
  starts_ = 0;
  counts.add(has_frame_ ? DriverEvent::kModeRefused : DriverEvent::kRobotSilent);
  enter(Phase::kWaking, now + kWakePulse);
}

void ModeKeeper::rest(Duration now, Wish wish, Bytes& bytes) {
  if (mode_ == OiMode::kOff) return begin(now);
  if (now < until_ || is_kept_from_driving(wish)) return;
  append_command(target_ == OiMode::kFull ? Opcode::kFull : Opcode::kSafe, bytes);
  asked_ = now;
  enter(Phase::kEntering, now + kEntryPatience);
}

bool ModeKeeper::is_kept_from_driving(Wish wish) const {
  const int sources = packets_[Packet::kChargingSources];
  const bool is_lifted = (packets_[Packet::kBumpsAndDrops] & kWheelDropBits) != 0;
  const bool is_plugged_in = (sources & kChargerBit) != 0;
  const bool is_at_home = (sources & kHomeBaseBit) != 0;
  return is_lifted || is_plugged_in || (is_at_home && wish == Wish::kStand) ||
         (sees_cliff(packets_) && wish == Wish::kForward);
}

void ModeKeeper::check_entry(Duration now, DriverCounts& counts) {
  if (now >= asked_ + kModeSpacing && mode_ == target_) {
    refusals_ = 0;
    return enter(Phase::kDriving, now);
  }
  if (now < until_) return;
  counts.add(DriverEvent::kModeRefused);
  ++refusals_;
  if (refusals_ >= kMostRefusals || reading_.is_offset()) return begin(now);
  enter(Phase::kResting, now + kAfterDrop);
}

void ModeKeeper::check_mode(Duration now, DriverCounts& counts, Bytes& bytes) {
  if (mode_ == target_) return;
  ++mode_drops_;
  counts.add(DriverEvent::kModeDropped);
  append_drive({}, bytes);
  if (mode_ == OiMode::kUnknown) return leave_unknown_mode(now, counts, bytes);
  if (mode_ == OiMode::kOff) return begin(now);
  enter(Phase::kResting, now + kAfterDrop);
}

void ModeKeeper::leave_unknown_mode(Duration now, DriverCounts& counts, Bytes& bytes) {
  counts.add(DriverEvent::kModeUnknown);
  const bool may_reset = !has_reset_ || now >= last_reset_ + kBetweenResets;
  if (model_ != Model::kCreate2 || !may_reset) {
    return enter(Phase::kWaking, now + kWakePulse);
  }
  append_command(Opcode::kReset, bytes);
  counts.add(DriverEvent::kRobotReset);
  has_reset_ = true;
  last_reset_ = now;
  enter(Phase::kBooting, now + kBootPatience);
}

bool ModeKeeper::stream_is_silent(Duration now) const {
  const bool should_run =
      phase_ == Phase::kResting || phase_ == Phase::kEntering || phase_ == Phase::kDriving;
  return should_run && now - last_frame_ > kStreamLost;
}

bool ModeKeeper::line_is_free(Duration now) const {
  if (phase_ == Phase::kDriving || phase_ == Phase::kResting) return true;
  return phase_ == Phase::kEntering && now >= asked_ + kModeSpacing;
}

}  // namespace roomwise::create
