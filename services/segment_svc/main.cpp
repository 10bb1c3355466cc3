// segment_svc: labels what each camera frame shows as floor, wall, obstacle, drop-off or unknown.
#include "common/service_main.h"
#include "services/segment_svc/segment_service.h"

int main(int argc, char** argv) {
  return roomwise::service_main<roomwise::SegmentService>("segment_svc", argc, argv);
}
