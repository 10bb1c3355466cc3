#pragma once
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "services/ekf_svc/core/map_snapshot.h"

namespace roomwise::ekf {

/// A map as bytes:
///   "RWMAP" 0 0 version(1)   8 bytes
///   size of what follows up to the checksum, uint64
///   landmark count uint32, next_map_id int64, calibration 3 doubles, its covariance 9 doubles
///   each landmark: map_id int64, identity int32, kind int8, times_seen int32, signature 3 doubles,
///                  position 2 doubles
///   covariance_m2: doubles
///   CRC-32 (IEEE 802.3) of all before it, uint32
/// All numbers little-endian.
std::vector<std::uint8_t> encode_map(const MapSnapshot& map);

enum class [[nodiscard]] MapVerdict{
    kOk,
    kNotAMap,        ///< too short, or does not begin like one
    kVersion,        ///< of a version this program does not know
    kTruncated,      ///< shorter or longer than it says
    kChecksum,       ///< bytes changed
    kNumbersInvalid  ///< not finite, variances not positive, ids used twice, too many
};
std::string_view words(MapVerdict verdict);

/// `map` is written only if the bytes are a whole map with usable numbers.
MapVerdict decode_map(std::span<const std::uint8_t> bytes, MapSnapshot& map);

}  // namespace roomwise::ekf
