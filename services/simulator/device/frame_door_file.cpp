#include "services/simulator/device/frame_door_file.h"

#include <fcntl.h>

namespace roomwise::simulator::door {
namespace {

struct flock whole_file() {
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  return lock;
}

}  // namespace

// Locks of the open file, not of the process: they also hold between two ends in one process, and
// the kernel drops them when their owner is killed.
bool lock_file(int file) {
  struct flock lock = whole_file();
  return ::fcntl(file, F_OFD_SETLK, &lock) == 0;
}

bool is_locked(int file) {
  struct flock lock = whole_file();
  return ::fcntl(file, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
}

}  // namespace roomwise::simulator::door
