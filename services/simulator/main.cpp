// simulator: a world, a Create on a pseudo-terminal and what is true of them.
#include "common/service_main.h"
#include "services/simulator/simulator_service.h"

int main(int argc, char** argv) {
  return roomwise::service_main<roomwise::simulator::SimulatorService>("simulator", argc, argv);
}
