#pragma once
#include <rapidcheck/gtest.h>

#include <numbers>

#include "logs/tools/alignment.h"
#include "logs/tools/trajectory.h"

namespace roomwise {

/// A number in [low, high], in steps of a thousandth of that.
inline rc::Gen<double> number_between(double low, double high) {
  return rc::gen::map(rc::gen::inRange(0, 1001),
                      [=](int step) { return low + (high - low) * step / 1000.0; });
}

inline rc::Gen<Pose2> any_pose() {
  return rc::gen::apply(
      [](double x_m, double y_m, double heading_rad) {
        return Pose2{x_m, y_m, wrap_angle(heading_rad)};
      },
      number_between(-20.0, 20.0), number_between(-20.0, 20.0),
      number_between(-std::numbers::pi, std::numbers::pi));
}

/// Poses 0.1 s apart.
inline rc::Gen<Trajectory> any_trajectory(std::size_t fewest) {
  return rc::gen::map(rc::gen::suchThat(rc::gen::container<std::vector<Pose2>>(any_pose()),
                                        [=](const auto& poses) { return poses.size() >= fewest; }),
                      [](const std::vector<Pose2>& poses) {
                        Trajectory trajectory;
                        std::int64_t utime = 1'000'000;
                        for (const Pose2& pose : poses) {
                          trajectory.push_back({utime += 100'000, pose});
                        }
                        return trajectory;
                      });
}

/// The same trajectory seen from another frame.
inline Trajectory moved(const Pose2& T_b_a, Trajectory trajectory) {
  for (TimedPose2& timed : trajectory) timed.pose = compose(T_b_a, timed.pose);
  return trajectory;
}

}  // namespace roomwise
