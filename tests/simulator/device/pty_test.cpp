#include "services/simulator/device/pty.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>

#include "tests/support/scratch_folder.h"

namespace roomwise::simulator {
namespace {

using Bytes = std::vector<std::uint8_t>;

class PtyTest : public ::testing::Test {
 protected:
  ~PtyTest() override {
    if (host >= 0) ::close(host);
  }
  /// Opens the port as a host does.
  void open_host(speed_t speed = B115200) {
    host = ::open(link.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK);
    ASSERT_GE(host, 0);
    termios settings{};
    ASSERT_EQ(::tcgetattr(host, &settings), 0);
    ::cfmakeraw(&settings);
    ::cfsetspeed(&settings, speed);
    ASSERT_EQ(::tcsetattr(host, TCSANOW, &settings), 0);
  }
  Bytes host_reads() const {
    Bytes bytes(100'000);
    const ssize_t got = ::read(host, bytes.data(), bytes.size());
    bytes.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    return bytes;
  }
  void host_writes(const Bytes& bytes) const {
    ASSERT_EQ(::write(host, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  }

  ScratchFolder folder;
  std::filesystem::path link = folder.path() / "ports" / "create";
  int host = -1;
};

TEST_F(PtyTest, EveryByteValueGoesBothWaysUnchanged) {
  Pty pty(link);
  open_host();
  Bytes all(256);
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::uint8_t>(i);
  EXPECT_EQ(pty.write(all), 0U);
  EXPECT_EQ(host_reads(), all);
  host_writes(all);
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
  open_host(B57600);
  EXPECT_EQ(pty.host_baud(), 57600);
  termios settings{};
  ::tcgetattr(host, &settings);
  ::cfsetspeed(&settings, B19200);
  ::tcsetattr(host, TCSANOW, &settings);
  EXPECT_EQ(pty.host_baud(), 19200);
}

TEST_F(PtyTest, HostsComeAndGo) {
  Pty pty(link);
  for (int i = 0; i < 3; ++i) {
    open_host();
    host_writes({128});
    Bytes received;
    pty.read(10, received);
    EXPECT_EQ(received, Bytes{128});
    ::close(host);
    host = -1;
    pty.read(10, received);
    EXPECT_EQ(received.size(), 1U) << "no error while nobody is there";
  }
}

TEST_F(PtyTest, WhatAHostDoesNotReadIsLostNotWaitedFor) {
  Pty pty(link);
  open_host();
  std::size_t lost = 0;
  for (int i = 0; i < 100; ++i) lost += pty.write(Bytes(1000));
  EXPECT_GT(lost, 50'000U);
  EXPECT_LT(lost, 99'000U);
}

TEST_F(PtyTest, ReadsNoMoreThanAsked) {
  Pty pty(link);
  open_host();
  host_writes(Bytes(100, 7));
  Bytes received;
  pty.read(30, received);
  EXPECT_EQ(received.size(), 30U);
  pty.read(0, received);
  EXPECT_EQ(received.size(), 30U);
}

TEST_F(PtyTest, AHangUpIsFeltAndTheNameComesBack) {
  Pty pty(link);
  open_host();
  pty.hang_up();
  EXPECT_FALSE(std::filesystem::exists(std::filesystem::symlink_status(link)));
  pollfd waiting{.fd = host, .events = POLLIN, .revents = 0};
  EXPECT_EQ(::poll(&waiting, 1, 0), 1);
  EXPECT_NE(waiting.revents & POLLHUP, 0);
  EXPECT_EQ(pty.host_baud(), 0);
  EXPECT_EQ(pty.write(Bytes{1}), 1U);
  ::close(host);
  pty.reopen();
  open_host();
  EXPECT_EQ(pty.write(Bytes{1, 2}), 0U);
  EXPECT_EQ(host_reads(), (Bytes{1, 2}));
}

TEST_F(PtyTest, ALinkLeftBehindIsReplaced) {
  std::filesystem::create_directories(link.parent_path());
  std::filesystem::create_symlink("/dev/pts/nowhere", link);
  Pty pty(link);
  open_host();
  EXPECT_EQ(pty.write(Bytes{5}), 0U);
  EXPECT_EQ(host_reads(), Bytes{5});
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
