#pragma once
#include <cstdint>
#include <vector>

namespace roomwise::simulator {

/// Edges as window matching leaves them: small patches beside a jump of disparity are taken from up
/// to `reach_px` away, another way in every frame. Elsewhere the image stays as it is.
class RaggedEdges {
 public:
  /// Makes room for images of that size; `reach_px` in [0, 4]. Throws std::invalid_argument if not.
  void resize(int width_px, int height_px, int reach_px);

  /// Row `v` of `image` (height x width, 0 is a hole) into `row`. A jump is a difference of `jump`
  /// or more, or the edge of a hole.
  void copy_row(const std::vector<float>& image, int v, float jump, std::uint32_t key, float* row);

 private:
  bool find_jumps(const std::vector<float>& image, int v, float jump);

  int width_px_ = 0;
  int height_px_ = 0;
  int reach_px_ = 0;
  std::vector<std::uint8_t> beside_jump_;
};

}  // namespace roomwise::simulator
