#pragma once
#include <cstdint>
#include <string>

namespace roomwise {

/// Per cent done, on stderr where that is a terminal; nothing at all in a pipe.
class Progress {
 public:
  /// `total` in whatever unit show() counts.
  Progress(std::string what, std::uint64_t total);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  /// Wipes the line.
  ~Progress();

  void show(std::uint64_t done);

 private:
  std::string what_;
  std::uint64_t total_;
  std::uint64_t shown_percent_ = 0;
  bool on_terminal_;
};

}  // namespace roomwise
