#include "logs/tools/mrclam_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

#include "logs/tools/text_table.h"

namespace roomwise {
namespace {

/// Reads every row of `path` with `read_row`, into order of time.
template <class Row, class ReadRow>
std::vector<Row> read_timed(const std::filesystem::path& path, std::size_t fields,
                            ReadRow read_row) {
  TextTable table(path);
  std::vector<Row> rows;
  while (table.next(fields)) rows.push_back(read_row(table));
  if (rows.empty()) throw std::runtime_error(fmt::format("{}: holds no rows", path.string()));
  std::ranges::stable_sort(rows, {}, &Row::utime);
  return rows;
}

MrclamVelocity velocity_in(const TextTable& table) {
  return {table.utime(0, "time"), table.number(1, "forward velocity"),
          table.number(2, "angular velocity")};
}

MrclamMeasurement measurement_in(const TextTable& table) {
  const MrclamMeasurement measurement{table.utime(0, "time"), table.integer(1, "barcode"),
                                      table.number(2, "range"), table.number(3, "bearing")};
  if (measurement.range_m <= 0.0) table.refuse("range must be above 0");
  return measurement;
}

MrclamPose true_pose_in(const TextTable& table) {
  return {table.utime(0, "time"), table.number(1, "x"), table.number(2, "y"),
          table.number(3, "orientation")};
}

std::map<int, int> read_barcodes(const std::filesystem::path& path) {
  TextTable table(path);
  std::map<int, int> subjects;
  while (table.next(2)) {
    if (!subjects.emplace(table.integer(1, "barcode"), table.integer(0, "subject")).second) {
      table.refuse("barcode stands here twice");
    }
  }
  return subjects;
}

std::map<int, MrclamPoint> read_landmarks(const std::filesystem::path& path) {
  TextTable table(path);
  std::map<int, MrclamPoint> landmarks;
  while (table.next(3)) {
    landmarks[table.integer(0, "subject")] = {table.number(1, "x"), table.number(2, "y")};
  }
  return landmarks;
}

}  // namespace

MrclamFiles read_mrclam(const std::filesystem::path& folder, int robot) {
  const auto of_robot = [&](const char* what) {
    return folder / fmt::format("Robot{}_{}.dat", robot, what);
  };
  return {read_timed<MrclamVelocity>(of_robot("Odometry"), 3, velocity_in),
          read_timed<MrclamMeasurement>(of_robot("Measurement"), 4, measurement_in),
          read_timed<MrclamPose>(of_robot("Groundtruth"), 4, true_pose_in),
          read_barcodes(folder / "Barcodes.dat"),
          read_landmarks(folder / "Landmark_Groundtruth.dat")};
}

}  // namespace roomwise
