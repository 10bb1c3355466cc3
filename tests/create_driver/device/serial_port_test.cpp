#include "services/create_driver/device/serial_port.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <stdexcept>

#include "tests/support/scratch_folder.h"

namespace roomwise::create {
namespace {

using ::testing::HasSubstr;

class SerialPortTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::array<char, 128> name{};
    int slave = -1;
    ASSERT_EQ(::openpty(&master_, &slave, name.data(), nullptr, nullptr), 0);
    ::close(slave);
    path_ = name.data();
  }
  void TearDown() override { unplug(); }
  void unplug() {
    if (master_ >= 0) ::close(master_);
    master_ = -1;
  }
  static std::string error_of(const std::filesystem::path& path) {
    try {
      const SerialPort port(path, 115200);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return {};
  }

  int master_ = -1;
  std::filesystem::path path_;
};

TEST_F(SerialPortTest, SetsTheSpeedAndARawLine) {
  const SerialPort port(path_, 57600);
  termios line{};
  ASSERT_EQ(::tcgetattr(port.fd(), &line), 0);
  EXPECT_EQ(::cfgetospeed(&line), static_cast<speed_t>(B57600));
  EXPECT_EQ(line.c_lflag & static_cast<tcflag_t>(ECHO | ICANON | ISIG), 0U);
  EXPECT_EQ(line.c_oflag & static_cast<tcflag_t>(OPOST), 0U);
}

TEST_F(SerialPortTest, BytesPassUnchangedBothWays) {
  SerialPort port(path_, 115200);
  std::vector<std::uint8_t> all(256);
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::uint8_t>(i);
  ASSERT_TRUE(port.write(all));
  std::vector<std::uint8_t> out(all.size());
  ASSERT_EQ(::read(master_, out.data(), out.size()), 256);
  EXPECT_EQ(out, all);
  ASSERT_EQ(::write(master_, all.data(), all.size()), 256);
  std::vector<std::uint8_t> in;
  ASSERT_TRUE(port.read(in));
  EXPECT_EQ(in, all);
}

TEST_F(SerialPortTest, NothingArrivedIsNotTheEnd) {
  SerialPort port(path_, 115200);
  std::vector<std::uint8_t> bytes;
  EXPECT_TRUE(port.read(bytes));
  EXPECT_TRUE(bytes.empty());
}

TEST_F(SerialPortTest, UnpluggedIsTheEnd) {
  SerialPort port(path_, 115200);
  unplug();
  std::vector<std::uint8_t> bytes;
  EXPECT_FALSE(port.read(bytes));
  EXPECT_FALSE(port.write(std::vector<std::uint8_t>{1}));
}

TEST_F(SerialPortTest, ALineThatTakesNothingIsTheEnd) {
  SerialPort port(path_, 115200);
  const std::vector<std::uint8_t> much(1 << 20);
  EXPECT_FALSE(port.write(much));
}

TEST_F(SerialPortTest, IsOursAlone) {
  const SerialPort port(path_, 115200);
  EXPECT_THAT(error_of(path_), HasSubstr("in use by another process"));
}

TEST_F(SerialPortTest, CanBeOpenedAgainWhenItWasClosed) {
  { const SerialPort port(path_, 115200); }
  EXPECT_EQ(error_of(path_), "");
}

TEST_F(SerialPortTest, ModemLinesAreOptional) {
  SerialPort port(path_, 115200);
  port.set_wake_line("rts", true);
  port.set_wake_line("none", true);
  EXPECT_TRUE(port.write(std::vector<std::uint8_t>{128}));
}

TEST_F(SerialPortTest, ErrorsNameThePort) {
  const ScratchFolder folder;
  EXPECT_THAT(error_of(folder.path() / "nothing"), HasSubstr("nothing: cannot open"));
  const auto file = folder.path() / "file";
  std::ofstream(file) << "x";
  EXPECT_THAT(error_of(file), HasSubstr("file: is no serial port"));
}

}  // namespace
}  // namespace roomwise::create
