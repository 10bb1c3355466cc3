// pilot_goal, the program, with and without a pilot_svc to answer it.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/build_paths.h"
#include "tests/support/child_process.h"
#include "tests/support/private_network.h"
#include "tests/support/scratch_folder.h"

namespace roomwise {
namespace {

const std::string kUrl = "udpm://239.255.76.67:27769?ttl=0";

class PilotGoal : public testing::Test {
 protected:
  void SetUp() override { enter_private_network(); }

  int give(std::vector<std::string> words) {
    words.insert(words.begin(), program("pilot_goal"));
    words.insert(words.end(), {"--url", kUrl});
    return run_to_end(words, said_);
  }

  ScratchFolder folder_;
  std::string said_;
};

TEST_F(PilotGoal, EndsOnceTheGoalIsTaken) {
  ChildProcess pilot({program("pilot_svc"), "--url", kUrl}, folder_.path() / "pilot_svc");
  EXPECT_EQ(give({"wander"}), 0) << said_;
  EXPECT_EQ(give({"stop", "--until_done"}), 0) << said_;
}

TEST_F(PilotGoal, WhatFailsIsSaidInWords) {
  ChildProcess pilot({program("pilot_svc"), "--url", kUrl}, folder_.path() / "pilot_svc");
  EXPECT_EQ(give({"circle", "--distance_m", "-1", "--until_done"}), 1);
  EXPECT_NE(said_.find("the goal cannot be meant"), std::string::npos) << said_;
}

TEST_F(PilotGoal, NobodyToTakeItIsSaid) {
  EXPECT_EQ(give({"wander"}), 1);
  EXPECT_NE(said_.find("no pilot_svc answers"), std::string::npos) << said_;
}

TEST_F(PilotGoal, AnUnknownBehaviourIsRefused) { EXPECT_NE(give({"fly"}), 0); }

}  // namespace
}  // namespace roomwise
