#pragma once
#include <Driver/OniDriverAPI.h>

// What OpenNI2's ONI_EXPORT_DRIVER needs and Debian's headers lack.
#define XN_NEW(type, ...) new type(__VA_ARGS__)
#define XN_DELETE(pointer) delete (pointer)

/// Makes the 33 C functions that OpenNI2 looks for in a driver, for `Driver`.
///
/// A client may end without shutting OpenNI2 down, which can deadlock with a driver's thread that
/// reports a device gone at that moment. Then the driver's threads must be at rest before OpenNI2's
/// own globals go; those were made before this library was loaded and go after it.
#define ROOMWISE_EXPORT_OPENNI2_DRIVER(Driver)         \
  ONI_EXPORT_DRIVER(Driver)                            \
  namespace {                                          \
  struct RestAtExit {                                  \
    ~RestAtExit() {                                    \
      if (g_pDriver != nullptr) g_pDriver->shutdown(); \
    }                                                  \
  } rest_at_exit;                                      \
  }
