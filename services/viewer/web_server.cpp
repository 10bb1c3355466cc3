#include "services/viewer/web_server.h"

#include <civetweb.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "services/viewer/embedded_page.h"

namespace roomwise::viewer {
namespace {

/// Each page holds one of the server's threads for itself.
constexpr std::size_t kMostClients = 12;
constexpr const char* kThreads = "20";
constexpr std::size_t kLongestOrder = 300;

constexpr int kFinal = 0x80;
constexpr int kOpcode = 0x0F;

constexpr std::string_view kHeaders =
    "Content-Security-Policy: default-src 'self'; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' blob: data:; connect-src 'self'; frame-ancestors 'none'\r\n"
    "X-Content-Type-Options: nosniff\r\nReferrer-Policy: no-referrer\r\nCache-Control: "
    "no-cache\r\n";

std::string_view header(const mg_connection* connection, const char* name) {
  const char* value = mg_get_header(connection, name);
  return value == nullptr ? std::string_view{} : std::string_view(value);
}

void answer(mg_connection* connection, std::string_view status, std::string_view type,
            std::string_view content) {
  const std::string head = fmt::format(
      "HTTP/1.1 {}\r\nContent-Type: {}\r\nContent-Length: {}\r\n{}Connection: close\r\n\r\n",
      status, type, content.size(), kHeaders);
  mg_write(connection, head.data(), head.size());
  mg_write(connection, content.data(), content.size());
}

/// The token in the query "token=...".
std::string token_in(const mg_connection* connection) {
  const char* query = mg_get_request_info(connection)->query_string;
  if (query == nullptr) return {};
  std::array<char, 200> token{};
  const std::string_view text(query);
  const int length = mg_get_var(text.data(), text.size(), "token", token.data(), token.size());
  return length > 0 ? std::string(token.data()) : std::string{};
}

}  // namespace

/// What civetweb calls, with the server as its last argument.
struct WebServer::Callbacks {
  static WebServer& server(void* data) { return *static_cast<WebServer*>(data); }
  static int request(mg_connection* connection, void* data) {
    return server(data).serve_file(connection);
  }
  static int connect(const mg_connection* connection, void* data) {
    return server(data).may_connect(connection) ? 0 : 1;
  }
  static void ready(mg_connection* connection, void* data) { server(data).add_client(connection); }
  static int data(mg_connection* connection, int bits, char* bytes, std::size_t size, void* data) {
    return server(data).take_frame(connection, bits, {bytes, size}) ? 1 : 0;
  }
  static void close(const mg_connection* connection, void* data) {
    server(data).remove_client(connection);
  }
};

WebServer::WebServer(Rules rules, TakeCommand take_command, SayRefusal say_refusal)
    : rules_(std::move(rules)),
      take_command_(std::move(take_command)),
      say_refusal_(std::move(say_refusal)) {
  mg_init_library(0);
  const std::string address = fmt::format("{}:{}", rules_.endpoint.host, rules_.endpoint.port);
  std::array<const char*, 13> options{"listening_ports",
                                      address.c_str(),
                                      "num_threads",
                                      kThreads,
                                      "request_timeout_ms",
                                      "5000",
                                      "tcp_nodelay",
                                      "1",
                                      "websocket_timeout_ms",
                                      "3600000",
                                      "enable_directory_listing",
                                      "no",
                                      nullptr};
  const mg_callbacks none{};
  context_ = mg_start(&none, this, options.data());
  if (context_ == nullptr) {
    throw std::runtime_error("viewer: cannot listen on " + address +
                             " (is another viewer running? choose another with --listen)");
  }
  mg_set_request_handler(context_, "/", &Callbacks::request, this);
  mg_set_websocket_handler(context_, "/bus", &Callbacks::connect, &Callbacks::ready,
                           &Callbacks::data, &Callbacks::close, this);
}

WebServer::~WebServer() {
  mg_stop(context_);
  clients_.clear();
  mg_exit_library();
}

void WebServer::push(const SharedPacket& packet) {
  const std::lock_guard lock(mutex_);
  for (const auto& [connection, client] : clients_) client->push(packet);
}

bool WebServer::has_clients() const {
  const std::lock_guard lock(mutex_);
  return !clients_.empty();
}

void WebServer::refuse(const mg_connection* connection, const std::string& why) {
  say_refusal_(fmt::format("{}: {}", mg_get_request_info(connection)->remote_addr, why));
}

int WebServer::serve_file(mg_connection* connection) {
  constexpr int kForbidden = 403;
  constexpr int kNotFound = 404;
  const mg_request_info& request = *mg_get_request_info(connection);
  if (!is_own_host(rules_.endpoint, header(connection, "Host"))) {
    refuse(connection, "a request for another host");
    answer(connection, "403 Forbidden", "text/plain", "not the name this server goes by\n");
    return kForbidden;
  }
  const std::string_view path = request.local_uri;
  const auto files = page_files();
  const auto file = std::ranges::find(files, path, &PageFile::path);
  if (file == files.end() || std::string_view(request.request_method) != "GET") {
    refuse(connection, "no such page");
    answer(connection, "404 Not Found", "text/plain", "no such page\n");
    return kNotFound;
  }
  answer(connection, "200 OK", file->type, file->content);
  return 200;
}

bool WebServer::may_connect(const mg_connection* connection) {
  const std::string_view host = header(connection, "Host");
  std::string why;
  {
    const std::lock_guard lock(mutex_);
    if (clients_.size() >= kMostClients) why = "too many pages";
  }
  if (!is_own_host(rules_.endpoint, host)) why = "a WebSocket for another host";
  if (!is_own_origin(header(connection, "Origin"), host)) why = "a WebSocket of a foreign origin";
  if (rights_of(rules_.tokens, token_in(connection)) == Rights::kNone) why = "a wrong token";
  if (!why.empty()) refuse(connection, why);
  return why.empty();
}

void WebServer::add_client(mg_connection* connection) {
  const auto send = [connection](bool is_text, std::span<const char> bytes) {
    const int opcode = is_text ? MG_WEBSOCKET_OPCODE_TEXT : MG_WEBSOCKET_OPCODE_BINARY;
    return mg_websocket_write(connection, opcode, bytes.data(), bytes.size()) > 0;
  };
  auto client =
      std::make_shared<Client>(rights_of(rules_.tokens, token_in(connection)), rules_.logs, send);
  const std::lock_guard lock(mutex_);
  clients_[connection] = std::move(client);
}

void WebServer::remove_client(const mg_connection* connection) {
  std::shared_ptr<Client> last;  // its thread is waited for without the lock
  const std::lock_guard lock(mutex_);
  const auto found = clients_.find(connection);
  if (found == clients_.end()) return;
  last = std::move(found->second);
  clients_.erase(found);
}

std::shared_ptr<Client> WebServer::client_of(const mg_connection* connection) {
  const std::lock_guard lock(mutex_);
  const auto found = clients_.find(connection);
  return found == clients_.end() ? nullptr : found->second;
}

bool WebServer::take_frame(mg_connection* connection, int bits, std::span<const char> bytes) {
  const std::shared_ptr<Client> client = client_of(connection);
  const int opcode = bits & kOpcode;
  if (client == nullptr || opcode == MG_WEBSOCKET_OPCODE_CONNECTION_CLOSE) return false;
  if (opcode == MG_WEBSOCKET_OPCODE_PING || opcode == MG_WEBSOCKET_OPCODE_PONG) return true;
  std::string why;
  if ((bits & kFinal) == 0) {
    why = "a frame in pieces";
  } else if (opcode == MG_WEBSOCKET_OPCODE_TEXT) {
    if (bytes.size() > kLongestOrder) why = "an order too long";
    if (why.empty()) client->order(std::string(bytes.data(), bytes.size()));
  } else if (opcode != MG_WEBSOCKET_OPCODE_BINARY) {
    why = "a frame of unknown kind";
  } else if (client->rights() != Rights::kControl) {
    why = "a command without the right to control";
  } else {
    why = take_command_({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  }
  if (!why.empty()) refuse(connection, why);
  return why.empty();
}

}  // namespace roomwise::viewer
