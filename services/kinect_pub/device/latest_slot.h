#pragma once
#include <condition_variable>
#include <mutex>
#include <utility>

namespace roomwise {

/// One place between a thread that makes things and a thread that uses them: the newest wins.
/// Things are swapped in and out whole, never shared, and their memory goes round.
template <class Thing>
class LatestSlot {
 public:
  /// Swaps `thing` in. True if that displaced one nobody had taken.
  bool put(Thing& thing) {
    bool displaced = false;
    {
      const std::lock_guard lock(mutex_);
      std::swap(thing_, thing);
      displaced = std::exchange(full_, true);
    }
    filled_.notify_one();
    return displaced;
  }

  /// Waits for a thing and swaps it out. False once the slot is closed.
  bool take(Thing& thing) {
    std::unique_lock lock(mutex_);
    filled_.wait(lock, [this] { return full_ || closed_; });
    if (closed_) return false;
    std::swap(thing_, thing);
    full_ = false;
    return true;
  }

  /// Swaps a thing out if there is one.
  bool try_take(Thing& thing) {
    const std::lock_guard lock(mutex_);
    if (!full_ || closed_) return false;
    std::swap(thing_, thing);
    full_ = false;
    return true;
  }

  /// Ends every take(), now and later.
  void close() {
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
    }
    filled_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable filled_;
  Thing thing_{};
  bool full_ = false;
  bool closed_ = false;
};

}  // namespace roomwise
