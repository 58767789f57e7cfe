#include "io/http/url.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

#include <boost/asio/ip/address.hpp>

#include "io/http/message.hpp"

namespace godwit::io::http {
namespace {

constexpr std::uint16_t http_port = 80;
constexpr std::uint16_t https_port = 443;
constexpr std::size_t longest_host = 253; // RFC 1035

tl::unexpected<error> refused(std::string what) { return failure(errc::invalid_settings, std::move(what)); }

bool is_host_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '_';
}

bool is_path_character(char c) { return c > ' ' && c < '\x7f' && c != '"' && c != '<' && c != '>' && c != '\\'; }

std::optional<boost::asio::ip::address> address_of(std::string_view host) {
  boost::system::error_code is_a_name;
  const auto address = boost::asio::ip::make_address(std::string(host), is_a_name);
  return is_a_name ? std::nullopt : std::optional(address);
}

// Takes the host from the front of AUTHORITY, which keeps what is after it.
result<std::string> take_host(std::string_view& authority) {
  if (authority.starts_with('[')) {
    const auto end = authority.find(']');
    const std::string host(authority.substr(1, end == std::string_view::npos ? end : end - 1));
    const auto address = address_of(host);
    if (end == std::string_view::npos || !address || !address->is_v6())
      return refused("what stands in brackets in a URL must be an IPv6 address");
    if (host.find('%') != std::string::npos)
      return refused("an IPv6 address in a URL has no zone: no certificate could name it");
    authority.remove_prefix(end + 1);
    return host;
  }
  const std::string host(authority.substr(0, authority.find(':')));
  if (host.empty() || host.size() > longest_host || !std::ranges::all_of(host, is_host_character))
    return refused("the URL names no host: write https://HOST:PORT/PATH");
  authority.remove_prefix(host.size());
  return host;
}

result<std::uint16_t> take_port(std::string_view text, std::uint16_t usual) {
  if (text.empty())
    return usual;
  text.remove_prefix(text.starts_with(':') ? 1 : 0);
  std::uint16_t port = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), port);
  if (read.ec != std::errc() || read.ptr != text.data() + text.size() || port == 0)
    return refused("the port in the URL must be a number from 1 to 65535");
  return port;
}

} // namespace

result<url> parse_url(std::string_view text) {
  url made;
  const auto separator = text.find("://");
  const auto scheme = separator == std::string_view::npos ? std::string_view{} : text.substr(0, separator);
  made.is_tls = equals_ignoring_case(scheme, "https");
  if (!made.is_tls && !equals_ignoring_case(scheme, "http"))
    return refused("a URL begins with https:// or http://");
  text.remove_prefix(separator + 3);
  const auto slash = text.find_first_of("/?#");
  auto authority = text.substr(0, slash);
  const auto path = slash == std::string_view::npos ? std::string_view{} : text.substr(slash);
  if (text.find('@') != std::string_view::npos)
    return refused("no user and password in a URL, where everybody reads them: name a token file instead");
  if (path.find_first_of("?#") != std::string_view::npos || !std::ranges::all_of(path, is_path_character))
    return refused("the URL of a service ends with its path: no query, no fragment, no spaces");
  auto host = take_host(authority);
  if (!host)
    return tl::make_unexpected(host.error());
  const auto port = take_port(authority, made.is_tls ? https_port : http_port);
  if (!port)
    return tl::make_unexpected(port.error());
  made.host = std::move(*host);
  made.port = *port;
  made.path = path.substr(0, path.find_last_not_of('/') + 1);
  return made;
}

std::string url::authority() const {
  const bool is_v6 = host.find(':') != std::string::npos;
  return (is_v6 ? "[" + host + "]" : host) + ":" + std::to_string(port);
}

std::string url::host_header() const {
  const auto full = authority();
  const bool is_usual = port == (is_tls ? https_port : http_port);
  return is_usual ? full.substr(0, full.rfind(':')) : full;
}

std::string url::origin() const { return (is_tls ? "https://" : "http://") + authority(); }

bool is_address(std::string_view host) { return address_of(host).has_value(); }

bool names_this_computer(std::string_view host) {
  const auto address = address_of(host);
  return address ? address->is_loopback() : equals_ignoring_case(host, "localhost");
}

} // namespace godwit::io::http
