#pragma once
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>

namespace roomwise::ekf {

/// Zeroed doubles that start on a cache line. The system hands out the pages when they are first
/// written, so that a large budget costs nothing until the map grows into it.
class AlignedBuffer {
 public:
  explicit AlignedBuffer(std::size_t size)
      : memory_(std::calloc(size * sizeof(double) + kAlignment, 1), &std::free) {
    if (!memory_) throw std::bad_alloc();
    const auto address = reinterpret_cast<std::uintptr_t>(memory_.get());
    data_ = reinterpret_cast<double*>((address + kAlignment - 1) / kAlignment * kAlignment);
  }
  double* data() { return data_; }
  const double* data() const { return data_; }

 private:
  static constexpr std::size_t kAlignment = 64;
  std::unique_ptr<void, void (*)(void*)> memory_;
  double* data_ = nullptr;
};

}  // namespace roomwise::ekf
