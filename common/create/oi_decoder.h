#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "common/create/boot_text.h"
#include "common/create/sensor_packets.h"

namespace roomwise::create {

/// Which bytes of a stream frame sum to 0 modulo 256. The manuals disagree.
enum class ChecksumReading : std::uint8_t {
  kWithHeader,     ///< header to checksum: Create 2 manual, and Create 1 robots as they are
  kWithoutHeader,  ///< length to checksum: Create 1 manual of 2006
};

/// One stream frame, and the bytes that came between it and the frame before.
struct StreamFrame {
  static constexpr std::size_t kGapKept = 16;

  SensorPackets packets;
  std::array<std::uint8_t, kGapKept> gap_bytes{};  ///< the first of them
  std::size_t gap_size = 0;                        ///< how many there were
};

/// What the decoder has seen since it was made.
struct DecoderCounts {
  std::int64_t frames = 0;
  std::int64_t bytes_skipped = 0;      ///< bytes of no frame
  std::int64_t checksum_failures = 0;  ///< frames of the right shape whose sum is wrong
  std::int64_t checksum_switches = 0;  ///< times the other reading of the checksum was taken up
};

/// Finds the frames of one stream in the bytes of a serial line, whatever lies between them: boot
/// text, answers to queries, frames cut or damaged, noise. The frames found depend on the bytes
/// alone, not on how they are split into calls.
///
/// A frame is known by its header, its length and every packet number in its place, so that a 19 in
/// the data does not pass for a header; then by its checksum. 20 frames in a row that fail the
/// reading in force and pass the other make it change over.
class OiDecoder {
 public:
  /// `ids`: what the stream was asked for, in that order. Throws std::invalid_argument if the
  /// manual does not know one, or a frame would be longer than its length byte can say.
  explicit OiDecoder(std::span<const std::uint8_t> ids);

  /// Calls `on_frame` for each frame that `bytes` completes.
  void push(std::span<const std::uint8_t> bytes,
            const std::function<void(const StreamFrame&)>& on_frame);

  /// Forgets a frame begun: what comes next has nothing to do with what came before.
  void restart();

  const DecoderCounts& counts() const { return counts_; }
  ChecksumReading checksum_reading() const { return reading_; }
  const BootTextReader& boot_text() const { return boot_text_; }

 private:
  bool fits(std::size_t place) const;
  bool could_be_frame() const;
  void shed_byte();
  void shed_to_next_start();
  void judge_frame(const std::function<void(const StreamFrame&)>& on_frame);
  void note_checksum(bool passes_other);
  void emit(const std::function<void(const StreamFrame&)>& on_frame);

  std::vector<std::uint8_t> ids_;
  std::vector<std::int16_t> shape_;  // byte each place of a frame must hold; kAny: data or checksum
  std::vector<std::uint8_t> candidate_;  // begins like a frame, shorter than one
  StreamFrame frame_;                    // its gap grows while bytes are shed
  ChecksumReading reading_ = ChecksumReading::kWithHeader;
  int passing_only_other_ = 0;
  DecoderCounts counts_;
  BootTextReader boot_text_;
};

}  // namespace roomwise::create
