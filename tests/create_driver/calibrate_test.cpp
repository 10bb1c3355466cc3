// The real create_calibrate and its guardian on a pseudo-terminal, with answers typed ahead.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "common/params/params.h"
#include "services/create_driver/core/create_params.h"
#include "tests/create_driver/support/scripted_robot.h"
#include "tests/support/build_paths.h"
#include "tests/support/child_process.h"
#include "tests/support/scratch_folder.h"

namespace roomwise::create {
namespace {

class CreateCalibrate : public ::testing::Test {
 protected:
  /// Exit status of a run that is given `answers`. Where the machine stands still for a tenth of a
  /// second the driver stops the robot, and rightly so: that run says nothing, and is made again.
  int calibrate(const std::string& answers) {
    const int status = calibrate_once(answers);
    const bool has_stalled = said_.find("the robot stopped obeying") != std::string::npos;
    return has_stalled ? calibrate_once(answers) : status;
  }

  int calibrate_once(const std::string& answers) {
    const std::string params = folder_.path() / "params.toml";
    std::ofstream(params) << "port = \"" << (folder_.path() / "create").string() << "\"\n";
    std::ofstream(folder_.path() / "answers") << answers;
    const std::string command = program("create_calibrate") + " --params " + params + " --result " +
                                result().string() + " --distance 0.3 --turns 0.5 < " +
                                (folder_.path() / "answers").string();
    return run_to_end({"sh", "-c", command}, said_);
  }
  std::filesystem::path result() const { return folder_.path() / "wheels.toml"; }

  ScratchFolder folder_;
  ScriptedRobot robot_{folder_.path() / "create"};
  std::string said_;
};

TEST_F(CreateCalibrate, FindsTheWheelsTheRobotHas) {
  // The tape measure says 2 % more than odometry will, the eye that the turn was whole.
  ASSERT_EQ(calibrate("y\n0.31\n0\ny\n1\n"), 0) << said_;
  const auto params = load_params<CreateParams>(result());
  EXPECT_NEAR(params.wheels.wheel_diameter_m, 0.0735, 0.0015);
  EXPECT_NEAR(params.wheels.left_scale_ratio, 1.0, 0.01);
  EXPECT_NEAR(params.wheels.wheel_base_m, 0.24, 0.012);
  EXPECT_EQ(robot_.mode(), OiMode::kPassive);
}

TEST_F(CreateCalibrate, DoesNotMoveWithoutLeave) {
  EXPECT_EQ(calibrate("n\n"), 1) << said_;
  EXPECT_EQ(robot_.stopped_at(), ScriptedRobot::Clock::time_point{});
  EXPECT_EQ(robot_.mode(), OiMode::kPassive);
  EXPECT_FALSE(std::filesystem::exists(result()));
}

TEST_F(CreateCalibrate, NonsenseMeasuredIsNotWritten) {
  EXPECT_EQ(calibrate("y\nfar\n0.9\n0\ny\n0\n"), 1) << said_;
  EXPECT_NE(said_.find("measure again"), std::string::npos) << said_;
  EXPECT_FALSE(std::filesystem::exists(result()));
}

}  // namespace
}  // namespace roomwise::create
