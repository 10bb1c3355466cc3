#include "services/ekf_svc/core/map_codec.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace roomwise::ekf {
namespace {

constexpr std::array<std::uint8_t, 8> kMagic{'R', 'W', 'M', 'A', 'P', 0, 0, 1};
constexpr std::size_t kHeaderBytes = kMagic.size() + sizeof(std::uint64_t);
constexpr std::size_t kFixedBytes = 4 + 8 + 12 * 8;
constexpr std::size_t kLandmarkBytes = 8 + 4 + 1 + 4 + 5 * 8;
constexpr std::size_t kLandmarksMax = 8000;
static_assert(std::endian::native == std::endian::little);

std::uint32_t crc32_of(std::span<const std::uint8_t> bytes) {
  return static_cast<std::uint32_t>(::crc32_z(0, bytes.data(), bytes.size()));
}

std::size_t covariance_count(std::size_t landmarks) { return landmarks * (2 * landmarks + 1); }

class Writer {
 public:
  explicit Writer(std::vector<std::uint8_t>& bytes) : bytes_(bytes) {}
  template <class Value>
  void put(const Value& value) {
    const auto* raw = reinterpret_cast<const std::uint8_t*>(&value);
    bytes_.insert(bytes_.end(), raw, raw + sizeof(value));
  }

 private:
  std::vector<std::uint8_t>& bytes_;
};

/// Reads what is known to be long enough.
class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  template <class Value>
  void get(Value& value) {
    std::memcpy(&value, bytes_.data(), sizeof(value));
    bytes_ = bytes_.subspan(sizeof(value));
  }
  template <class Value>
  Value get() {
    Value value;
    get(value);
    return value;
  }

 private:
  std::span<const std::uint8_t> bytes_;
};

template <class Coder, class Each>
void landmark_fields(Coder& coder, Landmark& landmark, Eigen::Vector2d& p_m, Each each) {
  each(coder, landmark.map_id);
  each(coder, landmark.identity);
  each(coder, landmark.kind);
  each(coder, landmark.times_seen);
  each(coder, landmark.signature.red_log);
  each(coder, landmark.signature.blue_log);
  each(coder, landmark.signature.variance_log2);
  each(coder, p_m.x());
  each(coder, p_m.y());
}

MapSnapshot parsed(std::span<const std::uint8_t> bytes) {
  MapSnapshot map;
  Reader reader(bytes);
  const auto count = reader.get<std::uint32_t>();
  reader.get(map.next_map_id);
  for (double& value : map.calibration.value.reshaped()) reader.get(value);
  for (double& value : map.calibration_covariance.reshaped()) reader.get(value);
  map.landmarks.resize(count);
  map.positions_m.resize(count);
  for (std::size_t l = 0; l < count; ++l) {
    landmark_fields(reader, map.landmarks[l], map.positions_m[l],
                    [](Reader& from, auto& value) { from.get(value); });
  }
  map.covariance_m2.resize(covariance_count(count));
  for (double& value : map.covariance_m2) reader.get(value);
  return map;
}

bool ids_are_sound(const MapSnapshot& map) {
  std::vector<std::int64_t> ids;
  for (const Landmark& landmark : map.landmarks) ids.push_back(landmark.map_id);
  std::sort(ids.begin(), ids.end());
  return std::adjacent_find(ids.begin(), ids.end()) == ids.end() &&
         (ids.empty() || (ids.front() > 0 && ids.back() < map.next_map_id));
}

