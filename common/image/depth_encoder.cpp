#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "common/image/depth_codec.h"
#include "common/image/depth_model.h"
#include "common/image/rans.h"

namespace roomwise {
namespace {

using namespace pdz16;

static_assert(std::endian::native == std::endian::little,
              "values and words are stored as they lie");

/// A pixel as the entropy coder takes it: context * kTokenSlots + token.
using Symbol = std::uint16_t;
constexpr auto kTokenSlots = static_cast<std::uint16_t>(std::bit_ceil(kTokens));
constexpr std::size_t kSymbols = kContexts * kTokenSlots;

/// What the first pass leaves of a band for the second, in pixel order.
struct Lane {
  std::vector<Symbol> symbols;
  std::vector<std::uint16_t> folded;  ///< of the symbols that have raw bits
};

/// A row of indices with a pixel of margin on both sides, holes filled from the left.
struct Row {
  std::vector<std::uint16_t> fill;
  std::vector<std::uint16_t> hole;  ///< 0 or 1

  void reset(std::size_t width) {
    fill.assign(width + 2, 0);
    hole.assign(width + 2, 1);
  }
};

void append_u16(std::size_t value, std::vector<std::uint8_t>& out) {
  out.push_back(static_cast<std::uint8_t>(value));
  out.push_back(static_cast<std::uint8_t>(value >> 8));
}

void append_varint(std::size_t value, std::vector<std::uint8_t>& out) {
  for (; value >= 0x80; value >>= 7) out.push_back(static_cast<std::uint8_t>(value | 0x80));
  out.push_back(static_cast<std::uint8_t>(value));
}

/// Symbols and folded residuals of a row. Every large residual gets the token kDirect + 1 here.
void model_row(const Row& above_row, const Row& row, int width_px, Symbol* symbols,
               std::uint16_t* folded) {
  const std::uint16_t* above = above_row.fill.data() + 1;
  const std::uint16_t* above_hole = above_row.hole.data() + 1;
  const std::uint16_t* here = row.fill.data() + 1;
  const std::uint16_t* hole = row.hole.data() + 1;
  for (int u = 0; u < width_px; ++u) {
    folded[u] =
        fold(static_cast<std::uint16_t>(here[u] - predict(here[u - 1], above[u], above[u - 1])));
  }
  for (int u = 0; u < width_px; ++u) {
    const auto context = static_cast<std::uint16_t>(
        above_class(above[u - 1], above[u], above[u + 1], above_hole[u] != 0,
                    above_hole[u + 1] != 0) +
        left_class(here[u - 1], above[u - 1], static_cast<std::uint16_t>(kLeftHole * hole[u - 1])));
    const std::uint16_t token = std::min<std::uint16_t>(folded[u], kDirect);
    symbols[u] = static_cast<Symbol>(context * kTokenSlots + (token + 1) * (1 - hole[u]));
  }
}

}  // namespace

struct DepthEncoder::Memory {
  std::vector<std::uint16_t> index_of = std::vector<std::uint16_t>(1 << 16);
  std::vector<std::uint8_t> seen = std::vector<std::uint8_t>(1 << 16);
  std::vector<std::uint16_t> distinct;  ///< ascending, without 0
  Row above;
  Row row;
  std::vector<std::uint16_t> row_folded;
  std::array<Lane, kLanes> lanes;
  std::array<std::uint32_t, kSymbols> counts;
  std::array<rans::EncoderSymbol, kSymbols> codes;
  std::vector<std::uint16_t> words;

