#include "common/create/boot_text.h"

#include <gtest/gtest.h>

namespace roomwise::create {
namespace {

BootTextReader read(std::string_view text) {
  BootTextReader reader;
  for (const char c : text) reader.accept(static_cast<std::uint8_t>(c));
  return reader;
}

TEST(BootText, NamesTheFirmware) {
  EXPECT_EQ(firmware_in("r3-robot/tags/release-stm32-3.7.7:6913 CLEAN"), (Firmware{3, 7, 7}));
  EXPECT_EQ(firmware_in("r3_robot/tags/release-3.4.1:5858"), (Firmware{3, 4, 1}));
  EXPECT_EQ(firmware_in("release-"), std::nullopt);
  EXPECT_EQ(firmware_in("release-3."), std::nullopt);
  EXPECT_EQ(firmware_in("release-99999999999.1.1"), std::nullopt);
}

TEST(BootText, IsKnownByItsLines) {
  const BootTextReader reader = read(
      "\xff\x13Roomba by iRobot!\r\nstm32\r\n2018-07-19-1005-L\r\nbattery-current-zero 253\r\n"
      "\r\nr3-robot/tags/release-stm32-3.7.7:6913 CLEAN\r\n");
  EXPECT_EQ(reader.boot_lines(), 3);
  EXPECT_EQ(reader.firmware(), (Firmware{3, 7, 7}));
}

TEST(BootText, OtherBytesAreNotTakenForIt) {
  EXPECT_EQ(read("hello\r\nworld\r\n").boot_lines(), 0);
  EXPECT_EQ(read("by iRo\x80"
                 "bot\r\n")
                .boot_lines(),
            0);
  EXPECT_EQ(read(std::string(100'000, 'x') + "by iRobot\r\n").boot_lines(), 0);
}

}  // namespace
}  // namespace roomwise::create
