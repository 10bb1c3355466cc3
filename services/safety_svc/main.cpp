// safety_svc: what the robot may do of what it is asked to do.
#include "common/service_main.h"
#include "services/safety_svc/safety_service.h"

int main(int argc, char** argv) {
  return roomwise::service_main<roomwise::SafetyService>("safety_svc", argc, argv);
}
