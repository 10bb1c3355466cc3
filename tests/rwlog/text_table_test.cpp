#include "logs/tools/text_table.h"

#include <gtest/gtest.h>

#include "tests/rwlog/written_files.h"
#include "tests/support/scratch_folder.h"

namespace roomwise {
namespace {

class TextTableTest : public testing::Test {
 protected:
  TextTable table(const std::string& text) {
    write_text(path_, text);
    return TextTable(path_);
  }
  ScratchFolder folder_;
  std::filesystem::path path_ = folder_.path() / "t.dat";
};

TEST_F(TextTableTest, LeavesOutCommentsAndEmptyLines) {
  TextTable rows = table("# a comment\r\n\r\n  1.5 \t two \r\n3 four # more\n");
  ASSERT_TRUE(rows.next(2));
  EXPECT_EQ(rows.number(0, "x"), 1.5);
  EXPECT_EQ(rows.text(1), "two");
  ASSERT_TRUE(rows.next(2));
  EXPECT_EQ(rows.integer(0, "n"), 3);
  EXPECT_EQ(rows.size(), 2U);
  EXPECT_FALSE(rows.next(2));
}

TEST_F(TextTableTest, ComplaintsNameFileAndLine) {
  TextTable rows = table("1 2\n# no\nx nan\n");
  ASSERT_TRUE(rows.next(2));
  ASSERT_TRUE(rows.next(2));
  EXPECT_EQ(complaint_of([&] { static_cast<void>(rows.number(0, "range")); }),
            path_.string() + ":3: range must be a number, is 'x'");
  EXPECT_EQ(complaint_of([&] { static_cast<void>(rows.number(1, "range")); }),
            path_.string() + ":3: range must be a number, is 'nan'");
  EXPECT_EQ(complaint_of([&] { static_cast<void>(rows.integer(0, "barcode")); }),
            path_.string() + ":3: barcode must be a whole number, is 'x'");
}

TEST_F(TextTableTest, RefusesShortRows) {
  TextTable rows = table("1 2 3\n4\n");
  ASSERT_TRUE(rows.next(3));
  EXPECT_EQ(complaint_of([&] { static_cast<void>(rows.next(3)); }),
            path_.string() + ":2: has 1 fields, needs 3");
}

TEST_F(TextTableTest, TimesKeepTheirMicroseconds) {
  TextTable rows = table("1305031102.175304 1248446190.224 -1 1e300\n");
  ASSERT_TRUE(rows.next(4));
  EXPECT_EQ(rows.utime(0, "time"), 1305031102175304);
  EXPECT_EQ(rows.utime(1, "time"), 1248446190224000);
  EXPECT_THROW(static_cast<void>(rows.utime(2, "time")), std::runtime_error);
  EXPECT_THROW(static_cast<void>(rows.utime(3, "time")), std::runtime_error);
}

TEST_F(TextTableTest, NamesAMissingFile) {
  EXPECT_EQ(complaint_of([] { TextTable("/nowhere/x.dat"); }), "/nowhere/x.dat: cannot read");
}

}  // namespace
}  // namespace roomwise
