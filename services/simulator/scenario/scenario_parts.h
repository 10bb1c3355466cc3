#pragma once
#include "services/simulator/core/scene.h"
#include "services/simulator/core/scene_solids.h"
#include "services/simulator/scenario/scenario.h"
#include "services/simulator/scenario/table_reader.h"

namespace roomwise::simulator {

/// Where things may be, and how large.
inline constexpr Limits kPlace_m{-200.0, 200.0};
inline constexpr Limits kSize_m{0.001, 200.0};
inline constexpr Limits kHeight_m{0.0, 20.0};
inline constexpr Limits kAngle_rad{-7.0, 7.0};
inline constexpr std::size_t kMostOfAKind = 500;

/// Each reads its arrays of tables from the file into the scene, all keys asked for and finished.
void read_materials(TableReader& file, Scene& scene);
void read_grounds(TableReader& file, Scene& scene);  ///< [[pit]] [[floor]] [[ceiling]]
void read_walls(TableReader& file, Scene& scene);
void read_solids(TableReader& file, Scene& scene);     ///< [[box]] [[cylinder]] [[panel]] [[mesh]]
void read_furniture(TableReader& file, Scene& scene);  ///< table, chair, sofa, shelf, stairs
void read_walkers(TableReader& file, Scene& scene);
void read_paths(TableReader& file, Scene& scene);

/// Index of the material the key names.
int material_of(TableReader& table, const Scene& scene, std::string_view key = "material");

/// at_m and heading_rad (0 if left out).
Pose2 placement_of(TableReader& table);

}  // namespace roomwise::simulator
