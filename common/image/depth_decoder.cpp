#include <array>
#include <bit>
#include <cstring>
#include <numeric>
#include <optional>
#include <utility>

#include "common/image/depth_codec.h"
#include "common/image/depth_model.h"
#include "common/image/rans.h"

namespace roomwise {
namespace {

using namespace pdz16;
using Bytes = std::span<const std::uint8_t>;

static_assert(std::endian::native == std::endian::little, "stored values are copied as they lie");

/// A token in a context's table, with all that decoding it takes.
struct Token {
  std::uint16_t frequency = 0;
  std::uint16_t start = 0;
  std::uint16_t residual = 0;
  std::uint8_t raw_bits = 0;
  std::uint8_t hole_class = 0;
};

struct Table {
  std::array<Token, std::bit_ceil(kTokens)> tokens;
  std::array<std::uint8_t, rans::kTotal> token_at;  ///< of each place
};

/// What a lane keeps between rows: fills with a margin left and right.
struct Lane {
  rans::Decoder coder;
  std::vector<std::uint16_t> above;
  std::vector<std::uint16_t> row;
  std::vector<std::uint16_t> above_classes;
  std::uint16_t* out = nullptr;  ///< the next row's values
};

/// The same for the length of one row, small enough to be kept in registers.
struct Cursor {
  rans::Decoder coder;
  const std::uint16_t* above_classes;
  const std::uint16_t* above;
  std::uint16_t* row;
  std::uint16_t* out;
  std::uint16_t left;
  std::uint16_t hole_class;  ///< of the pixel to the left
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

Token token_with(std::size_t number, std::size_t frequency, std::size_t start) {
  const int raw = raw_bits(static_cast<int>(number));
  Token token;
  token.frequency = static_cast<std::uint16_t>(frequency);
  token.start = static_cast<std::uint16_t>(start);
  token.raw_bits = static_cast<std::uint8_t>(raw);
  if (number == 0) {
    token.hole_class = kLeftHole;
  } else if (raw == 0) {
    token.residual = unfold(static_cast<std::uint16_t>(number - 1));
  }
  return token;
}

/// Classes of the pixels below `above`, whose values are `above_out`.
void classify(const std::uint16_t* above, const std::uint16_t* above_out, int width_px,
              std::uint16_t* classes) {
  for (int u = 0; u < width_px - 1; ++u) {
    classes[u] =
        above_class(above[u - 1], above[u], above[u + 1], above_out[u] == 0, above_out[u + 1] == 0);
  }
  const int last = width_px - 1;
  const bool hole = above_out[last] == 0;
  classes[last] = above_class(above[last - 1], above[last], above[last], hole, hole);
}

inline void decode_pixel(Cursor& cursor, const Table* tables, const std::uint16_t* value_of,
                         int u) {
  const std::uint16_t ul = cursor.above[u - 1];
  const std::size_t context = static_cast<std::size_t>(cursor.above_classes[u]) +
                              left_class(cursor.left, ul, cursor.hole_class);
  const Table& table = tables[context];
  const Token& token = table.tokens[table.token_at[cursor.coder.place()]];
  cursor.coder.take(token.frequency, token.start);
  std::uint16_t residual = token.residual;
  if (token.raw_bits != 0) [[unlikely]] {
    residual = unfold(
        static_cast<std::uint16_t>(1U << token.raw_bits | cursor.coder.take_raw(token.raw_bits)));
  }
  const auto value =
      static_cast<std::uint16_t>(predict(cursor.left, cursor.above[u], ul) + residual);
  // Masks where a branch would be guessed wrong at every edge of a hole.
  const auto seen = static_cast<std::uint16_t>((token.hole_class & 1) - 1);
  const auto shown = static_cast<std::uint16_t>(value & seen);
  cursor.left = static_cast<std::uint16_t>(shown | (cursor.left & ~seen));
  cursor.hole_class = token.hole_class;
  cursor.row[u] = cursor.left;
  cursor.out[u] = value_of[shown];
}

}  // namespace

struct DepthDecoder::Memory {
  std::vector<std::uint16_t> value_of = std::vector<std::uint16_t>(1 << 16);  ///< of each index
  std::array<Table, kContexts> tables;
  std::array<Lane, kLanes> lanes;

