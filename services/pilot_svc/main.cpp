// pilot_svc: wanders, runs around an object, goes to a point; asks safety_svc for all of it.
#include "common/service_main.h"
#include "services/pilot_svc/pilot_service.h"

int main(int argc, char** argv) {
  return roomwise::service_main<roomwise::PilotService>("pilot_svc", argc, argv);
}
