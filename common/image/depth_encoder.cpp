#include <bit>
#include <cstring>
#include <stdexcept>

#include "common/image/depth_codec.h"
#include "common/image/depth_model.h"
#include "common/image/rans.h"

namespace roomwise {
namespace {

using namespace pdz16;

static_assert(std::endian::native == std::endian::little,
              "values and words are stored as they lie");

/// A pixel as the entropy coder takes it, and how many raw bits' values precede it.
struct Symbol {
  std::uint8_t context;
  std::uint8_t token;
};

void append_u16(std::size_t value, std::vector<std::uint8_t>& out) {
  out.push_back(static_cast<std::uint8_t>(value));
  out.push_back(static_cast<std::uint8_t>(value >> 8));
}

/// Seven bits a byte, the lowest first; the top bit says that more follow.
void append_varint(std::size_t value, std::vector<std::uint8_t>& out) {
  for (; value >= 0x80; value >>= 7) out.push_back(static_cast<std::uint8_t>(value | 0x80));
  out.push_back(static_cast<std::uint8_t>(value));
}

/// What one lane of the model pass leaves for the coding pass, in pixel order.
struct LaneSymbols {
  std::vector<Symbol> symbols;
  std::vector<std::uint16_t> folded;  ///< of the symbols that have raw bits
};

}  // namespace

struct DepthEncoder::Memory {
  std::vector<std::uint16_t> index_of = std::vector<std::uint16_t>(1 << 16);
  std::vector<std::uint8_t> seen = std::vector<std::uint8_t>(1 << 16);
  std::vector<std::uint16_t> distinct;  ///< ascending, without 0
  Row above;
  Row row;
  std::vector<std::uint16_t> row_context;
  std::vector<std::uint16_t> row_folded;
  std::array<LaneSymbols, kLanes> lanes;
  std::array<std::array<std::uint32_t, kTokens>, kContexts> counts;
  std::array<std::array<rans::EncoderSymbol, kTokens>, kContexts> tables;
  std::vector<std::uint16_t> words;

  void find_distinct(std::span<const std::uint16_t> values);
  bool palette_pays(std::size_t pixels) const;
  void choose_indices(bool palette);
  void append_palette(std::vector<std::uint8_t>& out) const;
  void model_lane(const std::uint16_t* values, int width_px, int rows, LaneSymbols& lane);
  void load_row(const std::uint16_t* values, int width_px);
  void model_row(int width_px);
  void count_row(int width_px, LaneSymbols& lane);
  void append_tables(std::vector<std::uint8_t>& out);
  void append_lanes(std::vector<std::uint8_t>& out);
  std::span<const std::uint16_t> code_lane(const LaneSymbols& lane, std::uint16_t* end) const;
};

DepthEncoder::DepthEncoder() : memory_(std::make_unique<Memory>()) {}
DepthEncoder::~DepthEncoder() = default;

void DepthEncoder::Memory::find_distinct(std::span<const std::uint16_t> values) {
  for (const std::uint16_t value : distinct) seen[value] = 0;
  distinct.clear();
  seen[0] = 1;
  for (const std::uint16_t value : values) {
    if (seen[value] != 0) continue;
    seen[value] = 1;
    distinct.push_back(value);
  }
  std::ranges::sort(distinct);
}

/// A palette costs about a byte a colour and saves a bit or more a pixel where values lie sparse.
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
  row.open(above);
  std::uint16_t* fill = row.fill();
  std::uint16_t* hole = row.hole();
  std::uint16_t last = fill[-1];
  for (int u = 0; u < width_px; ++u) {
    const std::uint16_t value = values[u];
    last = value == 0 ? last : index_of[value];
    fill[u] = last;
    hole[u] = value == 0;
  }
  row.close();
}

void DepthEncoder::Memory::model_row(int width_px) {
  const std::uint16_t* up = above.fill();
  const std::uint16_t* up_hole = above.hole();
  const std::uint16_t* here = row.fill();
  const std::uint16_t* here_hole = row.hole();
  std::uint16_t* context = row_context.data();
  std::uint16_t* folded = row_folded.data();
  for (int u = 0; u < width_px; ++u) {
    const std::uint16_t guess = predict(here[u - 1], up[u], up[u - 1]);
    folded[u] = zigzag(static_cast<std::uint16_t>(here[u] - guess));
  }
  for (int u = 0; u < width_px; ++u) {
    context[u] = static_cast<std::uint16_t>(
        above_class(up[u - 1], up[u], up[u + 1], up_hole[u], up_hole[u + 1]) +
        left_class(here[u - 1], up[u - 1], here_hole[u - 1]));
  }
}

