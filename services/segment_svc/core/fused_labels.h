#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "common/image/rgbd_frame.h"
#include "services/segment_svc/core/camera_view.h"
#include "services/segment_svc/core/color/color_evidence.h"
#include "services/segment_svc/core/color/color_grid.h"
#include "services/segment_svc/core/floor_plane.h"

namespace roomwise::segment {

/// Geometry's labels, judged again by place and colour (Bayes):
///   p(class | pixel) ~ p(class | row) p(geometry's label | class) p(colour | class)^w.
/// What stands up becomes obstacle or wall, whichever is likelier. A pixel that geometry leaves
/// unknown becomes one of them where that is sure; floor far off whose colour says otherwise
/// becomes unknown. Colour never makes anything accessible, and leaves drop-offs alone. Without
/// colour, or where depth is not registered to it, w is 0.
class FusedLabels {
 public:
  void teach(const ColorModel& taught) { evidence_.teach(taught); }

  /// Learns from the frame, then corrects `labels`, which are geometry's.
  void correct(const RgbdFrame& frame, const CameraView& view, const FloorPlane& floor,
               std::vector<std::uint8_t>& labels);

 private:
  /// What is known of a row's pixels but for their colour: log scores by geometry's label.
  struct RowScores {
    ClassScores obstacle, wall, accessible, unknown;
    bool judges_floor = false;
    const ClassScores& of(std::uint8_t label) const;
    RowScores probabilities() const;
  };

  void prepare_rows(const CameraView& view, const FloorPlane& floor);
  void learn(const CameraView& view, const std::vector<std::uint8_t>& labels);
  void correct_row(std::size_t width, const RowScores& row, const std::uint16_t* bins,
                   std::uint8_t* labels) const;

  ColorEvidence evidence_;
  ColorGrid colors_;
  bool color_is_used_ = false;
  std::vector<RowScores> rows_;
  std::vector<std::uint16_t> bins_;  ///< of a row's colours
};

}  // namespace roomwise::segment
