#include <cstring>
#include <optional>

#include "common/image/depth_codec.h"
#include "common/image/depth_model.h"
#include "common/image/rans.h"

namespace roomwise {
namespace {

using namespace pdz16;
using Bytes = std::span<const std::uint8_t>;

/// A token's share of a context's table.
struct Share {
  std::uint16_t frequency;
  std::uint16_t start;
};

struct Lane {
  rans::Decoder coder;
  Row above;
  Row row;
  std::uint16_t* out = nullptr;  ///< the row's indices, 0 for holes
};

std::optional<std::size_t> read_varint(Bytes& bytes) {
  std::size_t value = 0;
  for (int shift = 0; shift <= 28; shift += 7) {
    if (bytes.empty()) return {};
    const std::uint8_t byte = bytes.front();
    bytes = bytes.subspan(1);
    value |= static_cast<std::size_t>(byte & 0x7F) << shift;
    if (byte < 0x80) return value;
  }
  return {};
}

std::size_t u16_at(Bytes bytes, std::size_t at) {
  return static_cast<std::size_t>(bytes[at] | bytes[at + 1] << 8);
}

}  // namespace

struct DepthDecoder::Memory {
  std::vector<std::uint16_t> palette;  ///< value of each index; palette[0] = 0
  std::array<std::array<Share, 32>, kContexts> shares;
  std::array<std::array<std::uint8_t, rans::kTotal>, kContexts> token_at;
  std::array<Lane, kLanes> lanes;
  std::vector<std::uint16_t> above_classes;  ///< width x lanes

