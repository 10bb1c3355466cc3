#include "logs/tools/trajectory_file.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "logs/tools/text_table.h"

namespace roomwise {

std::string trajectory_as_tum_text(const Trajectory& trajectory) {
  std::string text = "# timestamp tx ty tz qx qy qz qw\n";
  for (const auto& [utime, pose] : trajectory) {
    const double half_rad = 0.5 * pose.heading_rad;
    fmt::format_to(std::back_inserter(text), "{}.{:06} {:.9f} {:.9f} 0 0 0 {:.9f} {:.9f}\n",
                   utime / 1000000, utime % 1000000, pose.x_m, pose.y_m, std::sin(half_rad),
                   std::cos(half_rad));
  }
  return text;
}

Trajectory read_tum_trajectory(const std::filesystem::path& path) {
  TextTable table(path);
  Trajectory trajectory;
  while (table.next(8)) {
    const double qz = table.number(6, "qz");
    const double qw = table.number(7, "qw");
    trajectory.push_back(
        {table.utime(0, "timestamp"),
         {table.number(1, "tx"), table.number(2, "ty"), wrap_angle(2.0 * std::atan2(qz, qw))}});
  }
  return trajectory;
}

}  // namespace roomwise
