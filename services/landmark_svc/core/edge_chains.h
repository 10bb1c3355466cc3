#pragma once
#include <cstdint>
#include <vector>

#include "services/landmark_svc/core/disparity_table.h"
#include "services/landmark_svc/core/edge_pixel.h"

namespace roomwise::landmark {

/// How edge pixels of successive rows are taken for one edge.
struct ChainParams {
  double column_step_max_px = 4.0;     ///< at 640 px image width
  double depth_step_m = 0.04;          ///< allowed change of near depth, plus the next line
  double depth_step_per_m_m2 = 0.012;  ///< times depth squared [m/m^2]
  int row_gap_max_px = 10;             ///< rows an edge may miss, at 480 px image height
  int proof_rows_px = 4;     ///< edges with a measured far side that prove others, at 480 px height
  double bend_max_px = 4.0;  ///< column bend at which a chain is cut, at 640 px image width
};

/// Edge pixels that follow each other down the image: a piece of one physical edge.
struct EdgeChain {
  std::int32_t last_edge = -1;  ///< index of its lowest edge pixel
  std::int32_t rows = 0;
  EdgeSide side = EdgeSide::kLeft;
};

/// Links edge pixels into chains, O(edges): each pixel looks for the open chain of its side that
/// ended nearest in column within the last rows and at a like depth.
class ChainLinker {
 public:
  /// Links `edges`, ordered by row and then column, of an image of this size. Allocates only
  /// if there are more edges or columns than ever before.
  void link(const std::vector<EdgePixel>& edges, const DisparityTable& table, int width_px,
            int height_px, const ChainParams& params);

  /// In order of their first pixel.
  const std::vector<EdgeChain>& chains() const { return chains_; }

  /// Edges before readings beyond 4095 mm count where enough others of their side stand in the
  /// columns around, as near, whose far side has a depth: as a door post has above the floor
  /// behind it. Their chains are is_open no longer.
  void prove_open_edges(std::vector<EdgePixel>& edges, const DisparityTable& table, int width_px,
                        int height_px, const ChainParams& params);

  /// Copies the pixels of `chain` into `pixels`, from the lowest row up.
  void collect(const EdgeChain& chain, const std::vector<EdgePixel>& edges,
               std::vector<EdgePixel>& pixels) const;

  /// Makes room for so many edges and columns.
  void reserve(std::size_t edges, int width_px);

 private:
  struct Reach {
    int columns_px;
    int rows_px;
  };

  /// Edges of a column whose far side has a depth.
  struct Measured {
    std::int32_t rows = 0;
    std::int64_t near_steps_sum = 0;
  };

  static Reach reach_of(const ChainParams& params, int width_px, int height_px);
  static double depth_step_max_m(const DisparityTable& table, const EdgePixel& edge,
                                 const ChainParams& params);
  void count_measured(const std::vector<EdgePixel>& edges, int width_px);
  int measured_around(const EdgePixel& edge, const DisparityTable& table, const Reach& reach,
                      const ChainParams& params) const;
  /// The open chain that `edge` continues, -1 if none.
  std::int32_t best_chain(const std::vector<EdgePixel>& edges, const EdgePixel& edge,
                          const DisparityTable& table, const Reach& reach,
                          const ChainParams& params) const;
  std::vector<std::int32_t>& ends_at_column(EdgeSide side) {
    return chain_at_column_[static_cast<std::size_t>(side)];
  }

  std::vector<EdgeChain> chains_;
  std::vector<std::int32_t> previous_;            ///< of each edge: the one above, -1 at the top
  std::vector<Measured> measured_at_column_[2];   ///< per side
  std::vector<std::int32_t> chain_at_column_[2];  ///< newest chain to end at a column, per side
};

}  // namespace roomwise::landmark
