#pragma once
#include <memory>
#include <string>

#include "common/bus/bus.h"
#include "services/viewer/control_desk.h"
#include "services/viewer/web_server.h"

namespace roomwise {

/// Where the page is served, and who may look.
struct ViewerServiceParams {
  std::string listen = "127.0.0.1:8090";
  std::string tokens_path;  ///< "view SECRET", "control SECRET"; needed off this machine
  std::string logs_path = "logs";

  template <class Field>
  void visit_fields(Field&& field) {
    field("listen", listen);
    field("tokens_path", tokens_path);
    field("logs_path", logs_path);
  }
};

/// Hands every message on the bus to the pages that are open, and what pages with the right to
/// control send to the bus.
class ViewerService {
 public:
  using Params = ViewerServiceParams;

  /// Throws std::runtime_error in a replay (pages open logs by themselves), without tokens on an
  /// address other machines reach, or if the address cannot be had.
  ViewerService(Bus& bus, const Params& params);

 private:
  template <class Message>
  void forward(const Channel<Message>& channel);

  Bus& bus_;
  viewer::ControlDesk desk_;
  std::unique_ptr<viewer::WebServer> server_;
};

}  // namespace roomwise
