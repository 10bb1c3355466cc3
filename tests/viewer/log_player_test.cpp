#include "services/viewer/replay/log_player.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "services/viewer/replay/replay_desk.h"
#include "tests/support/scratch_folder.h"

namespace roomwise::viewer {
namespace {

/// KINECT_FRAME every second from 0 s on, POSE half a second later; the bytes say which.
void write_log(const std::filesystem::path& path, int seconds_long) {
  LogWriter writer(path);
  for (int i = 0; i < seconds_long; ++i) {
    const auto number = static_cast<std::uint8_t>(i);
    writer.write({time_from_utime(1'000'000 * (i + 1)), "KINECT_FRAME", {number}});
    writer.write({time_from_utime(1'000'000 * (i + 1) + 500'000), "POSE", {number}});
  }
  writer.close();
}

struct Played {
  Played()
      : player((write_log(path(), 5), path()), [this](const LogEvent& event) {
          seen.push_back(event.channel[0] + std::to_string(event.data[0]));
        }) {}
  std::filesystem::path path() const { return std::filesystem::path(folder.path()) / "a.lcmlog"; }

  ScratchFolder folder;
  std::vector<std::string> seen;
  LogPlayer player;
};

using Seen = std::vector<std::string>;

TEST(LogPlayer, PlaysWhatIsDue) {
  Played played;
  played.player.advance_to(1.2);
  EXPECT_EQ(played.seen, (Seen{"K0", "P0", "K1"}));
  EXPECT_DOUBLE_EQ(played.player.length_s(), 4.5);
}

TEST(LogPlayer, SeekShowsTheStateOfThatMomentAndGoesOnFromThere) {
  Played played;
  played.player.seek(3.2);
  EXPECT_EQ(played.seen, (Seen{"P2", "K3"}));
  played.player.advance_to(4.1);
  EXPECT_EQ(played.seen, (Seen{"P2", "K3", "P3", "K4"}));
}

TEST(LogPlayer, SeekGoesBackAndBeyondBothEnds) {
  Played played;
  played.player.seek(1e9);
  EXPECT_TRUE(played.player.at_end());
  played.player.seek(-5.0);
  EXPECT_FALSE(played.player.at_end());
  EXPECT_DOUBLE_EQ(played.player.position_s(), 0.0);
}

TEST(LogPlayer, StepsFromFrameToFrame) {
  Played played;
  played.player.step();
  played.player.step();
  EXPECT_EQ(played.seen, (Seen{"K0", "P0", "K1"}));
}

TEST(ReplayDesk, OpensNothingButTheLogsOfItsFolder) {
  ScratchFolder folder;
  const std::filesystem::path root(folder.path());
  std::filesystem::create_directories(root / "logs");
  write_log(root / "secret.lcmlog", 2);
  write_log(root / "logs" / "a.lcmlog", 2);
  ReplayDesk desk(root / "logs", [](const LogEvent&) {});
  const auto now = ReplayDesk::Clock::now();
  for (const char* order : {"open ../secret.lcmlog", "open /etc/passwd", "open ", "open", "play",
                            "seek 1", "nonsense", ""}) {
    EXPECT_NE(desk.follow(order, now), "") << order;
    EXPECT_FALSE(desk.is_replay());
  }
  EXPECT_EQ(desk.follow("open a.lcmlog", now), "");
  EXPECT_TRUE(desk.is_replay());
  for (const char* order : {"seek nan", "seek", "speed inf", "seek 1x"}) {
    EXPECT_NE(desk.follow(order, now), "") << order;
  }
  EXPECT_EQ(desk.follow("live", now), "");
  EXPECT_FALSE(desk.is_replay());
}

}  // namespace
}  // namespace roomwise::viewer
