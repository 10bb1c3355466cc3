#pragma once
#include <cstdint>
#include <cstdlib>
#include <deque>
#include <optional>
#include <utility>

namespace roomwise::kinect {

/// Depth and colour image of one instant.
template <class Depth, class Color>
struct FramePair {
  std::int64_t depth_time_us;
  std::int64_t color_time_us;
  Depth depth;
  Color color;
};

/// Matches depth images with colour images by the time on the device's clock.
///
/// Each stream arrives in order of time, but either may run ahead of the other by a few images, and
/// either may lose some. An image is paired with the waiting one nearest in time, at most
/// `tolerance_us` away; what waited longer than the partner can have none any more and is let go,
/// as is the oldest when more than kWaitingMax wait. A stream whose time runs backwards is that of
/// a device that started anew: whatever waits is let go.
template <class Depth, class Color>
class FramePairing {
 public:
  using Pair = FramePair<Depth, Color>;
  static constexpr std::size_t kWaitingMax = 4;

  explicit FramePairing(std::int64_t tolerance_us) : tolerance_us_(tolerance_us) {}

  std::optional<Pair> add_depth(std::int64_t time_us, Depth depth) {
    forget_if_time_ran_back(time_us, last_depth_us_);
    const std::optional<std::size_t> partner = nearest(colors_, time_us);
    if (!partner) {
      wait(depths_, {time_us, std::move(depth)}, depth_unpaired_);
      return std::nullopt;
    }
    let_go(depths_, depths_.size(), depth_unpaired_);
    let_go(colors_, *partner, color_unpaired_);
    Pair pair{time_us, colors_.front().time_us, std::move(depth), std::move(colors_.front().image)};
    colors_.pop_front();
    return pair;
  }

  std::optional<Pair> add_color(std::int64_t time_us, Color color) {
    forget_if_time_ran_back(time_us, last_color_us_);
    const std::optional<std::size_t> partner = nearest(depths_, time_us);
    if (!partner) {
      wait(colors_, {time_us, std::move(color)}, color_unpaired_);
      return std::nullopt;
    }
    let_go(colors_, colors_.size(), color_unpaired_);
    let_go(depths_, *partner, depth_unpaired_);
    Pair pair{depths_.front().time_us, time_us, std::move(depths_.front().image), std::move(color)};
    depths_.pop_front();
    return pair;
  }

  std::int64_t depth_unpaired() const { return depth_unpaired_; }
  std::int64_t color_unpaired() const { return color_unpaired_; }
  std::size_t depths_waiting() const { return depths_.size(); }
  std::size_t colors_waiting() const { return colors_.size(); }

 private:
  template <class Image>
  struct Waiting {
    std::int64_t time_us;
    Image image;
  };
  template <class Image>
  using Queue = std::deque<Waiting<Image>>;

  template <class Image>
  std::optional<std::size_t> nearest(const Queue<Image>& queue, std::int64_t time_us) const {
    std::optional<std::size_t> best;
    std::int64_t best_us = tolerance_us_;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const std::int64_t apart_us = std::abs(queue[i].time_us - time_us);
      if (apart_us > best_us) continue;
      best = i;
      best_us = apart_us;
    }
    return best;
  }

  template <class Image>
  static void let_go(Queue<Image>& queue, std::size_t count, std::int64_t& unpaired) {
    unpaired += static_cast<std::int64_t>(count);
    queue.erase(queue.begin(), queue.begin() + static_cast<std::ptrdiff_t>(count));
  }

  template <class Image>
  static void wait(Queue<Image>& queue, Waiting<Image> waiting, std::int64_t& unpaired) {
    if (queue.size() == kWaitingMax) let_go(queue, 1, unpaired);
    queue.push_back(std::move(waiting));
  }

  void forget_if_time_ran_back(std::int64_t time_us, std::optional<std::int64_t>& last_us) {
    if (last_us && time_us < *last_us) {
      let_go(depths_, depths_.size(), depth_unpaired_);
      let_go(colors_, colors_.size(), color_unpaired_);
      last_depth_us_.reset();
      last_color_us_.reset();
    }
    last_us = time_us;
  }

  std::int64_t tolerance_us_;
  Queue<Depth> depths_;
  Queue<Color> colors_;
  std::optional<std::int64_t> last_depth_us_;
  std::optional<std::int64_t> last_color_us_;
  std::int64_t depth_unpaired_ = 0;
  std::int64_t color_unpaired_ = 0;
};

}  // namespace roomwise::kinect
