#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/geometry/pose2.h"

namespace roomwise::simulator {

/// What a pixel shows, as segment_svc names it.
enum class SurfaceClass : std::uint8_t { kObstacle, kWall, kFloor, kDropOff };

/// Pattern of a surface's colour over its texture coordinates (metres along the surface).
enum class Pattern : std::uint8_t { kPlain, kChecker, kStripes, kWood, kNoise };

/// How a surface looks to the colour camera and to the depth camera's infrared.
struct Material {
  std::string name;
  Pattern pattern = Pattern::kPlain;
  std::array<float, 3> color{0.6F, 0.6F, 0.6F};         ///< linear red green blue, 0..1
  std::array<float, 3> second_color{0.3F, 0.3F, 0.3F};  ///< of the pattern
  float pattern_size_m = 0.2F;
  float infrared_reflectance = 0.6F;  ///< 0 swallows the projector's light: no depth
  float mirror =
      0.0F;  ///< 0..1 share reflected as a mirror; above 0.5 depth sees the mirror world or nothing
  bool see_through = false;  ///< window glass: depth sees nothing, colour sees through
};

/// Triangles of one material. Corners counter-clockwise seen from outside.
struct Mesh {
  std::vector<Eigen::Vector3f> corners_m;               ///< world frame, or the body's own
  std::vector<Eigen::Vector2f> texture_m;               ///< one a corner
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices into corners_m
  int material = 0;                                     ///< index into Scene::materials
  SurfaceClass surface_class = SurfaceClass::kObstacle;
};

/// The plan of an upright convex solid: a box, a wall between two doors, a step. World frame.
struct Block {
  std::vector<Eigen::Vector2d> corners_m;  ///< counter-clockwise
  double low_m = 0.0;                      ///< underside above the floor
  double high_m = 0.0;
  bool has_landmarks = true;  ///< its upright edges can be told from what is behind them
};

/// The plan of an upright cylinder. World frame.
struct Column {
  Eigen::Vector2d center_m;
  double radius_m = 0.0;
  double low_m = 0.0;
  double high_m = 0.0;
};

/// A convex region without floor at z = 0, corners counter-clockwise. World frame.
struct Pit {
  std::vector<Eigen::Vector2d> corners_m;
};

/// Something that moves along a closed way at constant speed, upright: a walking person.
struct Walker {
  std::string name;
  std::vector<Mesh> meshes;            ///< own frame: x forward, z up, origin on the floor
  std::vector<Eigen::Vector2d> way_m;  ///< corners of the closed way, world frame
  double speed_mps = 0.0;
  double start_m = 0.0;    ///< where on the way it is at time 0
  double radius_m = 0.25;  ///< as wheels and bumpers meet it
};

/// A lamp without shadows: light falls off with the cosine and the distance.
struct Lamp {
  Eigen::Vector3f position_m{0.0F, 0.0F, 2.4F};
  std::array<float, 3> power{1.0F, 1.0F, 1.0F};
};

/// A vertical line a landmark detector can be asked to find: truth for scoring.
struct SceneLandmark {
  int identity = 0;
  int kind = 0;  ///< as landmark_observation_t names kinds
  Eigen::Vector2d position_m;
  double low_m = 0.0;
  double high_m = 0.0;
};

/// Where the camera sits on the robot: looking forward, turned left by yaw and then down by pitch.
struct CameraMount {
  double x_m = 0.0;  ///< robot frame
  double y_m = 0.0;
  double z_m = 0.40;
  double yaw_rad = 0.0;
  double pitch_down_rad = 0.0;
};

/// A way for the robot: from Scene::start over the corners back to the start, so many times.
struct Path {
  std::string name;
  std::vector<Eigen::Vector2d> corners_m;  ///< without the start, world frame
  int rounds = 1;
};

/// A world at rest but for its walkers: what the renderer, the ground plan and TRUTH are made from.
struct Scene {
  std::string name;
  std::vector<Material> materials;
  std::vector<Mesh> meshes;
  std::vector<Walker> walkers;
  std::vector<Lamp> lamps;
  double ambient = 0.3;       ///< light from everywhere, 0..1
  double lamp_level = 1.0;    ///< scales lamps and ambient; 0.05 is a dark room
  std::vector<Block> blocks;  ///< plans of the solids among `meshes`
  std::vector<Column> columns;
  std::vector<Pit> pits;
  std::vector<SceneLandmark> landmarks;
  Pose2 start;  ///< robot at time 0
  CameraMount camera;
  std::vector<Path> paths;
};

/// Pose of a walker in the world at `t_s` after the start: heading along its way.
Pose2 walker_pose(const Walker& walker, double t_s);

/// Pose of the camera frame (x right, y down, z forward) in the robot frame.
Eigen::Isometry3d T_robot_camera(const CameraMount& mount);

/// The path called `name`, or nullptr.
const Path* find_path(const Scene& scene, std::string_view name);

}  // namespace roomwise::simulator
