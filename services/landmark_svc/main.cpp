// landmark_svc: depth and colour frames become landmarks to navigate by.
#include "common/service_main.h"
#include "services/landmark_svc/landmark_service.h"

int main(int argc, char** argv) {
  return roomwise::service_main<roomwise::LandmarkService>("landmark_svc", argc, argv);
}
