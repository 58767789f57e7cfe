#include "io/mqtt/broker_uri.hpp"

#include <algorithm>
#include <charconv>

namespace godwit::io::mqtt {
namespace {

constexpr std::string_view forms = "it is mqtts://HOST:PORT, or mqtt://127.0.0.1:PORT to a broker on this computer";
constexpr std::string_view in_clear = "mqtt://";
constexpr std::string_view over_tls = "mqtts://";
constexpr std::uint16_t clear_port = 1883;

tl::unexpected<std::string> wrong(std::string_view text, const std::string& why) {
  return tl::make_unexpected("\"" + std::string(text) + "\" " + why + "; " + std::string(forms));
}

bool is_ipv4(std::string_view host) {
  return !host.empty() && std::ranges::all_of(host, [](char c) { return (c >= '0' && c <= '9') || c == '.'; });
}

bool is_this_computer(std::string_view host) {
  return host == "localhost" || host == "::1" || (is_ipv4(host) && host.starts_with("127."));
}

bool is_host(std::string_view host) {
  return !host.empty() && std::ranges::all_of(host, [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '.' || c == '-' ||
           c == '_' || c == ':';
  });
}

} // namespace

std::string broker_uri::text() const {
  const bool is_ipv6 = host.find(':') != std::string::npos;
  return std::string(uses_tls ? over_tls : in_clear) + (is_ipv6 ? "[" + host + "]" : host) + ":" + std::to_string(port);
}

tl::expected<broker_uri, std::string> parse_broker_uri(std::string_view text) {
  if (text.size() > max_uri_length)
    return tl::make_unexpected("the address of a broker has at most " + std::to_string(max_uri_length) + " bytes");
  if (text.find('@') != std::string_view::npos)
    return tl::make_unexpected("the address of a broker holds no user and no password: they stand in "
                               "telemetry.username and telemetry.password_file");
  broker_uri result;
  auto rest = text;
  if (rest.starts_with(over_tls)) {
    rest.remove_prefix(over_tls.size());
  } else if (rest.starts_with(in_clear)) {
    rest.remove_prefix(in_clear.size());
    result.uses_tls = false;
    result.port = clear_port;
  } else {
    return wrong(text, "is no address of a broker");
  }
  const auto bracket = rest.starts_with('[') ? rest.find(']') : std::string_view::npos;
  const auto colon = rest.find(':', bracket == std::string_view::npos ? 0 : bracket);
  const auto host = rest.substr(0, colon);
  result.host = bracket == std::string_view::npos ? host : host.substr(1, bracket - 1);
  if (!is_host(result.host) || (bracket == std::string_view::npos && result.host.find(':') != std::string::npos))
    return wrong(text, "names no host");
  if (colon != std::string_view::npos) {
    const auto port = rest.substr(colon + 1);
    const auto [end, failed] = std::from_chars(port.data(), port.data() + port.size(), result.port);
    if (failed != std::errc() || end != port.data() + port.size() || result.port == 0)
      return wrong(text, "has no port from 1 to 65535");
  }
  if (!result.uses_tls && !is_this_computer(result.host))
    return tl::make_unexpected("\"" + std::string(text) +
                               "\" is reached in clear, over a network: anybody on the way "
                               "could read and change it. Name it mqtts://" +
                               result.host +
                               ":8883, and its issuer in telemetry.ca_file if the system does not trust it");
  return result;
}

} // namespace godwit::io::mqtt
