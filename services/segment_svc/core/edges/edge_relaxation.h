#pragma once
#include "services/segment_svc/core/edges/crack_edges.h"

namespace roomwise::segment {

/// How many edges go on from a corner, 0 to 3, judged from the strengths of the three other cracks
/// there: of m = max(a, b, c, 0.1), a >= b >= c, the number whose product is largest among
///   0: (m - a)(m - b)(m - c)   1: a (m - b)(m - c)   2: a b (m - c)   3: a b c.
int vertex_type(float a, float b, float c);

/// What a crack's two ends say of it: 1 it is an edge, -1 it is none, 0 nothing.
/// 0-0 stands alone, 0-2 and 0-3 are dead ends: none. 1-1 goes on both ways, 1-2 and 1-3 meet a
/// border: edges. 0-1, 2-2, 2-3 and 3-3: nothing.
int crack_evidence(int type_of_one_end, int type_of_other_end);

/// Edge relaxation (Prager, Extracting and labeling boundary segments in natural scenes, IEEE PAMI
/// 1980): in each round every strength moves by `step` as its ends say, within 0 to 1.
void relax_edges(CrackEdges& edges, int rounds, float step);

}  // namespace roomwise::segment
