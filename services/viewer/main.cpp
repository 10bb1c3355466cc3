// viewer: the robot in a browser.
#include "common/service_main.h"
#include "services/viewer/viewer_service.h"

int main(int argc, char** argv) {
  return roomwise::service_main<roomwise::ViewerService>("viewer", argc, argv);
}