  void find_distinct(std::span<const std::uint16_t> values);
  bool palette_pays(std::size_t pixels) const;
  void choose_indices(bool palette);
  void append_palette(std::vector<std::uint8_t>& out) const;
  void load_row(const std::uint16_t* values, int width_px);
  void count_row(Symbol* symbols, int width_px, Lane& lane);
  void model_lane(const std::uint16_t* values, int width_px, int rows, Lane& lane);
  void append_tables(std::vector<std::uint8_t>& out);
  void put(Symbol symbol, const std::uint16_t*& folded_end, rans::Encoder& coder) const;
  void append_lanes(std::vector<std::uint8_t>& out);
};

DepthEncoder::DepthEncoder() : memory_(std::make_unique<Memory>()) {}
DepthEncoder::~DepthEncoder() = default;

void DepthEncoder::Memory::find_distinct(std::span<const std::uint16_t> values) {
  for (const std::uint16_t value : distinct) seen[value] = 0;
  distinct.clear();
  seen[0] = 1;
  const auto look_at = [this](std::uint16_t value) {
    if (seen[value] != 0) return;
    seen[value] = 1;
    distinct.push_back(value);
  };
  // Nearly every four have been seen: one branch for all of them.
  std::size_t i = 0;
  for (; i + 4 <= values.size(); i += 4) {
    const std::uint16_t* four = values.data() + i;
    if ((seen[four[0]] & seen[four[1]] & seen[four[2]] & seen[four[3]]) == 0) {
      std::for_each_n(four, 4, look_at);
    }
  }
  std::ranges::for_each(values.subspan(i), look_at);
  std::ranges::sort(distinct);
}

/// A palette costs about a byte a value, and saves a bit or more a pixel where values lie sparse.
bool DepthEncoder::Memory::palette_pays(std::size_t pixels) const {
  return !distinct.empty() && distinct.size() * 16 <= pixels &&
         distinct.size() * 2 <= distinct.back();
}

void DepthEncoder::Memory::choose_indices(bool palette) {
  std::uint16_t next = 0;
  for (const std::uint16_t value : distinct) index_of[value] = palette ? ++next : value;
}

void DepthEncoder::Memory::append_palette(std::vector<std::uint8_t>& out) const {
  append_varint(distinct.size(), out);
  int previous = 0;
  for (const std::uint16_t value : distinct) {
    append_varint(static_cast<std::size_t>(value - previous), out);
    previous = value;
  }
}

void DepthEncoder::Memory::load_row(const std::uint16_t* values, int width_px) {
  std::uint16_t* fill = row.fill.data() + 1;
  std::uint16_t* hole = row.hole.data() + 1;
  std::uint16_t left = above.fill[1];
  fill[-1] = left;
  hole[-1] = 0;
  for (int u = 0; u < width_px; ++u) hole[u] = values[u] == 0;
  const std::uint16_t* indices = index_of.data();
#pragma GCC unroll 4
  for (int u = 0; u < width_px; ++u) {
    const std::uint16_t index = indices[values[u]];
    left = index == 0 ? left : index;
    fill[u] = left;
  }
  fill[width_px] = left;
  hole[width_px] = hole[width_px - 1];
}

/// Counts a row's symbols, and gives the large residuals the tokens of their size.
void DepthEncoder::Memory::count_row(Symbol* symbols, int width_px, Lane& lane) {
#pragma GCC unroll 4
  for (int u = 0; u < width_px; ++u) {
    if ((symbols[u] & (kTokenSlots - 1)) > kDirect) [[unlikely]] {
      const std::uint16_t folded = row_folded[static_cast<std::size_t>(u)];
      symbols[u] = static_cast<Symbol>(symbols[u] + token_of(folded) - (kDirect + 1));
      lane.folded.push_back(folded);
    }
    ++counts[symbols[u]];
  }
}

void DepthEncoder::Memory::model_lane(const std::uint16_t* values, int width_px, int rows,
                                      Lane& lane) {
  const auto width = static_cast<std::size_t>(width_px);
  lane.symbols.resize(width * static_cast<std::size_t>(rows));
  lane.folded.clear();
  above.reset(width);
  row.reset(width);
  row_folded.resize(width);
  Symbol* symbols = lane.symbols.data();
  for (int v = 0; v < rows; ++v, values += width, symbols += width) {
    load_row(values, width_px);
    model_row(above, row, width_px, symbols, row_folded.data());
    count_row(symbols, width_px, lane);
    std::swap(above, row);
  }
}

void DepthEncoder::Memory::append_tables(std::vector<std::uint8_t>& out) {
  for (std::size_t context = 0; context < kContexts; ++context) {
    const std::size_t first = context * kTokenSlots;
    std::array<std::uint16_t, kTokens> frequencies;
    rans::normalise(std::span(counts).subspan(first, kTokens), frequencies);
    std::size_t used = kTokens;
    while (used > 0 && frequencies[used - 1] == 0) --used;
    append_varint(used, out);
    std::uint32_t start = 0;
    for (std::size_t token = 0; token < used; ++token) {
      append_varint(frequencies[token], out);
      codes[first + token] = rans::encoder_symbol(frequencies[token], start);
      start += frequencies[token];
    }
  }
}

inline void DepthEncoder::Memory::put(Symbol symbol, const std::uint16_t*& folded_end,
                                      rans::Encoder& coder) const {
  const int token = symbol & (kTokenSlots - 1);
  if (token > kDirect) [[unlikely]] {
    const int bits = raw_bits(token);
    coder.put_raw(*--folded_end & ((1U << bits) - 1), bits);
  }
  coder.put(codes[symbol]);
}

/// Both lanes' words, written from their last symbols to their first, side by side.
void DepthEncoder::Memory::append_lanes(std::vector<std::uint8_t>& out) {
  // A token and its raw bits each move a word at most; the state is two.
  const auto room = [](const Lane& lane) { return 2 * lane.symbols.size() + 2; };
  words.resize(room(lanes[0]) + room(lanes[1]));
  rans::Encoder first(words.data() + room(lanes[0]));
  rans::Encoder second(words.data() + words.size());
  const std::uint16_t* first_folded = lanes[0].folded.data() + lanes[0].folded.size();
  const std::uint16_t* second_folded = lanes[1].folded.data() + lanes[1].folded.size();
  std::size_t left = lanes[0].symbols.size();
  for (; left > lanes[1].symbols.size(); --left) {
    put(lanes[0].symbols[left - 1], first_folded, first);
  }
  for (; left > 0; --left) {
    put(lanes[0].symbols[left - 1], first_folded, first);
    put(lanes[1].symbols[left - 1], second_folded, second);
  }
  for (rans::Encoder* coder : {&first, &second}) {
    coder->finish();
    append_varint(coder->words().size(), out);
  }
  for (const rans::Encoder& coder : {first, second}) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(coder.words().data());
    out.insert(out.end(), bytes, bytes + coder.words().size_bytes());
  }
}

