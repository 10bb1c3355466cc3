#include "logs/tools/mcap_writer.h"

#include <fmt/core.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace roomwise {
namespace {

constexpr std::string_view kMagic = "\x89MCAP0\r\n";
constexpr std::size_t kChunk_bytes = 4U << 20U;
constexpr int kCompressionLevel = 1;

enum class Opcode : char {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0b,
  kDataEnd = 0x0f,
};

/// The fields of a record, little-endian.
class Fields {
 public:
  template <class Integer>
  Fields& number(Integer value) {
    for (std::size_t i = 0; i < sizeof value; ++i) {
      bytes_ += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i) & 0xffU);
    }
    return *this;
  }
  Fields& text(std::string_view text) {
    number(static_cast<std::uint32_t>(text.size()));
    bytes_ += text;
    return *this;
  }
  Fields& raw(std::string_view bytes) {
    bytes_ += bytes;
    return *this;
  }
  Fields& map(const std::map<std::uint16_t, std::uint64_t>& entries) {
    number(static_cast<std::uint32_t>(entries.size() * 10));
    for (const auto& [key, value] : entries) number(key).number(value);
    return *this;
  }
  /// The whole record.
  std::string record(Opcode opcode) const {
    return Fields()
        .raw({reinterpret_cast<const char*>(&opcode), 1})
        .number(static_cast<std::uint64_t>(bytes_.size()))
        .raw(bytes_)
        .bytes_;
  }

 private:
  std::string bytes_;
};

std::uint32_t crc_of(std::uint32_t before, std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

std::uint64_t nanoseconds(std::int64_t utime) {
  constexpr std::int64_t kLatest_us = std::numeric_limits<std::int64_t>::max() / 1000;
  return static_cast<std::uint64_t>(std::clamp<std::int64_t>(utime, 0, kLatest_us)) * 1000U;
}

std::string compressed(const std::string& bytes) {
  std::string out(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size =
      ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), kCompressionLevel);
  if (ZSTD_isError(size) != 0) throw std::runtime_error(ZSTD_getErrorName(size));
  out.resize(size);
  return out;
}

}  // namespace

McapWriter::McapWriter(const std::filesystem::path& path)
    : path_(path), file_(path, std::ios::binary) {
  if (!file_) throw std::runtime_error(path.string() + ": cannot write");
  put(kMagic);
  put(Fields().text("").text("rwlog").record(Opcode::kHeader));
}

std::uint16_t McapWriter::add_channel(const std::string& topic, const std::string& schema_name,
                                      const std::string& schema) {
  const auto id = static_cast<std::uint16_t>(channel_records_.size() + 1);
  channel_records_.push_back(
      Fields()
          .number(id)
          .text(schema_name)
          .text("jsonschema")
          .text(schema)
          .record(Opcode::kSchema) +
      Fields().number(id).number(id).text(topic).text("json").text("").record(Opcode::kChannel));
  chunk_ += channel_records_.back();
  return id;
}

void McapWriter::write(std::uint16_t channel, std::int64_t log_utime, std::int64_t utime,
                       std::string_view json) {
  const std::uint64_t time_ns = nanoseconds(log_utime);
  const bool first = chunk_entries_.empty();
  chunk_first_ns_ = first ? time_ns : std::min(chunk_first_ns_, time_ns);
  chunk_last_ns_ = first ? time_ns : std::max(chunk_last_ns_, time_ns);
  chunk_entries_[channel].push_back({time_ns, chunk_.size()});
  const auto sequence = static_cast<std::uint32_t>(++counts_[channel]);
  chunk_ += Fields()
                .number(channel)
                .number(sequence)
                .number(time_ns)
                .number(nanoseconds(utime))
                .raw(json)
                .record(Opcode::kMessage);
  if (chunk_.size() > kChunk_bytes) finish_chunk();
}

void McapWriter::close() {
  finish_chunk();
  put(Fields().number(crc_).record(Opcode::kDataEnd));
  const std::uint64_t summary_start = position_;
  crc_ = 0;
  put(summary());
  const std::string start = Fields()
                                .number(summary_start)
                                .number(std::uint64_t{0})
                                .number(std::uint32_t{0})
                                .record(Opcode::kFooter);
  const std::string before_crc = start.substr(0, start.size() - sizeof(std::uint32_t));
  put(before_crc);
  put(Fields().number(crc_).record(Opcode::kFooter).substr(9));
  put(kMagic);
  file_.close();
  if (!file_) throw std::runtime_error(path_.string() + ": cannot write");
}

void McapWriter::put(std::string_view bytes) {
  file_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  crc_ = crc_of(crc_, bytes);
  position_ += bytes.size();
}

void McapWriter::finish_chunk() {
  if (chunk_.empty()) return;
  const std::string data = compressed(chunk_);
  ChunkIndex chunk{.first_ns = chunk_first_ns_,
                   .last_ns = chunk_last_ns_,
                   .start = position_,
                   .length = 0,
                   .index_offsets = {},
                   .index_length = 0,
                   .compressed_size = data.size(),
                   .size = chunk_.size()};
  put(Fields()
          .number(chunk.first_ns)
          .number(chunk.last_ns)
          .number(chunk.size)
          .number(crc_of(0, chunk_))
          .text("zstd")
          .number(chunk.compressed_size)
          .raw(data)
          .record(Opcode::kChunk));
  chunk.length = position_ - chunk.start;
  write_indexes(chunk);
  chunks_.push_back(chunk);
  chunk_.clear();
  chunk_entries_.clear();
}

void McapWriter::write_indexes(ChunkIndex& chunk) {
  const std::uint64_t start = position_;
  for (const auto& [channel, entries] : chunk_entries_) {
    chunk.index_offsets[channel] = position_;
    Fields index;
    index.number(channel).number(static_cast<std::uint32_t>(16 * entries.size()));
    for (const Entry& entry : entries) index.number(entry.time_ns).number(entry.offset);
    put(index.record(Opcode::kMessageIndex));
  }
  chunk.index_length = position_ - start;
}

std::string McapWriter::statistics() const {
  std::uint64_t messages = 0;
  for (const auto& [channel, count] : counts_) messages += count;
  std::uint64_t first_ns = chunks_.empty() ? 0 : std::numeric_limits<std::uint64_t>::max();
  std::uint64_t last_ns = 0;
  for (const ChunkIndex& chunk : chunks_) {
    first_ns = std::min(first_ns, chunk.first_ns);
    last_ns = std::max(last_ns, chunk.last_ns);
  }
  const auto channels = static_cast<std::uint32_t>(channel_records_.size());
  return Fields()
      .number(messages)
      .number(static_cast<std::uint16_t>(channels))
      .number(channels)
      .number(std::uint32_t{0})  // attachments
      .number(std::uint32_t{0})  // metadata
      .number(static_cast<std::uint32_t>(chunks_.size()))
      .number(first_ns)
      .number(last_ns)
      .map(counts_)
      .record(Opcode::kStatistics);
}

std::string McapWriter::summary() const {
  std::string text;
  for (const std::string& record : channel_records_) text += record;
  text += statistics();
  for (const ChunkIndex& chunk : chunks_) {
    text += Fields()
                .number(chunk.first_ns)
                .number(chunk.last_ns)
                .number(chunk.start)
                .number(chunk.length)
                .map(chunk.index_offsets)
                .number(chunk.index_length)
                .text("zstd")
                .number(chunk.compressed_size)
                .number(chunk.size)
                .record(Opcode::kChunkIndex);
  }
  return text;
}

}  // namespace roomwise
