#include "common/openni2/export_driver.h"
#include "services/simulator/openni2/sim_driver.h"

ROOMWISE_EXPORT_OPENNI2_DRIVER(roomwise::simulator::SimDriver)
