#pragma once
#include <libfreenect.h>
#include <libfreenect_registration.h>

#include <string>
#include <vector>

// fakenect, which plays a recorded Kinect in the place of libfreenect, lacks these: they are weak,
// and to be called only if freenect_is_whole().
#pragma weak freenect_list_device_attributes
#pragma weak freenect_free_device_attributes
#pragma weak freenect_copy_registration
#pragma weak freenect_destroy_registration

namespace roomwise {

/// libfreenect's context, from init to shutdown.
class FreenectContext {
 public:
  /// Throws std::runtime_error with libfreenect's words.
  FreenectContext();
  FreenectContext(const FreenectContext&) = delete;
  FreenectContext& operator=(const FreenectContext&) = delete;
  ~FreenectContext();

  freenect_context* get() const { return context_; }

  /// One name for each Kinect on the bus: its serial number, or its index where it has none.
  std::vector<std::string> devices() const;

 private:
  freenect_context* context_ = nullptr;
};

/// What libfreenect said last, for error messages; empty if nothing.
std::string last_freenect_message();

/// True if libfreenect can say what devices and registration are: fakenect cannot.
bool freenect_is_whole();

}  // namespace roomwise