  bool decode(Layout layout, Bytes bytes, int width_px, int height_px,
              std::span<std::uint16_t> values);
  bool read_palette(Bytes& bytes);
  bool read_table(Bytes& bytes, Table& table);
  bool open_lanes(Bytes bytes, int width_px, int height_px, std::uint16_t* values);
  template <std::size_t kCount>
  void decode_rows(int width_px);
};

DepthDecoder::DepthDecoder() : memory_(std::make_unique<Memory>()) {}
DepthDecoder::~DepthDecoder() = default;

bool DepthDecoder::Memory::read_palette(Bytes& bytes) {
  const auto count = read_varint(bytes);
  if (!count || *count > 0xFFFF || *count > bytes.size()) return false;
  std::ranges::fill(value_of, std::uint16_t{0});
  std::size_t value = 0;
  for (std::size_t index = 1; index <= *count; ++index) {
    const auto step = read_varint(bytes);
    if (!step || *step == 0 || *step > 0xFFFF - value) return false;
    value += *step;
    value_of[index] = static_cast<std::uint16_t>(value);
  }
  return true;
}

bool DepthDecoder::Memory::read_table(Bytes& bytes, Table& table) {
  const auto used = read_varint(bytes);
  if (!used || *used > kTokens) return false;
  std::size_t start = 0;
  for (std::size_t number = 0; number < *used; ++number) {
    const auto frequency = read_varint(bytes);
    if (!frequency || *frequency > rans::kTotal - start) return false;
    table.tokens[number] = token_with(number, *frequency, start);
    std::memset(table.token_at.data() + start, static_cast<int>(number), *frequency);
    start += *frequency;
  }
  if (*used != 0) return start == rans::kTotal;
  table.tokens[0] = token_with(0, rans::kTotal, 0);  // only damaged bytes come here
  table.token_at.fill(0);
  return true;
}

bool DepthDecoder::Memory::open_lanes(Bytes bytes, int width_px, int height_px,
                                      std::uint16_t* values) {
  const auto first_words = read_varint(bytes);
  const auto second_words = read_varint(bytes);
  if (!first_words || !second_words || 2 * (*first_words + *second_words) != bytes.size()) {
    return false;
  }
  lanes[0].coder = rans::Decoder(bytes.first(2 * *first_words));
  lanes[1].coder = rans::Decoder(bytes.last(2 * *second_words));
  const auto width = static_cast<std::size_t>(width_px);
  lanes[0].out = values;
  lanes[1].out = values + width * static_cast<std::size_t>(first_band_rows(height_px));
  for (Lane& lane : lanes) {
    lane.above.assign(width + 1, 0);
    lane.row.resize(width + 1);
    lane.above_classes.assign(width, above_class(0, 0, 0, true, true));
  }
  return true;
}

/// One row of each of the first kCount lanes, side by side.
template <std::size_t kCount>
void DepthDecoder::Memory::decode_rows(int width_px) {
  std::array<Cursor, kCount> cursors;
  for (std::size_t i = 0; i < kCount; ++i) {
    Lane& lane = lanes[i];
    lane.row[0] = lane.above[1];
    cursors[i] = {lane.coder,
                  lane.above_classes.data(),
                  lane.above.data() + 1,
                  lane.row.data() + 1,
                  lane.out,
                  lane.row[0],
                  0};
  }
  for (int u = 0; u < width_px; ++u) {
#pragma GCC unroll 2
    for (Cursor& cursor : cursors) decode_pixel(cursor, tables.data(), value_of.data(), u);
  }
  for (std::size_t i = 0; i < kCount; ++i) {
    Lane& lane = lanes[i];
    lane.coder = cursors[i].coder;
    classify(lane.row.data() + 1, lane.out, width_px, lane.above_classes.data());
    lane.out += width_px;
    std::swap(lane.above, lane.row);
  }
}

bool DepthDecoder::Memory::decode(Layout layout, Bytes bytes, int width_px, int height_px,
                                  std::span<std::uint16_t> values) {
  if (layout == kValues) std::iota(value_of.begin(), value_of.end(), std::uint16_t{0});
  if (layout == kPalette && !read_palette(bytes)) return false;
  for (Table& table : tables) {
    if (!read_table(bytes, table)) return false;
  }
  if (!open_lanes(bytes, width_px, height_px, values.data())) return false;
  for (int row = 0; row < height_px / 2; ++row) decode_rows<2>(width_px);
  if (height_px % 2 != 0) decode_rows<1>(width_px);
  return lanes[0].coder.at_end() && lanes[1].coder.at_end();
}

bool DepthDecoder::decode(Bytes bytes, int width_px, int height_px,
                          std::span<std::uint16_t> values) {
  const auto width = static_cast<std::size_t>(width_px);
  const auto height = static_cast<std::size_t>(height_px);
  if (std::min(width_px, height_px) < 1 || std::max(width_px, height_px) > kImageSideMax_px ||
      values.size() != width * height || bytes.size() < kHeaderBytes ||
      !std::equal(std::begin(kMagic), std::end(kMagic), bytes.begin()) ||
      u16_at(bytes, 4) != width || u16_at(bytes, 6) != height) {
    return false;
  }
  const std::uint8_t layout = bytes[3];
  bytes = bytes.subspan(kHeaderBytes);
  if (layout == kStored) {
    if (bytes.size() != values.size_bytes()) return false;
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return true;
  }
  return (layout == kValues || layout == kPalette) &&
         memory_->decode(static_cast<Layout>(layout), bytes, width_px, height_px, values);
}

}  // namespace roomwise
