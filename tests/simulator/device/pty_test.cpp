#include "services/simulator/device/pty.h"

#include <gtest/gtest.h>

#include <fstream>
#include <memory>

#include "tests/simulator/support/host_port.h"
#include "tests/support/scratch_folder.h"

namespace roomwise::simulator {
namespace {

using Bytes = std::vector<std::uint8_t>;

class PtyTest : public ::testing::Test {
 protected:
  ScratchFolder folder;
  std::filesystem::path link = folder.path() / "ports" / "create";
};

TEST_F(PtyTest, EveryByteValueGoesBothWaysUnchanged) {
  Pty pty(link);
  const HostPort host(link);
  Bytes all(256);
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::uint8_t>(i);
  EXPECT_EQ(pty.write(all), 0U);
  EXPECT_EQ(host.read(), all);
  EXPECT_TRUE(host.write(all));
  Bytes received;
  pty.read(1000, received);
  EXPECT_EQ(received, all);
}

TEST_F(PtyTest, NothingIsEchoedBeforeAHostComes) {
  Pty pty(link);
  EXPECT_EQ(pty.write(Bytes{19, 1, 2, 3}), 0U);
  Bytes received;
  pty.read(1000, received);
  EXPECT_TRUE(received.empty());
}

TEST_F(PtyTest, KnowsTheSpeedTheHostSets) {
  Pty pty(link);
  EXPECT_EQ(pty.host_baud(), 38400);
  const HostPort host(link, B57600);
  EXPECT_EQ(pty.host_baud(), 57600);
  host.set_speed(B19200);
  EXPECT_EQ(pty.host_baud(), 19200);
}

TEST_F(PtyTest, HostsComeAndGo) {
  Pty pty(link);
  for (int i = 0; i < 3; ++i) {
    const HostPort host(link);
    EXPECT_TRUE(host.write({128}));
    Bytes received;
    pty.read(10, received);
    EXPECT_EQ(received, Bytes{128});
  }
  Bytes received;
  pty.read(10, received);
  EXPECT_TRUE(received.empty()) << "no error while nobody is there";
  EXPECT_TRUE(pty.is_open());
}

TEST_F(PtyTest, WhatAHostDoesNotReadIsLostNotWaitedFor) {
  Pty pty(link);
  const HostPort host(link);
  std::size_t lost = 0;
  for (int i = 0; i < 100; ++i) lost += pty.write(Bytes(1000));
  EXPECT_GT(lost, 50'000U);
  EXPECT_LT(lost, 99'000U);
}

TEST_F(PtyTest, ReadsNoMoreThanAsked) {
  Pty pty(link);
  const HostPort host(link);
  EXPECT_TRUE(host.write(Bytes(100, 7)));
  Bytes received;
  pty.read(30, received);
  EXPECT_EQ(received.size(), 30U);
  pty.read(0, received);
  EXPECT_EQ(received.size(), 30U);
}

TEST_F(PtyTest, AHangUpIsFeltAndTheNameComesBack) {
  Pty pty(link);
  const HostPort host(link);
  pty.hang_up();
  EXPECT_FALSE(std::filesystem::exists(std::filesystem::symlink_status(link)));
  EXPECT_TRUE(host.has_hung_up());
  EXPECT_EQ(pty.host_baud(), 0);
  EXPECT_EQ(pty.write(Bytes{1}), 1U);
  pty.reopen();
  const HostPort again(link);
  EXPECT_EQ(pty.write(Bytes{1, 2}), 0U);
  EXPECT_EQ(again.read(), (Bytes{1, 2}));
}

TEST_F(PtyTest, ALinkLeftBehindIsReplaced) {
  std::filesystem::create_directories(link.parent_path());
  std::filesystem::create_symlink("/dev/pts/nowhere", link);
  Pty pty(link);
  const HostPort host(link);
  EXPECT_EQ(pty.write(Bytes{5}), 0U);
  EXPECT_EQ(host.read(), Bytes{5});
}

TEST_F(PtyTest, ItsEndLeavesAnothersLinkAlone) {
  auto first = std::make_unique<Pty>(link);
  const Pty second(link);
  first.reset();
  EXPECT_TRUE(std::filesystem::exists(link));
}

TEST_F(PtyTest, AFileInTheWayIsNamed) {
  std::filesystem::create_directories(link.parent_path());
  std::ofstream(link) << "precious";
  try {
    const Pty pty(link);
    FAIL() << "took the place of a file";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(link.string()), std::string::npos);
  }
  EXPECT_EQ(std::filesystem::file_size(link), 8U);
}

}  // namespace
}  // namespace roomwise::simulator