void DepthEncoder::encode(std::span<const std::uint16_t> values, int width_px, int height_px,
                          std::vector<std::uint8_t>& out) {
  const auto width = static_cast<std::size_t>(width_px);
  const auto height = static_cast<std::size_t>(height_px);
  if (std::min(width_px, height_px) < 1 || std::max(width_px, height_px) > kImageSideMax_px ||
      values.size() != width * height) {
    throw std::invalid_argument("depth image: size does not match its values");
  }
  Memory& memory = *memory_;
  memory.find_distinct(values);
  const bool palette = memory.palette_pays(values.size());
  memory.choose_indices(palette);
  memory.counts.fill(0);
  const int rows = first_band_rows(height_px);
  const std::size_t second_band = width * static_cast<std::size_t>(rows);
  memory.model_lane(values.data(), width_px, rows, memory.lanes[0]);
  memory.model_lane(values.data() + second_band, width_px, height_px - rows, memory.lanes[1]);

  out.assign(std::begin(kMagic), std::end(kMagic));
  out.push_back(palette ? kPalette : kValues);
  append_u16(width, out);
  append_u16(height, out);
  if (palette) memory.append_palette(out);
  memory.append_tables(out);
  memory.append_lanes(out);
  if (out.size() < kHeaderBytes + values.size_bytes()) return;
  out.resize(kHeaderBytes + values.size_bytes());
  out[3] = kStored;
  std::memcpy(out.data() + kHeaderBytes, values.data(), values.size_bytes());
}

}  // namespace roomwise
