// The service killed with -9 while it maps a corridor and keeps the map on disk: what is left is a
// map that an undisturbed run kept too, and the newest of them. ROOMWISE_KILLS: how often.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <thread>

#include "common/bus/log_bus.h"
#include "common/bus/wire.h"
#include "services/ekf_svc/ekf_service.h"
#include "services/ekf_svc/map_file.h"
#include "tests/ekf_svc/support/corridor_messages.h"
#include "tests/support/scratch_folder.h"

namespace roomwise {
namespace {

constexpr std::int64_t kSwitchedOn_us = 1'700'000'000'000'000;
constexpr std::size_t kSteps = 320;        // ten a second
constexpr std::size_t kStepsLostMax = 51;  // 5 s, and the step that notices

int kills() {
  const char* wanted = std::getenv("ROOMWISE_KILLS");
  return wanted == nullptr ? 25 : std::atoi(wanted);
}

std::vector<LogEvent> corridor_drive() {
  ekf::CorridorMessages messages(ekf::CorridorWorld({.classes = 4}, 7), kSwitchedOn_us);
  std::vector<LogEvent> events;
  const auto append = [&](const auto& channel, const auto& message) {
    events.push_back({time_from_utime(message.utime), std::string(channel.name), {}});
    encode(message, events.back().data);
  };
  for (std::size_t step = 0; step < kSteps; ++step) {
    append(channels::kOdometry, messages.drive());
    append(channels::kLandmarks, messages.look());
  }
  return events;
}

class KilledMapping : public testing::Test {
 protected:
  /// Maps the corridor; `on_pose` is called with the number of poses told so far.
  void map_corridor(const std::function<void(std::size_t)>& on_pose) {
    std::size_t next = 0, poses = 0;
    LogBus bus(
        [&](LogEvent& event) {
          if (next == drive_.size()) return false;
          event = drive_[next++];
          return true;
        },
        [&](const LogEvent& event) {
          if (event.channel == channels::kPose.name) on_pose(++poses);
        });
    EkfService::Params params;
    params.map_path = path_.string();
    EkfService service(bus, params);
    bus.run();
  }

  std::string kept() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  struct Kept {
    std::size_t poses;  // told when it was found on disk
    std::string bytes;
  };
  /// The maps of an undisturbed run, in order.
  std::vector<Kept> all_kept() {
    std::vector<Kept> maps{{0, ""}};
    map_corridor([&](std::size_t poses) {
      std::string bytes = kept();
      if (bytes != maps.back().bytes) maps.push_back({poses, std::move(bytes)});
    });
    maps.push_back({kSteps + 1, kept()});  // at exit
    std::filesystem::remove_all(folder_.path());
    return maps;
  }

  /// Starts the service in another process, kills it `delay` after its pose number `at`, and
  /// returns how many poses it had told.
  std::size_t kill_after(std::size_t at, std::chrono::microseconds delay) {
    int ends[2];
    if (::pipe(ends) != 0) throw std::runtime_error("pipe");
    const pid_t child = ::fork();
    if (child == 0) {
      ::close(ends[0]);
      map_corridor([&](std::size_t poses) {
        if (::write(ends[1], &poses, sizeof(poses)) != sizeof(poses)) ::_exit(1);
      });
      ::pause();  // told everything: the kill is still to come
      ::_exit(0);
    }
    ::close(ends[1]);
    std::size_t told = 0;
    while (told < at && ::read(ends[0], &told, sizeof(told)) == sizeof(told)) {
    }
    std::this_thread::sleep_for(delay);
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    while (::read(ends[0], &told, sizeof(told)) == sizeof(told)) {
    }
    ::close(ends[0]);
    return told;
  }

  ScratchFolder folder_;
  std::filesystem::path path_ = folder_.path() / "corridor.map";
  std::vector<LogEvent> drive_ = corridor_drive();
};

TEST_F(KilledMapping, TheMapLeftIsWholeAndNotOlderThanFiveSeconds) {
  const std::vector<Kept> maps = all_kept();
  ASSERT_GE(maps.size(), 6U);
  std::size_t unfinished = 0, oldest = 0;
  for (int round = 0; round < kills(); ++round) {
    std::filesystem::create_directories(folder_.path());
    // Every other one falls into the time a map is written.
    const std::size_t number = 1 + static_cast<std::size_t>(round) / 2 % (maps.size() - 1);
    const std::size_t at =
        round % 2 == 0 ? maps[number].poses - 1 : 1 + static_cast<std::size_t>(round) * 37 % kSteps;
    const std::size_t told = kill_after(at, std::chrono::microseconds(100 * (round % 23)));
    ASSERT_GE(told, at);

    if (std::filesystem::exists(path_.string() + ".part")) ++unfinished;
    std::size_t found = maps.size() - 1;
    const std::string left = kept();
    while (found > 0 && maps[found].bytes != left) --found;
    ASSERT_TRUE(maps[found].bytes == left) << "round " << round << ": a map no run kept";
    if (found + 1 < maps.size()) {
      ASSERT_GT(maps[found + 1].poses, told) << "round " << round << ": a newer map was lost";
    }
    oldest = std::max(oldest, told - std::min(told, maps[found].poses));
    const MapFile::Loaded loaded = MapFile(path_).load();
    ASSERT_TRUE(loaded.complaint.empty()) << loaded.complaint;
    ASSERT_EQ(loaded.map.empty(), found == 0);
    std::filesystem::remove_all(folder_.path());
  }
  std::printf("%d kills, %zu of them while a map was written; oldest map left: %.1f s\n", kills(),
              unfinished, 0.1 * static_cast<double>(oldest));
  EXPECT_LE(oldest, kStepsLostMax);
  EXPECT_GT(unfinished, 0U);
}

}  // namespace
}  // namespace roomwise
