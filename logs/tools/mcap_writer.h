#pragma once
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace roomwise {

/// Writes an MCAP file (mcap.dev/spec): JSON messages with JSON schemas, in chunks of zstd with an
/// index and CRCs, so that readers can seek.
class McapWriter {
 public:
  /// Throws std::runtime_error naming the file if it cannot be made.
  explicit McapWriter(const std::filesystem::path& path);

  /// Adds a channel and returns its number. Its messages are JSON texts as `schema` (JSON Schema)
  /// says; `schema_name` is what viewers know it by.
  std::uint16_t add_channel(const std::string& topic, const std::string& schema_name,
                            const std::string& schema);

  /// One message, with when it was logged and when it was made [us since the epoch; below 0: 0].
  void write(std::uint16_t channel, std::int64_t log_utime, std::int64_t utime,
             std::string_view json);

  /// Writes index and summary; throws std::runtime_error naming the file if the disk is full.
  void close();

 private:
  struct Entry {
    std::uint64_t time_ns;
    std::uint64_t offset;
  };
  struct ChunkIndex {
    std::uint64_t first_ns = 0;
    std::uint64_t last_ns = 0;
    std::uint64_t start = 0;
    std::uint64_t length = 0;
    std::map<std::uint16_t, std::uint64_t> index_offsets;
    std::uint64_t index_length = 0;
    std::uint64_t compressed_size = 0;
    std::uint64_t size = 0;
  };

  void put(std::string_view bytes);
  void finish_chunk();
  void write_indexes(ChunkIndex& chunk);
  std::string statistics() const;
  std::string summary() const;

  std::filesystem::path path_;
  std::ofstream file_;
  std::uint64_t position_ = 0;
  std::uint32_t crc_ = 0;  ///< of everything put since it was last set to 0
  std::string chunk_;      ///< records not yet written
  std::uint64_t chunk_first_ns_ = 0;
  std::uint64_t chunk_last_ns_ = 0;
  std::map<std::uint16_t, std::vector<Entry>> chunk_entries_;
  std::vector<ChunkIndex> chunks_;
  std::vector<std::string> channel_records_;  ///< schema and channel of each
  std::map<std::uint16_t, std::uint64_t> counts_;
};

}  // namespace roomwise
