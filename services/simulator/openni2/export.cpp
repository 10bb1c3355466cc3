// The 33 C functions OpenNI2 looks for in a driver.
#define XN_NEW(type, ...) new type(__VA_ARGS__)
#define XN_DELETE(pointer) delete (pointer)
#include "services/simulator/openni2/sim_driver.h"

ONI_EXPORT_DRIVER(roomwise::simulator::SimDriver)
