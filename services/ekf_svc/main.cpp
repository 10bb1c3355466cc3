// ekf_svc: wheel odometry and landmarks become a pose and a map.
#include "common/service_main.h"
#include "services/ekf_svc/ekf_service.h"

int main(int argc, char** argv) {
  return roomwise::service_main<roomwise::EkfService>("ekf_svc", argc, argv);
}
