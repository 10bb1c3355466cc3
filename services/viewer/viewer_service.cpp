#include "services/viewer/viewer_service.h"

#include <spdlog/spdlog.h>

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <tuple>

#include "services/viewer/core/packet_format.h"

namespace roomwise {
namespace {

viewer::Tokens tokens_for(const viewer::Endpoint& endpoint, const std::string& path) {
  if (path.empty()) {
    if (endpoint.is_loopback()) return {};
    throw std::runtime_error("viewer: listen " + endpoint.host +
                             " is open to other machines and needs tokens: put 'view SECRET' and "
                             "'control SECRET' into a file and name it with --tokens_path");
  }
  std::ifstream file(path);
  if (!file) throw std::runtime_error("viewer: cannot read tokens_path " + path);
  std::ostringstream text;
  text << file.rdbuf();
  return viewer::parse_tokens(text.str());
}

}  // namespace

ViewerService::ViewerService(Bus& bus, const Params& params) : bus_(bus), desk_(bus) {
  if (bus.is_replay()) {
    throw std::runtime_error("viewer has no --replay: open the log in the page instead");
  }
  const viewer::Endpoint endpoint = viewer::parse_endpoint(params.listen);
  server_ = std::make_unique<viewer::WebServer>(
      viewer::WebServer::Rules{endpoint, tokens_for(endpoint, params.tokens_path),
                               params.logs_path},
      [this](std::span<const std::uint8_t> frame) { return desk_.take(frame); },
      [this](const std::string& why) {
        spdlog::warn("refused {}", why);
        bus_.post([this] { bus_.count("refused"); });
      });
  std::apply([this](const auto&... channel) { (forward(channel), ...); }, kAllChannels);
  spdlog::info("the page is at http://{}:{}/", endpoint.host, endpoint.port);
}

template <class Message>
void ViewerService::forward(const Channel<Message>& channel) {
  const bool is_stream = channel.name == channels::kKinectFrame.name;
  bus_.subscribe_undecoded(
      channel,
      [this, name = channel.name](std::span<const std::uint8_t> bytes) {
        if (!server_->has_clients()) return;
        server_->push(viewer::make_packet(name, utime_of(bus_.now()), bytes));
      },
      is_stream ? Delivery::kLatest : Delivery::kEvery);
}

}  // namespace roomwise
