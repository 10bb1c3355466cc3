#include "common/bus/log_file.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <fstream>
#include <lcm/lcm-cpp.hpp>

#include "tests/support/scratch_folder.h"

namespace roomwise {
namespace {

using Bytes = std::vector<std::uint8_t>;

LogEvent make_event(std::int64_t utime, std::string channel, Bytes data) {
  return {.time = time_from_utime(utime), .channel = std::move(channel), .data = std::move(data)};
}

std::vector<LogEvent> read_all(LogReader& reader) {
  std::vector<LogEvent> events;
  for (LogEvent event; reader.next(event);) events.push_back(event);
  return events;
}

class LogFileTest : public ::testing::Test {
 protected:
  LogFileTest() : path_(folder_.path() / "run.lcmlog") {}

  void write(const std::vector<LogEvent>& events) {
    LogWriter writer(path_);
    for (const LogEvent& event : events) writer.write(event);
    writer.close();
  }
  Bytes file_bytes() {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void set_file_bytes(const Bytes& bytes) {
    std::ofstream file(path_, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  }
  /// Three events of 28 + 1 + 3, 28 + 2 + 0 and 28 + 1 + 4 bytes: [0,32) [32,62) [62,95).
  const std::vector<LogEvent> three_ = {make_event(1, "A", {1, 2, 3}), make_event(2, "BB", {}),
                                        make_event(3, "C", {9, 9, 9, 9})};
  ScratchFolder folder_;
  std::filesystem::path path_;
};

RC_GTEST_FIXTURE_PROP(LogFileTest, WhatIsWrittenIsReadBack,
                      (const std::vector<std::pair<std::int64_t, Bytes>>& contents)) {
  std::vector<LogEvent> events;
  for (const auto& [utime, data] : contents) events.push_back(make_event(utime, "CHANNEL", data));
  write(events);
  LogReader reader(path_);
  const auto back = read_all(reader);
  RC_ASSERT(back.size() == events.size());
  for (std::size_t i = 0; i < back.size(); ++i) RC_ASSERT(back[i] == events[i]);
  RC_ASSERT(reader.damage().empty());
}

TEST_F(LogFileTest, CutAnywhereKeepsEveryWholeEventAndSaysWhereTheDamageStarts) {
  write(three_);
  const Bytes whole = file_bytes();
  ASSERT_EQ(whole.size(), 95U);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    set_file_bytes(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)));
    const std::size_t whole_events = size < 32 ? 0 : size < 62 ? 1 : 2;
    const std::uint64_t starts[] = {0, 32, 62};
    LogReader reader(path_);
    EXPECT_EQ(read_all(reader).size(), whole_events) << size;
    if (size == starts[whole_events]) {
      EXPECT_TRUE(reader.damage().empty()) << size;
    } else {
      ASSERT_EQ(reader.damage().size(), 1U) << size;
      EXPECT_EQ(reader.damage()[0].first_byte, starts[whole_events]) << size;
    }
  }
}

TEST_F(LogFileTest, AnyFlippedBitCostsAtMostItsOwnEvent) {
  write(three_);
  const Bytes whole = file_bytes();
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    Bytes flipped = whole;
    flipped[bit / 8] = static_cast<std::uint8_t>(flipped[bit / 8] ^ (1U << (bit % 8)));
    set_file_bytes(flipped);
    LogReader reader(path_);
    const auto events = read_all(reader);
    int intact = 0;
    for (const LogEvent& event : three_) {
      for (const LogEvent& got : events) intact += got == event ? 1 : 0;
    }
    EXPECT_GE(intact, bit / 8 >= 4 && bit / 8 < 12 ? 3 : 2) << "bit " << bit;
  }
}

TEST_F(LogFileTest, ReportsDamageByByte) {
  write(three_);
  Bytes bytes = file_bytes();
  bytes.insert(bytes.begin() + 32, {7, 7, 7});
  set_file_bytes(bytes);
  LogReader reader(path_);
  EXPECT_EQ(read_all(reader).size(), 3U);
  EXPECT_EQ(reader.damage_report(), path_.string() + ": damaged at byte 32: 3 bytes passed over");
}

TEST_F(LogFileTest, LcmReadsOurLogs) {
  write(three_);
  lcm::LogFile theirs(path_.string(), "r");
  for (const LogEvent& expected : three_) {
    const lcm::LogEvent* event = theirs.readNextEvent();
    ASSERT_NE(event, nullptr);
    EXPECT_EQ(event->channel, expected.channel);
    EXPECT_EQ(event->timestamp, utime_of(expected.time));
    EXPECT_EQ(event->datalen, static_cast<int>(expected.data.size()));
  }
  EXPECT_EQ(theirs.readNextEvent(), nullptr);
}

TEST_F(LogFileTest, WeReadLcmsLogs) {
  {
    lcm::LogFile theirs(path_.string(), "w");
    Bytes data = {1, 2, 3};
    lcm::LogEvent event{};
    event.timestamp = 5;
    event.channel = "A";
    event.datalen = 3;
    event.data = data.data();
    theirs.writeEvent(&event);
  }
  LogReader reader(path_);
  const auto events = read_all(reader);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_TRUE(events[0] == make_event(5, "A", {1, 2, 3}));
}

TEST_F(LogFileTest, ErrorsNameTheFile) {
  const auto message_of = [](auto&& action) -> std::string {
    try {
      action();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  const auto missing = folder_.path() / "missing.lcmlog";
  EXPECT_NE(message_of([&] { LogReader reader(missing); }).find(missing.string()),
            std::string::npos);
  EXPECT_NE(message_of([&] { LogReader reader(folder_.path()); }).find("not a regular file"),
            std::string::npos);
  EXPECT_NE(message_of([&] { LogWriter writer(folder_.path() / "no/folder"); }).find("no/folder"),
            std::string::npos);
  EXPECT_NE(message_of([] {
              LogWriter writer("/dev/full");
              for (int i = 0; i < 100; ++i) writer.write(make_event(0, "A", Bytes(1000)));
            }).find("/dev/full"),
            std::string::npos);
}

}  // namespace
}  // namespace roomwise
