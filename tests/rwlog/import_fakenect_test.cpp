#include "logs/tools/import_fakenect.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "services/kinect_pub/core/shift_depth.h"
#include "tests/rwlog/log_messages.h"
#include "tests/rwlog/written_files.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/shared_data.h"

namespace roomwise {
namespace {

using testing::HasSubstr;

class ImportFakenect : public testing::Test {
 protected:
  std::string depth_of(std::uint16_t word) {
    std::string text = "P5 640 480 65535\n";
    for (int i = 0; i < 640 * 480; ++i) {
      text += static_cast<char>(word & 0xffU);
      text += static_cast<char>(word >> 8U);
    }
    return text;
  }
  void index(const std::string& text) { write_text(import_.folder / "INDEX.txt", text); }
  std::vector<kinect_frame_t> imported() {
    import_fakenect(import_, notes_);
    return messages_on(import_.out, channels::kKinectFrame);
  }
  std::string complaint() {
    return complaint_of([&] { imported(); });
  }

  ScratchFolder folder_;
  FakenectImport import_{.folder = folder_.path() / "dump", .out = folder_.path() / "out.lcmlog"};
  std::ostringstream notes_;
};

TEST_F(ImportFakenect, WordsBecomeDepthsAndTicksTheDevicesTime) {
  index("d-1.000000-4294967280.pgm\na-1.01-7.dump\nd-1.033000-2000000.pgm\n");
  write_text(import_.folder / "d-1.000000-4294967280.pgm", depth_of(700));
  write_text(import_.folder / "d-1.033000-2000000.pgm", depth_of(2047));
  const auto frames = imported();
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0].utime, 1'000'000);
  EXPECT_EQ(frames[1].utime, 1'033'000);
  EXPECT_EQ(frames[1].device_time_us - frames[0].device_time_us, 33334);  // 16 + 2000000 ticks
  EXPECT_EQ(frames[0].color_encoding, kinect_frame_t::COLOR_NONE);
  FrameDecoder decoder(ColorUse::kDecode);
  RgbdFrame frame;
  ASSERT_EQ(decoder.decode(frames[0], frame), FrameResult::kOk);
  EXPECT_EQ(frame.depth.at(5, 5), kinect::shift_table({})[700]);
  ASSERT_EQ(decoder.decode(frames[1], frame), FrameResult::kOk);
  EXPECT_EQ(frame.depth.at(5, 5), 0);
}

TEST_F(ImportFakenect, ColourGoesWithTheDepthNearestInTime) {
  index("r-1.010000-1.ppm\nd-1.000000-1.pgm\nd-1.033000-2.pgm\n");
  write_text(import_.folder / "d-1.000000-1.pgm", depth_of(700));
  write_text(import_.folder / "d-1.033000-2.pgm", depth_of(700));
  write_text(import_.folder / "r-1.010000-1.ppm",
             "P6 640 480 255\n" + std::string(std::size_t{640} * 480 * 3, '\x40'));
  const auto frames = imported();
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0].color_encoding, kinect_frame_t::COLOR_JPEG);
  EXPECT_EQ(frames[1].color_encoding, kinect_frame_t::COLOR_NONE);
}

TEST_F(ImportFakenect, WhatIsNoDumpIsRefusedByName) {
  EXPECT_THAT(complaint(), HasSubstr("INDEX.txt: cannot read"));
  index("hello\n");
  EXPECT_THAT(complaint(), HasSubstr("names no depth image"));
  index("d-1.000000-1.pgm\n");
  EXPECT_THAT(complaint(), HasSubstr("d-1.000000-1.pgm: cannot read"));
  write_text(import_.folder / "d-1.000000-1.pgm", depth_of(700).substr(1));
  EXPECT_THAT(complaint(), HasSubstr("not a depth image"));
  EXPECT_FALSE(std::filesystem::exists(import_.out));
}

TEST_F(ImportFakenect, ARealRecordingComesThrough) {
  ROOMWISE_NEED_DATA("fakenect_dump");
  import_.folder = shared_data() / "fakenect_dump";
  const auto frames = imported();
  EXPECT_EQ(frames.size(), 15U);
  EXPECT_THAT(notes_.str(), HasSubstr("frames 15, with colour 0"));
}

}  // namespace
}  // namespace roomwise
