#pragma once
#include <string>

#include "logs/tools/point_cloud.h"

namespace roomwise {

/// A cloud as PLY, binary little-endian, version 1.0: x y z [m] as float, red green blue as uchar.
/// `comment` (one line) says which frame the points stand in.
std::string as_ply(const PointCloud& cloud, const std::string& comment);

/// A cloud as PCD 0.7, binary: x y z [m] and rgb, whose four bytes are blue, green, red, 0, read as
/// one float as the Point Cloud Library does.
std::string as_pcd(const PointCloud& cloud, const std::string& comment);

}  // namespace roomwise
