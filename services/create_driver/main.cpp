// create_driver: an iRobot Create on a serial port becomes CREATE_STATE and ODOMETRY, and VEL_CMD
// moves it.
#include "common/service_main.h"
#include "services/create_driver/create_service.h"

int main(int argc, char** argv) {
  return roomwise::service_main<roomwise::CreateService>("create_driver", argc, argv);
}
