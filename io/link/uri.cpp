#include "io/link/uri.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include <arpa/inet.h>

namespace godwit::io::link {
namespace {

using part_result =
    tl::expected<uri, std::string>; // the error is the part that is wrong, without the frame of mistake()

constexpr std::size_t max_quoted_length = 80; // of somebody else's text in a sentence of ours

struct scheme {
  std::string_view name;
  uri::kind kind;
};
constexpr scheme schemes[] = {{"udpin", uri::kind::udp_in},  {"udp", uri::kind::udp_in}, {"udpout", uri::kind::udp_out},
                              {"serial", uri::kind::serial}, {"tcp", uri::kind::tcp},    {"tcpin", uri::kind::tcp_in}};

std::string quoted_text(std::string_view text) {
  std::string shown = "\"";
  for (const char each : text.substr(0, max_quoted_length))
    shown += each >= ' ' && each <= '~' ? each : '?';
  return shown + (text.size() > max_quoted_length ? "...\"" : "\"");
}

std::string mistake(std::string_view text, const std::string& part) {
  return quoted_text(text) + ": " + part +
         "; a link is udpin://HOST:PORT or udpout://HOST:PORT (UDP), serial:///dev/NAME:BAUD (serial line), "
         "tcp://HOST:PORT or tcpin://HOST:PORT (TCP)";
}

bool all_of(std::string_view text, std::string_view allowed) {
  return !text.empty() && text.find_first_not_of(allowed) == std::string_view::npos;
}

constexpr std::string_view digits = "0123456789";

std::optional<std::uint32_t> number(std::string_view text, std::uint32_t least, std::uint32_t most) {
  std::uint32_t value = 0;
  const auto* const end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  if (text.empty() || error != std::errc{} || stopped != end || value < least || value > most)
    return std::nullopt;
  return value;
}

bool is_address(int family, std::string_view text) {
  std::array<unsigned char, sizeof(in6_addr)> bytes{};
  return ::inet_pton(family, std::string(text).c_str(), bytes.data()) == 1;
}

std::optional<std::string> mistake_in_name(std::string_view host) {
  constexpr std::string_view name_characters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._";
  if (!all_of(host, name_characters))
    return "the host " + quoted_text(host) + " is neither a name nor an address";
  if (all_of(host, "0123456789.") && !is_address(AF_INET, host))
    return "the host " + quoted_text(host) + " is not an IPv4 address";
  return std::nullopt;
}

// An address of one link only names its interface after a percent sign: fe80::1%eth0.
std::optional<std::string> mistake_in_ipv6(std::string_view host) {
  const auto zone_at = host.find('%');
  const bool empty_zone = zone_at != std::string_view::npos && zone_at + 1 == host.size();
  if (empty_zone || !is_address(AF_INET6, host.substr(0, zone_at)))
    return "the host " + quoted_text(host) + " in brackets is not an IPv6 address";
  return std::nullopt;
}

part_result with_port(uri so_far, std::string_view text) {
  const std::uint32_t least = so_far.listens() ? 0 : 1;
  const auto port = number(text, least, 65'535);
  if (!port)
    return tl::make_unexpected("the port " + quoted_text(text) + " is not a number from " + std::to_string(least) +
                               " to 65535");
  so_far.port = static_cast<std::uint16_t>(*port);
  return so_far;
}

part_result parse_ipv6(uri so_far, std::string_view rest) {
  const auto end = rest.find(']');
  if (end == std::string_view::npos)
    return tl::make_unexpected(std::string("the bracket of the IPv6 address is not closed"));
  so_far.host = rest.substr(1, end - 1);
  if (auto wrong = mistake_in_ipv6(so_far.host))
    return tl::make_unexpected(*std::move(wrong));
  rest.remove_prefix(end + 1);
  if (rest.empty() || rest.front() != ':')
    return tl::make_unexpected(std::string("the port is missing"));
  return with_port(std::move(so_far), rest.substr(1));
}

part_result parse_network(uri::kind kind, std::string_view rest) {
  uri result{.which = kind, .host = {}, .port = 0, .device = {}, .baud = 0};
  if (!rest.empty() && rest.front() == '[')
    return parse_ipv6(std::move(result), rest);
  const auto colon = rest.find(':');
  if (colon == std::string_view::npos)
    return tl::make_unexpected(std::string("the port is missing"));
  if (rest.find(':', colon + 1) != std::string_view::npos && is_address(AF_INET6, rest.substr(0, rest.rfind(':'))))
    return tl::make_unexpected(std::string("an IPv6 address stands in brackets, as in [::1]:14550"));
  result.host = rest.substr(0, colon);
  if (result.host.empty() && !result.listens())
    return tl::make_unexpected(std::string("the host is missing"));
  if (auto wrong = result.host.empty() ? std::nullopt : mistake_in_name(result.host))
    return tl::make_unexpected(*std::move(wrong));
  return with_port(std::move(result), rest.substr(colon + 1));
}

part_result parse_serial(std::string_view rest) {
  uri result{.which = uri::kind::serial, .host = {}, .port = 0, .device = std::string(rest), .baud = default_baud};
  if (rest.empty() || rest.front() != '/')
    return tl::make_unexpected("the device " + quoted_text(rest) + " is not an absolute path (three slashes)");
  // The system's names for ports by place hold colons, as in /dev/serial/by-path/pci-0000:00:14.0-usb-0:2:1.0.
  const auto colon = rest.rfind(':');
  const bool colons_in_name = rest.starts_with("/dev/serial/");
  if (colon != std::string_view::npos && (!colons_in_name || all_of(rest.substr(colon + 1), digits))) {
    const auto baud = number(rest.substr(colon + 1), min_baud, max_baud);
    if (!baud)
      return tl::make_unexpected("the baud rate " + quoted_text(rest.substr(colon + 1)) + " is not a number from " +
                                 std::to_string(min_baud) + " to " + std::to_string(max_baud));
    result.device = rest.substr(0, colon);
    result.baud = *baud;
  }
  const auto is_control = [](char each) { return static_cast<unsigned char>(each) < ' '; };
  if (result.device.back() == '/' || std::any_of(result.device.begin(), result.device.end(), is_control))
    return tl::make_unexpected("the device " + quoted_text(result.device) + " is not the name of a device");
  return result;
}

} // namespace

std::string host_and_port(std::string_view host, std::uint16_t port) {
  const bool ipv6 = host.find(':') != std::string_view::npos;
  return (ipv6 ? "[" + std::string(host) + "]" : std::string(host)) + ":" + std::to_string(port);
}

std::string uri::text() const {
  if (which == kind::serial)
    return "serial://" + device + ":" + std::to_string(baud);
  const auto* const found =
      std::find_if(std::begin(schemes), std::end(schemes), [this](const scheme& each) { return each.kind == which; });
  return std::string(found->name) + "://" + host_and_port(host, port);
}

tl::expected<uri, std::string> parse_uri(std::string_view text) {
  if (text.size() > max_uri_length)
    return tl::make_unexpected(mistake(text, "longer than " + std::to_string(max_uri_length) + " characters"));
  const auto mark = text.find("://");
  if (mark == std::string_view::npos)
    return tl::make_unexpected(mistake(text, "the kind of link is missing before ://"));
  const auto name = text.substr(0, mark);
  const auto rest = text.substr(mark + 3);
  const auto* const found =
      std::find_if(std::begin(schemes), std::end(schemes), [&](const scheme& each) { return each.name == name; });
  if (found == std::end(schemes))
    return tl::make_unexpected(mistake(text, "the kind of link " + quoted_text(name) + " is not known"));
  const bool serial = found->kind == uri::kind::serial;
  return (serial ? parse_serial(rest) : parse_network(found->kind, rest)).map_error([&](const std::string& part) {
    return mistake(text, part);
  });
}

} // namespace godwit::io::link
