#include "services/viewer/core/access.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <stdexcept>

namespace roomwise::viewer {
namespace {

constexpr std::size_t kShortestToken = 16;

bool is_number_up_to(std::string_view text, int largest) {
  int value = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() && value >= 0 && value <= largest;
}

bool is_ipv4(std::string_view text) {
  int parts = 0;
  for (;; ++parts) {
    const std::size_t dot = text.find('.');
    if (!is_number_up_to(text.substr(0, dot), 255)) return false;
    if (dot == std::string_view::npos) break;
    text.remove_prefix(dot + 1);
  }
  return parts == 3;
}

bool same_secret(std::string_view secret, std::string_view token) {
  unsigned difference = secret.size() == token.size() ? 0U : 1U;
  for (std::size_t i = 0; i < secret.size(); ++i) {
    const char given = i < token.size() ? token[i] : '\0';
    difference |= static_cast<unsigned>(static_cast<unsigned char>(secret[i] ^ given));
  }
  return difference == 0 && !secret.empty();
}

std::string secret_named(std::string_view name, std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.starts_with(name) && line.substr(name.size()).starts_with(' ')) {
      return std::string(line.substr(name.size() + 1));
    }
  }
  return {};
}

}  // namespace

bool Endpoint::is_loopback() const { return host.starts_with("127."); }

Endpoint parse_endpoint(std::string_view text) {
  const std::size_t colon = text.rfind(':');
  const std::string_view host = text.substr(0, colon);
  const std::string_view port =
      colon == std::string_view::npos ? std::string_view{} : text.substr(colon + 1);
  if (!is_ipv4(host) || !is_number_up_to(port, 65535)) {
    throw std::runtime_error("listen must be ADDRESS:PORT as in 127.0.0.1:8090, not '" +
                             std::string(text) + "'");
  }
  return {std::string(host), std::stoi(std::string(port))};
}

Tokens parse_tokens(std::string_view text) {
  Tokens tokens{secret_named("view", text), secret_named("control", text)};
  if (std::min(tokens.view.size(), tokens.control.size()) < kShortestToken ||
      tokens.view == tokens.control) {
    throw std::runtime_error(
        "tokens: two lines are needed, 'view SECRET' and 'control SECRET', different and of 16 "
        "characters or more");
  }
  return tokens;
}

Rights rights_of(const Tokens& tokens, std::string_view token) {
  if (tokens.view.empty() && tokens.control.empty()) return Rights::kControl;
  const bool may_control = same_secret(tokens.control, token);
  const bool may_view = same_secret(tokens.view, token);
  if (may_control) return Rights::kControl;
  return may_view ? Rights::kView : Rights::kNone;
}

bool is_own_host(const Endpoint& endpoint, std::string_view host) {
  const std::string port = ":" + std::to_string(endpoint.port);
  if (!host.ends_with(port)) return false;
  host.remove_suffix(port.size());
  if (endpoint.is_loopback()) return host == endpoint.host || host == "localhost";
  return is_ipv4(host) || host == "localhost";
}

bool is_own_origin(std::string_view origin, std::string_view host) {
  constexpr std::string_view kScheme = "http://";
  return origin.starts_with(kScheme) && origin.substr(kScheme.size()) == host && !host.empty();
}

}  // namespace roomwise::viewer
