#include "common/openni2/export_driver.h"
#include "services/kinect_pub/freenect/freenect_driver.h"

ROOMWISE_EXPORT_OPENNI2_DRIVER(roomwise::FreenectDriver)
