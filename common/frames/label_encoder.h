#pragma once
#include <zstd.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "roomwise/segmentation_t.hpp"

namespace roomwise {

/// Puts a label image into a SEGMENTS message, in one zstd frame, or as it is where that is
/// smaller. Keeps its memory.
class LabelEncoder {
 public:
  LabelEncoder();

  /// `labels`: height x width.
  void encode(const std::vector<std::uint8_t>& labels, int width_px, int height_px,
              segmentation_t& message);

 private:
  struct FreeContext {
    void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
  };
  std::unique_ptr<ZSTD_CCtx, FreeContext> context_;
};

}  // namespace roomwise
