#include "logs/tools/cut.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/rwlog/made_log.h"
#include "tests/rwlog/written_files.h"
#include "tests/support/scratch_folder.h"

namespace roomwise {
namespace {

std::vector<LogEvent> events_in(const std::filesystem::path& log) {
  LogReader reader(log);
  std::vector<LogEvent> events;
  LogEvent event;
  while (reader.next(event)) events.push_back(event);
  return events;
}

class Cut : public testing::Test {
 protected:
  Cut() { write_log(cut_.log, made_drive()); }

  ScratchFolder folder_;
  LogCut cut_{.log = folder_.path() / "in.lcmlog", .out = folder_.path() / "out.lcmlog"};
};

RC_GTEST_FIXTURE_PROP(Cut, PartsOfALogPutTogetherAreTheLog, ()) {
  const double at_s = 0.05 + 0.1 * *rc::gen::inRange(0, 50);
  cut_.from_s = 0.0;
  cut_.to_s = at_s;
  const std::uint64_t kept = cut_log(cut_);
  auto events = events_in(cut_.out);
  RC_ASSERT(events.size() == kept);
  cut_.from_s = at_s;
  cut_.to_s = std::nullopt;
  cut_log(cut_);
  for (const LogEvent& event : events_in(cut_.out)) events.push_back(event);
  RC_ASSERT(events == made_drive());
}

TEST_F(Cut, KeepsTheChannelsAskedFor) {
  cut_.channels = {"POSE", "LANDMARK_MAP"};
  EXPECT_EQ(cut_log(cut_), 52U);
  cut_.channels = {};
  cut_.without = {"POSE"};
  EXPECT_EQ(cut_log(cut_), made_drive().size() - 51);
}

TEST_F(Cut, WithNothingLeftAnOlderFileStays) {
  write_text(cut_.out, "older");
  cut_.channels = {"HEALTH"};
  EXPECT_THAT(complaint_of([&] { cut_log(cut_); }), testing::HasSubstr("nothing in it"));
  EXPECT_EQ(read_text(cut_.out), "older");
}

TEST_F(Cut, OfADamagedLogKeepsWhatIsWholeAndComplains) {
  std::filesystem::resize_file(cut_.log, std::filesystem::file_size(cut_.log) - 5);
  EXPECT_THAT(complaint_of([&] { cut_log(cut_); }), testing::HasSubstr("damaged at byte"));
  EXPECT_EQ(events_in(cut_.out).size(), made_drive().size() - 1);
}

}  // namespace
}  // namespace roomwise