bool numbers_are_sound(const MapSnapshot& map) {
  constexpr double kFarthest_m = 1e5;
  const auto is_near = [](const Eigen::Vector2d& p_m) {
    return p_m.allFinite() && p_m.cwiseAbs().maxCoeff() < kFarthest_m;
  };
  const auto is_variance = [&](std::size_t i) { return map.covariance(i, i) > 0.0; };
  bool sound = map.calibration.value.allFinite() && map.calibration_covariance.allFinite() &&
               map.calibration.value.cwiseAbs().maxCoeff() < 1.0 &&
               std::all_of(map.positions_m.begin(), map.positions_m.end(), is_near) &&
               std::all_of(map.covariance_m2.begin(), map.covariance_m2.end(),
                           [](double value) { return std::abs(value) < 1e10; });
  for (std::size_t i = 0; i < 2 * map.landmarks.size(); ++i) sound = sound && is_variance(i);
  for (const Landmark& landmark : map.landmarks) {
    sound = sound && landmark.times_seen >= 0 && !std::isnan(landmark.signature.red_log) &&
            !std::isnan(landmark.signature.blue_log) &&
            !std::isnan(landmark.signature.variance_log2);
  }
  return sound && ids_are_sound(map);
}

}  // namespace

std::vector<std::uint8_t> encode_map(const MapSnapshot& map) {
  const std::size_t count = map.landmarks.size();
  const std::size_t body =
      kFixedBytes + count * kLandmarkBytes + covariance_count(count) * sizeof(double);
  std::vector<std::uint8_t> bytes(kMagic.begin(), kMagic.end());
  bytes.reserve(kHeaderBytes + body + sizeof(std::uint32_t));
  Writer writer(bytes);
  writer.put(static_cast<std::uint64_t>(body));
  writer.put(static_cast<std::uint32_t>(count));
  writer.put(map.next_map_id);
  for (const double value : map.calibration.value.reshaped()) writer.put(value);
  for (const double value : map.calibration_covariance.reshaped()) writer.put(value);
  for (std::size_t l = 0; l < count; ++l) {
    Landmark landmark = map.landmarks[l];
    Eigen::Vector2d p_m = map.positions_m[l];
    landmark_fields(writer, landmark, p_m, [](Writer& to, const auto& value) { to.put(value); });
  }
  for (const double value : map.covariance_m2) writer.put(value);
  writer.put(crc32_of(bytes));
  return bytes;
}

std::string_view words(MapVerdict verdict) {
  switch (verdict) {
    case MapVerdict::kOk:
      return "a map";
    case MapVerdict::kNotAMap:
      return "not a map file";
    case MapVerdict::kVersion:
      return "of a version this program does not know";
    case MapVerdict::kTruncated:
      return "not as long as it says";
    case MapVerdict::kChecksum:
      return "damaged: wrong checksum";
    case MapVerdict::kNumbersInvalid:
      return "holding numbers no map has";
  }
  return "unknown";
}

MapVerdict decode_map(std::span<const std::uint8_t> bytes, MapSnapshot& map) {
  if (bytes.size() < kHeaderBytes + kFixedBytes + sizeof(std::uint32_t))
    return MapVerdict::kNotAMap;
  if (!std::equal(kMagic.begin(), kMagic.end() - 1, bytes.begin())) return MapVerdict::kNotAMap;
  if (bytes[kMagic.size() - 1] != kMagic.back()) return MapVerdict::kVersion;
  Reader header(bytes.subspan(kMagic.size()));
  const auto body = header.get<std::uint64_t>();
  const auto count = header.get<std::uint32_t>();
  if (body != bytes.size() - kHeaderBytes - sizeof(std::uint32_t)) return MapVerdict::kTruncated;
  const auto covered = bytes.first(bytes.size() - sizeof(std::uint32_t));
  Reader tail(bytes.subspan(covered.size()));
  if (tail.get<std::uint32_t>() != crc32_of(covered)) return MapVerdict::kChecksum;
  if (count > kLandmarksMax) return MapVerdict::kNumbersInvalid;
  if (body != kFixedBytes + count * kLandmarkBytes + covariance_count(count) * sizeof(double)) {
    return MapVerdict::kTruncated;
  }
  MapSnapshot candidate = parsed(covered.subspan(kHeaderBytes));
  if (!numbers_are_sound(candidate)) return MapVerdict::kNumbersInvalid;
  map = std::move(candidate);
  return MapVerdict::kOk;
}

}  // namespace roomwise::ekf
