#include "services/simulator/core/create/serial_line.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numeric>

namespace roomwise::simulator {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes count_to(std::size_t n) {
  Bytes bytes(n);
  std::iota(bytes.begin(), bytes.end(), std::uint8_t{0});
  return bytes;
}

RC_GTEST_PROP(SerialLine, BytesArriveInOrderAndNoFasterThanTheBaudRate, ()) {
  const int baud = *rc::gen::element(9600, 19200, 57600, 115200);
  SerialLine line;
  Bytes sent;
  Bytes arrived;
  Duration now{0};
  for (int ms = 0; ms < 300; ++ms) {
    if (ms < 50) {
      const Bytes more = count_to(*rc::gen::inRange<std::size_t>(0, 20));
      line.send(more);
      sent.insert(sent.end(), more.begin(), more.end());
    }
    now += Duration(1'000);
    line.advance(now, baud, arrived);
    const double most = 1e-6 * static_cast<double>(now.count()) * baud / 10.0;
    RC_ASSERT(static_cast<double>(arrived.size()) <= 1.0001 * most);
    RC_ASSERT(arrived.size() + line.waiting() == sent.size());
  }
  sent.resize(arrived.size());
  RC_ASSERT(arrived == sent);
}

TEST(SerialLine, AnIdleLineSavesUpNothing) {
  SerialLine line;
  Bytes arrived;
  line.advance(Duration(1'000'000), 115200, arrived);
  line.send(count_to(100));
  line.advance(Duration(1'001'000), 115200, arrived);
  EXPECT_EQ(arrived.size(), 11U);
  line.advance(Duration(1'009'000), 115200, arrived);
  EXPECT_EQ(arrived.size(), 100U);
}

TEST(SerialLine, DropsWhatItsMemoryDoesNotHold) {
  SerialLine line;
  line.send(Bytes(5000));
  EXPECT_EQ(line.lost(), 5000 - 4096);
  EXPECT_EQ(line.waiting(), 4096U);
}

TEST(BaudMismatch, SameRateIsClean) {
  EXPECT_EQ(received_at(count_to(256), 57600, 57600), count_to(256));
}

RC_GTEST_PROP(BaudMismatch, AnotherRateIsGarbage, ()) {
  constexpr int kBauds[] = {300, 9600, 19200, 38400, 57600, 115200};
  const int from = *rc::gen::elementOf(std::vector<int>(std::begin(kBauds), std::end(kBauds)));
  const int to =
      *rc::gen::suchThat(rc::gen::elementOf(std::vector<int>(std::begin(kBauds), std::end(kBauds))),
                         [from](int baud) { return baud != from; });
  RC_ASSERT(received_at(count_to(256), from, to) != count_to(256));
}

TEST(BaudMismatch, AFasterReceiverSeesSeveralBytesInOne) {
  EXPECT_GE(received_at(Bytes{0x55}, 19200, 115200).size(), 3U);
}

TEST(BaudMismatch, NearlyRightIsRightAsOnARealLine) {
  EXPECT_EQ(received_at(count_to(256), 115200, 116000), count_to(256));
}

}  // namespace
}  // namespace roomwise::simulator
