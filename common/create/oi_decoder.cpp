#include "common/create/oi_decoder.h"

#include <numeric>
#include <stdexcept>
#include <string>

namespace roomwise::create {
namespace {

constexpr std::int16_t kAny = -1;
constexpr int kFailuresToSwitch = 20;

std::uint8_t sum_of(std::span<const std::uint8_t> bytes) {
  return static_cast<std::uint8_t>(std::accumulate(bytes.begin(), bytes.end(), 0U));
}

std::vector<std::int16_t> shape_of(std::span<const std::uint8_t> ids) {
  std::vector<std::int16_t> shape{kStreamHeader, 0};
  for (const std::uint8_t id : ids) {
    if (packet_size(id) == 0) {
      throw std::invalid_argument("OiDecoder: no sensor packet " + std::to_string(id));
    }
    shape.push_back(id);
    shape.insert(shape.end(), packet_size(id), kAny);
  }
  const std::size_t length = shape.size() - 2;
  if (length == 0 || length > 255) throw std::invalid_argument("OiDecoder: frame length");
  shape[1] = static_cast<std::int16_t>(length);
  shape.push_back(kAny);
  return shape;
}

}  // namespace

OiDecoder::OiDecoder(std::span<const std::uint8_t> ids)
    : ids_(ids.begin(), ids.end()), shape_(shape_of(ids)) {
  candidate_.reserve(shape_.size());
}

void OiDecoder::restart() {
  candidate_.clear();
  frame_.gap_size = 0;
}

void OiDecoder::push(std::span<const std::uint8_t> bytes,
                     const std::function<void(const StreamFrame&)>& on_frame) {
  for (const std::uint8_t byte : bytes) {
    candidate_.push_back(byte);
    if (!fits(candidate_.size() - 1)) shed_to_next_start();
    if (candidate_.size() == shape_.size()) judge_frame(on_frame);
  }
}

bool OiDecoder::fits(std::size_t place) const {
  return shape_[place] == kAny || shape_[place] == candidate_[place];
}

bool OiDecoder::could_be_frame() const {
  for (std::size_t i = 0; i < candidate_.size(); ++i) {
    if (!fits(i)) return false;
  }
  return true;
}

void OiDecoder::shed_to_next_start() {
  do {
    shed_byte();
  } while (!could_be_frame());
}

void OiDecoder::shed_byte() {
  const std::uint8_t byte = candidate_.front();
  candidate_.erase(candidate_.begin());
  if (frame_.gap_size < StreamFrame::kGapKept) frame_.gap_bytes[frame_.gap_size] = byte;
  ++frame_.gap_size;
  ++counts_.bytes_skipped;
  boot_text_.accept(byte);
}

void OiDecoder::judge_frame(const std::function<void(const StreamFrame&)>& on_frame) {
  const std::uint8_t sum = sum_of(candidate_);
  const bool with_header = sum == 0;
  const bool without_header = sum == kStreamHeader;
  const bool wants_header = reading_ == ChecksumReading::kWithHeader;
  if (wants_header ? with_header : without_header) return emit(on_frame);
  ++counts_.checksum_failures;
  note_checksum(wants_header ? without_header : with_header);
  shed_to_next_start();
}

void OiDecoder::note_checksum(bool passes_other) {
  passing_only_other_ = passes_other ? passing_only_other_ + 1 : 0;
  if (passing_only_other_ < kFailuresToSwitch) return;
  reading_ = reading_ == ChecksumReading::kWithHeader ? ChecksumReading::kWithoutHeader
                                                      : ChecksumReading::kWithHeader;
  passing_only_other_ = 0;
  ++counts_.checksum_switches;
}

void OiDecoder::emit(const std::function<void(const StreamFrame&)>& on_frame) {
  std::span<const std::uint8_t> rest(candidate_);
  rest = rest.subspan(2);
  for (const std::uint8_t id : ids_) {
    const std::size_t size = packet_size(id);
    if (!read_packets(id, rest.subspan(1, size), frame_.packets)) {
      throw std::logic_error("OiDecoder: shape and packets disagree");
    }
    rest = rest.subspan(1 + size);
  }
  passing_only_other_ = 0;
  ++counts_.frames;
  on_frame(frame_);
  frame_.gap_size = 0;
  candidate_.clear();
}

}  // namespace roomwise::create
