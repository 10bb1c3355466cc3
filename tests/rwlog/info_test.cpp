#include "logs/tools/info.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/rwlog/made_log.h"
#include "tests/rwlog/written_files.h"
#include "tests/support/scratch_folder.h"

namespace roomwise {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

class Info : public testing::Test {
 protected:
  ScratchFolder folder_;
  std::filesystem::path log_ = folder_.path() / "a.lcmlog";
};

TEST_F(Info, CountsRatesGapsAndMisses) {
  std::vector<LogEvent> events = made_drive();
  std::erase_if(events, [i = 0](const LogEvent& event) mutable {
    if (event.channel != "POSE") return false;
    ++i;
    return i == 20 || i == 21;
  });
  LogEvent foreign;
  foreign.time = time_from_utime(kMade_utime);
  foreign.channel = "SOMEBODY_ELSE";
  foreign.data = {1, 2, 3};
  events.push_back(foreign);
  events[0].data[3] ^= 1U;  // another fingerprint
  write_log(log_, events);
  const LogInfo info = describe_log(log_);
  EXPECT_EQ(info.damage, "");
  EXPECT_THAT(info.text, HasSubstr("duration  5.000000 s"));
  EXPECT_THAT(info.text, HasSubstr("2017-07-14 02:40:00 UTC"));
  EXPECT_THAT(info.text, ContainsRegex("POSE +pose_t +49 +9.60 +0.300 +2 +0 +0 "));
  EXPECT_THAT(info.text, ContainsRegex("TRUTH +truth_t +51 +10.00 +0.100 +0 +0 +1 "));
  EXPECT_THAT(info.text, ContainsRegex("SOMEBODY_ELSE +unknown +1 +0.00 +0.000 +0 +0 +0 +3\n"));
}

TEST_F(Info, SaysAtWhichByteALogIsCut) {
  write_log(log_, made_drive());
  const auto size = std::filesystem::file_size(log_);
  std::filesystem::resize_file(log_, size - 5);
  const LogInfo info = describe_log(log_);
  EXPECT_THAT(info.damage, HasSubstr("a.lcmlog: damaged at byte "));
  EXPECT_THAT(info.text, ContainsRegex("POSE +pose_t +51 "));
  EXPECT_THAT(info.text, testing::Not(HasSubstr("LANDMARK_MAP")));
}

TEST_F(Info, AnEmptyLogHasNoMessagesAndAMissingOneIsNamed) {
  write_text(log_, "");
  EXPECT_THAT(describe_log(log_).text, HasSubstr("messages  0"));
  EXPECT_THAT(complaint_of([] { describe_log("/nowhere/a.lcmlog"); }),
              HasSubstr("/nowhere/a.lcmlog"));
}

TEST_F(Info, AbsurdTimesAreJustNumbers) {
  std::vector<LogEvent> events = made_drive();
  events[0].time = time_from_utime(std::numeric_limits<std::int64_t>::max());
  events[1].time = time_from_utime(std::numeric_limits<std::int64_t>::min());
  write_log(log_, events);
  EXPECT_THAT(describe_log(log_).text, HasSubstr("POSE"));
}

}  // namespace
}  // namespace roomwise
