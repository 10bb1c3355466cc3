// The 33 C functions OpenNI2 looks for in a driver.
#define XN_NEW(type, ...) new type(__VA_ARGS__)
#define XN_DELETE(pointer) delete (pointer)
#include "services/simulator/openni2/sim_driver.h"

ONI_EXPORT_DRIVER(roomwise::simulator::SimDriver)

namespace {

/// A client may end without shutting OpenNI2 down (which can deadlock with a driver's thread: see
/// README.md). Then the watcher must be at rest before OpenNI2's own globals go, which were made
/// before this library was loaded and go after it.
struct RestAtExit {
  ~RestAtExit() {
    if (g_pDriver != nullptr) g_pDriver->shutdown();
  }
} rest_at_exit;

}  // namespace
