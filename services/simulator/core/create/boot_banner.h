#pragma once
#include <string>

namespace roomwise::simulator {

/// What a Create 2 says on its serial line after a reset, before it listens again.
inline std::string boot_banner(const std::string& firmware) {
  return "bootloader id: #x47175347 4C636FFF\r\n"
         "bootloader info rev: #xF000\r\n"
         "assembly: 3.5-lite-batt\r\n"
         "revision: 2\r\n"
         "flash version: 10\r\n"
         "flash info crc passed: 1\r\n"
         "\r\nRoomba by iRobot!\r\n"
         "stm32\r\n"
         "2018-07-19-1005-L\r\n"
         "battery-current-zero 253\r\n"
         "\r\nr3-robot/tags/release-stm32-" +
         firmware + ":6913 CLEAN\r\n";
}

}  // namespace roomwise::simulator
