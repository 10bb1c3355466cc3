// The map on disk, and a process killed while it writes.
#include "services/ekf_svc/map_file.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <thread>

#include "services/ekf_svc/core/map_codec.h"
#include "tests/support/scratch_folder.h"

namespace roomwise {
namespace {

/// Landmarks in a row, all of generation `number`.
ekf::MapSnapshot map_number(std::int64_t number, std::size_t landmarks) {
  ekf::MapSnapshot map;
  map.landmarks.resize(landmarks);
  map.positions_m.resize(landmarks);
  for (std::size_t l = 0; l < landmarks; ++l) {
    map.landmarks[l].map_id = static_cast<std::int64_t>(l) + 1;
    map.landmarks[l].times_seen = static_cast<std::int32_t>(number);
    map.positions_m[l] = {static_cast<double>(l), static_cast<double>(number)};
  }
  map.covariance_m2.assign(landmarks * (2 * landmarks + 1), 0.0);
  for (std::size_t i = 0; i < 2 * landmarks; ++i) {
    map.covariance_m2[i * 2 * landmarks - i * (i + 1) / 2 + i] = 0.01;
  }
  map.next_map_id = static_cast<std::int64_t>(landmarks) + 1;
  return map;
}

void flip_a_bit(const std::filesystem::path& path) {
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(100);
  const int byte = file.peek();
  file.seekp(100);
  file.put(static_cast<char>(byte ^ 4));
}

class MapFileTest : public testing::Test {
 protected:
  ScratchFolder folder_;
  std::filesystem::path path_ = folder_.path() / "room.map";
  MapFile file_{path_};
};

TEST_F(MapFileTest, NoFileIsNoMapAndNoComplaint) {
  const auto loaded = file_.load();
  EXPECT_TRUE(loaded.map.empty());
  EXPECT_TRUE(loaded.complaint.empty());
}

TEST_F(MapFileTest, TheNewestMapComesBack) {
  for (int number = 1; number <= 3; ++number) file_.save(map_number(number, 10));
  EXPECT_EQ(file_.load().map.landmarks.at(0).times_seen, 3);
}

TEST_F(MapFileTest, ADamagedMapIsPutAsideAndTheOneBeforeTaken) {
  file_.save(map_number(1, 10));
  file_.save(map_number(2, 10));
  flip_a_bit(path_);
  const auto loaded = file_.load();
  EXPECT_EQ(loaded.map.landmarks.at(0).times_seen, 1);
  EXPECT_NE(loaded.complaint.find("checksum"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(path_.string() + ".damaged"));
}

TEST_F(MapFileTest, AFolderThatIsNotThereIsNamed) {
  const MapFile nowhere(folder_.path() / "no" / "room.map");
  EXPECT_THROW(nowhere.save(map_number(1, 2)), std::runtime_error);
}

/// Writes map after map until it is killed, and says in a pipe which ones are done.
pid_t start_writer(const MapFile& file, std::int64_t first, int done) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  for (std::int64_t number = first;; ++number) {
    file.save(map_number(number, 60));
    if (::write(done, &number, sizeof(number)) != sizeof(number)) ::_exit(1);
  }
}

TEST_F(MapFileTest, KilledWhileWritingTheLastFinishedMapIsThere) {
  std::int64_t finished = 0;
  for (int round = 0; round < 200; ++round) {
    int pipe_ends[2];
    ASSERT_EQ(::pipe(pipe_ends), 0);
    const pid_t writer = start_writer(file_, finished + 1, pipe_ends[1]);
    ASSERT_GT(writer, 0);
    ::close(pipe_ends[1]);
    std::this_thread::sleep_for(std::chrono::microseconds(500 + 137 * (round % 60)));
    ::kill(writer, SIGKILL);
    ::waitpid(writer, nullptr, 0);
    std::int64_t number = 0;
    while (::read(pipe_ends[0], &number, sizeof(number)) == sizeof(number)) finished = number;
    ::close(pipe_ends[0]);

    const auto loaded = file_.load();
    ASSERT_TRUE(loaded.complaint.empty()) << loaded.complaint;
    if (finished == 0 && loaded.map.empty()) continue;
    const std::int64_t found = loaded.map.landmarks.at(0).times_seen;
    ASSERT_GE(found, finished);
    ASSERT_LE(found, finished + 1);
    finished = found;
  }
  EXPECT_GT(finished, 20);
}

}  // namespace
}  // namespace roomwise