void DepthEncoder::Memory::count_row(int width_px, LaneSymbols& lane) {
  const std::uint16_t* hole = row.hole();
  const std::size_t first = lane.symbols.size();
  lane.symbols.resize(first + static_cast<std::size_t>(width_px));
  Symbol* symbol = lane.symbols.data() + first;
  for (int u = 0; u < width_px; ++u) {
    const auto at = static_cast<std::size_t>(u);
    const std::uint16_t folded = row_folded[at];
    int token = 1 + folded;
    if (folded >= kDirect) {
      token = token_of(folded);
      if (hole[u] == 0) lane.folded.push_back(folded);
    }
    token = hole[u] != 0 ? 0 : token;
    const std::uint16_t context = row_context[at];
    ++counts[context][static_cast<std::size_t>(token)];
    symbol[u] = {static_cast<std::uint8_t>(context), static_cast<std::uint8_t>(token)};
  }
}

void DepthEncoder::Memory::model_lane(const std::uint16_t* values, int width_px, int rows,
                                      LaneSymbols& lane) {
  lane.symbols.clear();
  lane.folded.clear();
  above.reset(width_px);
  row.reset(width_px);
  for (int v = 0; v < rows; ++v) {
    load_row(values + static_cast<std::ptrdiff_t>(v) * width_px, width_px);
    model_row(width_px);
    count_row(width_px, lane);
    std::swap(above, row);
  }
}

/// Each context's number of tokens up to the last one used, then their frequencies.
void DepthEncoder::Memory::append_tables(std::vector<std::uint8_t>& out) {
  for (std::size_t context = 0; context < kContexts; ++context) {
    std::array<std::uint16_t, kTokens> frequencies;
    rans::normalise(counts[context], frequencies);
    std::size_t used = kTokens;
    while (used > 0 && frequencies[used - 1] == 0) --used;
    append_varint(used, out);
    std::uint32_t start = 0;
    for (std::size_t token = 0; token < used; ++token) {
      append_varint(frequencies[token], out);
      tables[context][token] = rans::encoder_symbol(frequencies[token], start);
      start += frequencies[token];
    }
  }
}

std::span<const std::uint16_t> DepthEncoder::Memory::code_lane(const LaneSymbols& lane,
                                                               std::uint16_t* end) const {
  rans::Encoder coder(end);
  const std::uint16_t* folded = lane.folded.data() + lane.folded.size();
  for (std::size_t i = lane.symbols.size(); i-- > 0;) {
    const Symbol symbol = lane.symbols[i];
    if (symbol.token > kDirect) {
      const int bits = raw_bits(symbol.token);
      coder.put_raw(*--folded & ((1U << bits) - 1), bits);
    }
    coder.put(tables[symbol.context][symbol.token]);
  }
  coder.finish();
  return coder.words();
}

/// The lanes' sizes in words, then their words.
void DepthEncoder::Memory::append_lanes(std::vector<std::uint8_t>& out) {
  std::array<std::span<const std::uint16_t>, kLanes> coded;
  std::size_t end = 0;
  for (std::size_t i = 0; i < kLanes; ++i) {
    end += 2 * lanes[i].symbols.size() + 2;  // a token and raw bits each move a word at most
    coded[i] = code_lane(lanes[i], words.data() + end);
    append_varint(coded[i].size(), out);
  }
  for (const auto& lane : coded) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(lane.data());
    out.insert(out.end(), bytes, bytes + lane.size_bytes());
  }
}

void DepthEncoder::encode(std::span<const std::uint16_t> values, int width_px, int height_px,
                          std::vector<std::uint8_t>& out) {
  if (std::min(width_px, height_px) < 1 || std::max(width_px, height_px) > kSideMax_px ||
      values.size() != static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)) {
    throw std::invalid_argument("depth image: size does not match its values");
  }
  Memory& memory = *memory_;
  memory.find_distinct(values);
  const bool palette = memory.palette_pays(values.size());
  memory.choose_indices(palette);
  memory.counts = {};
  memory.row_context.resize(static_cast<std::size_t>(width_px));
  memory.row_folded.resize(static_cast<std::size_t>(width_px));
  memory.words.resize(2 * values.size() + 2 * kLanes);

  for (int i = 0; i < kLanes; ++i) {
    const Band rows = band(i, height_px);
    memory.model_lane(values.data() + static_cast<std::ptrdiff_t>(rows.first) * width_px, width_px,
                      rows.end - rows.first, memory.lanes[static_cast<std::size_t>(i)]);
  }
  out.assign(std::begin(kMagic), std::end(kMagic));
  out.push_back(palette ? kPalette : kValues);
  append_u16(static_cast<std::size_t>(width_px), out);
  append_u16(static_cast<std::size_t>(height_px), out);
  if (palette) memory.append_palette(out);
  memory.append_tables(out);
  memory.append_lanes(out);
  if (out.size() < kHeaderBytes + values.size_bytes()) return;
  out.resize(kHeaderBytes + values.size_bytes());
  out[3] = kStored;
  std::memcpy(out.data() + kHeaderBytes, values.data(), values.size_bytes());
}

}  // namespace roomwise
