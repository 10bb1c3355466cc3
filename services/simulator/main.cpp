// simulator: a world, a Create on its port and a Kinect behind its door, live; or a log of a drive.
#include "common/service_main.h"
#include "services/simulator/recording/record_command.h"
#include "services/simulator/simulator_service.h"

int main(int argc, char** argv) {
  using namespace roomwise::simulator;
  if (asks_for_recording(argc, argv)) return record_main(argc, argv);
  return roomwise::service_main<SimulatorService>("simulator", argc, argv);
}
