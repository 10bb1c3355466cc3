// kinect_pub: publishes what a depth camera sees, depth and colour of one instant at a time.
#include "common/service_main.h"
#include "services/kinect_pub/kinect_service.h"

int main(int argc, char** argv) {
  return roomwise::service_main<roomwise::KinectService>("kinect_pub", argc, argv);
}
