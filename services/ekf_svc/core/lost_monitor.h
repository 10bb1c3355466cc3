#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace roomwise::ekf {

/// Watches whether the map keeps its promises: landmarks that ought to be in sight are seen, or are
/// looked through.
class LostMonitor {
 public:
  void record(std::int64_t map_id, bool is_seen);

  /// Of the last kWindow promises five in six were broken, of kLandmarksMin landmarks or more.
  bool says_lost() const;

  void clear() { count_ = next_ = 0; }

 private:
  static constexpr std::size_t kWindow = 36;
  static constexpr std::size_t kLandmarksMin = 5;
  struct Promise {
    std::int64_t map_id = 0;
    bool is_kept = false;
  };
  std::array<Promise, kWindow> promises_;
  std::size_t next_ = 0;
  std::size_t count_ = 0;
};

}  // namespace roomwise::ekf
