#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>

#include "services/viewer/client.h"
#include "services/viewer/core/access.h"

struct mg_connection;
struct mg_context;

namespace roomwise::viewer {

/// The page's files and the WebSocket "/bus" on one port. Requests from elsewhere, without the
/// token or of the wrong form are refused and said.
class WebServer {
 public:
  struct Rules {
    Endpoint endpoint;
    Tokens tokens;
    std::filesystem::path logs;
  };
  /// A frame from a page that may control: why it is refused, or empty. From any thread.
  using TakeCommand = std::function<std::string(std::span<const std::uint8_t>)>;
  /// Something was refused: what and why. From any thread.
  using SayRefusal = std::function<void(const std::string&)>;

  /// Throws std::runtime_error naming the address if it cannot be had.
  WebServer(Rules rules, TakeCommand take_command, SayRefusal say_refusal);
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;
  ~WebServer();

  void push(const SharedPacket& packet);
  bool has_clients() const;

 private:
  struct Callbacks;

  int serve_file(mg_connection* connection);
  bool may_connect(const mg_connection* connection);
  void add_client(mg_connection* connection);
  void remove_client(const mg_connection* connection);
  bool take_frame(mg_connection* connection, int bits, std::span<const char> bytes);
  std::shared_ptr<Client> client_of(const mg_connection* connection);
  void refuse(const mg_connection* connection, const std::string& why);

  Rules rules_;
  TakeCommand take_command_;
  SayRefusal say_refusal_;
  mutable std::mutex mutex_;
  std::map<const mg_connection*, std::shared_ptr<Client>> clients_;
  mg_context* context_ = nullptr;
};

}  // namespace roomwise::viewer
