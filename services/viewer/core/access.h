#pragma once
#include <string>
#include <string_view>

namespace roomwise::viewer {

/// What a client may do. Whoever may control may view.
enum class Rights { kNone, kView, kControl };

/// Where the server listens: "127.0.0.1:8090".
struct Endpoint {
  std::string host;
  int port = 0;

  bool is_loopback() const;
};

/// Throws std::runtime_error if `text` is not ADDRESS:PORT with an IPv4 address.
Endpoint parse_endpoint(std::string_view text);

/// Secrets that a client on the LAN must know; both empty: not asked for.
struct Tokens {
  std::string view;
  std::string control;
};

/// Throws std::runtime_error unless `text` has a line "view SECRET" and a line "control SECRET", of
/// 16 characters or more and different.
Tokens parse_tokens(std::string_view text);

/// Takes the same time whatever the token is.
Rights rights_of(const Tokens& tokens, std::string_view token);

/// The name a browser used to reach us must be ours. On the loopback that is what keeps a foreign
/// page away whose name was made to point here (DNS rebinding); on the LAN the token does, and any
/// numeric address will do.
bool is_own_host(const Endpoint& endpoint, std::string_view host);

/// A WebSocket's Origin must be the page we served: "http://" and the Host of the same request.
bool is_own_origin(std::string_view origin, std::string_view host);

}  // namespace roomwise::viewer