  bool read_palette(Bytes& bytes);
  bool read_tables(Bytes& bytes);
  bool read_table(Bytes& bytes, std::size_t context);
  bool open_lanes(Bytes bytes, int width_px, int height_px, std::uint16_t* values);
  void decode_bands(int width_px, int height_px);
  template <std::size_t kCount>
  void decode_rows(int width_px);
  std::uint16_t decode_pixel(rans::Decoder& coder, std::size_t context, std::uint16_t guess,
                             std::uint16_t fill, std::uint16_t& hole) const;
  bool look_up(std::span<std::uint16_t> values) const;
};

DepthDecoder::DepthDecoder() : memory_(std::make_unique<Memory>()) {}
DepthDecoder::~DepthDecoder() = default;

bool DepthDecoder::Memory::read_palette(Bytes& bytes) {
  const auto count = read_varint(bytes);
  if (!count || *count > 0xFFFF || *count > bytes.size()) return false;
  palette.assign(1, 0);
  std::size_t value = 0;
  for (std::size_t i = 0; i < *count; ++i) {
    const auto step = read_varint(bytes);
    if (!step || *step > 0xFFFF) return false;
    value += *step;
    if (*step == 0 || value > 0xFFFF) return false;
    palette.push_back(static_cast<std::uint16_t>(value));
  }
  return true;
}

bool DepthDecoder::Memory::read_table(Bytes& bytes, std::size_t context) {
  const auto used = read_varint(bytes);
  if (!used || *used > kTokens) return false;
  auto& share = shares[context];
  auto& tokens = token_at[context];
  share.fill({});
  std::uint32_t start = 0;
  for (std::size_t token = 0; token < *used; ++token) {
    const auto frequency = read_varint(bytes);
    if (!frequency || *frequency > rans::kTotal - start) return false;
    share[token] = {static_cast<std::uint16_t>(*frequency), static_cast<std::uint16_t>(start)};
    std::memset(tokens.data() + start, static_cast<int>(token), *frequency);
    start += static_cast<std::uint32_t>(*frequency);
  }
  if (*used != 0) return start == rans::kTotal;
  share[0] = {rans::kTotal, 0};  // no encoder uses this context; damaged bytes may
  tokens.fill(0);
  return true;
}

bool DepthDecoder::Memory::read_tables(Bytes& bytes) {
  for (std::size_t context = 0; context < kContexts; ++context) {
    if (!read_table(bytes, context)) return false;
  }
  return true;
}

bool DepthDecoder::Memory::open_lanes(Bytes bytes, int width_px, int height_px,
                                      std::uint16_t* values) {
  std::array<std::size_t, kLanes> sizes;
  for (std::size_t& size : sizes) {
    const auto words = read_varint(bytes);
    if (!words) return false;
    size = 2 * *words;
  }
  for (std::size_t i = 0; i < kLanes; ++i) {
    if (sizes[i] > bytes.size()) return false;
    Lane& lane = lanes[i];
    lane.coder = rans::Decoder(bytes.first(sizes[i]));
    bytes = bytes.subspan(sizes[i]);
    lane.above.reset(width_px);
    lane.row.reset(width_px);
    lane.out =
        values + static_cast<std::ptrdiff_t>(band(static_cast<int>(i), height_px).first) * width_px;
  }
  return bytes.empty();
}

inline std::uint16_t DepthDecoder::Memory::decode_pixel(rans::Decoder& coder, std::size_t context,
                                                        std::uint16_t guess, std::uint16_t fill,
                                                        std::uint16_t& hole) const {
  const std::uint8_t token = token_at[context][coder.place()];
  const Share share = shares[context][token];
  coder.take(share.frequency, share.start);
  auto folded = static_cast<std::uint16_t>(token - 1);
  if (token > kDirect) {
    const int bits = raw_bits(token);
    folded = static_cast<std::uint16_t>(1U << bits | coder.take_raw(bits));
  }
  hole = token == 0;
  const auto change = static_cast<std::uint16_t>((guess + unzigzag(folded)) ^ fill);
  return static_cast<std::uint16_t>(fill ^ (change & (hole - 1)));  // no branch
}

/// One row of each of the first kCount lanes, side by side.
template <std::size_t kCount>
void DepthDecoder::Memory::decode_rows(int width_px) {
  std::array<rans::Decoder, kCount> coders;
  std::array<std::uint16_t, kCount> left;
  std::array<std::uint16_t, kCount> hole_left;
  std::array<std::uint16_t*, kCount> classes;
  std::array<const std::uint16_t*, kCount> ups;
  std::array<std::uint16_t*, kCount> fills;
  std::array<std::uint16_t*, kCount> holes;
  for (std::size_t i = 0; i < kCount; ++i) {
    Lane& lane = lanes[i];
    lane.row.open(lane.above);
    coders[i] = lane.coder;
    left[i] = lane.row.fill()[-1];
    hole_left[i] = 0;
    classes[i] = above_classes.data() + i * static_cast<std::size_t>(width_px);
    const std::uint16_t* up = lane.above.fill();
    ups[i] = up;
    fills[i] = lane.row.fill();
    holes[i] = lane.row.hole();
    const std::uint16_t* up_hole = lane.above.hole();
    for (int u = 0; u < width_px; ++u) {
      classes[i][u] = above_class(up[u - 1], up[u], up[u + 1], up_hole[u], up_hole[u + 1]);
    }
  }
  for (int u = 0; u < width_px; ++u) {
#pragma GCC unroll 4
    for (std::size_t i = 0; i < kCount; ++i) {
      const std::uint16_t ul = ups[i][u - 1];
      const std::uint16_t up = ups[i][u];
      const std::size_t context =
          std::size_t{classes[i][u]} + left_class(left[i], ul, hole_left[i]);
      left[i] = decode_pixel(coders[i], context, predict(left[i], up, ul), left[i], hole_left[i]);
      fills[i][u] = left[i];
      holes[i][u] = hole_left[i];
    }
  }
  for (std::size_t i = 0; i < kCount; ++i) {
    Lane& lane = lanes[i];
    lane.coder = coders[i];
    for (int u = 0; u < width_px; ++u) {
      lane.out[u] = lane.row.hole()[u] != 0 ? std::uint16_t{0} : lane.row.fill()[u];
    }
    lane.out += width_px;
    lane.row.close();
    std::swap(lane.above, lane.row);
  }
}

/// Bands differ in rows: side by side while all have one, then those that are left.
void DepthDecoder::Memory::decode_bands(int width_px, int height_px) {
  above_classes.resize(static_cast<std::size_t>(width_px) * kLanes);
  const auto rows_of = [height_px](int lane) {
    const Band rows = band(lane, height_px);
    return rows.end - rows.first;
  };
  static_assert(kLanes == 2);
  int row = 0;
  for (; row < rows_of(1); ++row) decode_rows<2>(width_px);
  for (; row < rows_of(0); ++row) decode_rows<1>(width_px);
}

/// Indices to values; false if there is one that the palette has not.
bool DepthDecoder::Memory::look_up(std::span<std::uint16_t> values) const {
  const std::uint16_t* value_of = palette.data();
  std::uint16_t largest = 0;
  for (const std::uint16_t index : values) largest = std::max(largest, index);
  if (largest >= palette.size()) return false;
  for (std::uint16_t& value : values) value = value_of[value];
  return true;
}

bool DepthDecoder::decode(Bytes bytes, int width_px, int height_px,
                          std::span<std::uint16_t> values) {
  if (std::min(width_px, height_px) < 1 || std::max(width_px, height_px) > kSideMax_px ||
      values.size() != static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) ||
      bytes.size() < kHeaderBytes ||
      !std::equal(std::begin(kMagic), std::end(kMagic), bytes.begin()) ||
      u16_at(bytes, 4) != static_cast<std::size_t>(width_px) ||
      u16_at(bytes, 6) != static_cast<std::size_t>(height_px)) {
    return false;
  }
  const std::uint8_t layout = bytes[3];
  bytes = bytes.subspan(kHeaderBytes);
  if (layout == kStored) {
    if (bytes.size() != values.size_bytes()) return false;
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return true;
  }
  if (layout != kValues && layout != kPalette) return false;
  Memory& memory = *memory_;
  if (layout == kPalette && !memory.read_palette(bytes)) return false;
  if (!memory.read_tables(bytes) || !memory.open_lanes(bytes, width_px, height_px, values.data())) {
    return false;
  }
  memory.decode_bands(width_px, height_px);
  const bool whole =
      std::ranges::all_of(memory.lanes, [](const Lane& lane) { return lane.coder.at_end(); });
  return whole && (layout == kValues || memory.look_up(values));
}

}  // namespace roomwise
