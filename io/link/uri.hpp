// The address of a link, as it stands in the configuration and on the command line.
//
//   udpin://HOST:PORT          listens there; port 0: any free one; no host: all interfaces
//   udp://HOST:PORT            the same, as in other MAVLink programs
//   udpout://HOST:PORT         sends there from a free port, and hears what comes back
//   serial:///dev/NAME:BAUD    the baud rate may be left out: 57600, what telemetry radios are sold with
//   tcp://HOST:PORT            connects there, as to a simulator
//   tcpin://HOST:PORT          listens there for several at once, as a simulator does; port and host as for udpin
//
// HOST is a name, an IPv4 address, or an IPv6 address in brackets. Names with addresses of both families mean the IPv4
// one first, because that is where MAVLink programs listen. Device names below /dev/serial/ may hold colons.
//
// Errors: a sentence that names the part that is wrong and shows the forms. Thread: plain values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

namespace godwit::io::link {

inline constexpr std::uint32_t default_baud = 57'600;
inline constexpr std::uint32_t min_baud = 300;
inline constexpr std::uint32_t max_baud = 12'000'000; // the fastest USB adapters
inline constexpr std::size_t max_uri_length = 512;    // a longer text is not a URI but a mistake

struct uri {
  enum class kind { udp_in, udp_out, serial, tcp, tcp_in };

  kind which = kind::udp_in;
  std::string host;       // without brackets; empty only for udp_in and tcp_in
  std::uint16_t port = 0; // 0 only for udp_in, tcp_in and serial
  std::string device;     // serial: an absolute path; empty for the others
  std::uint32_t baud = 0; // serial: bits per second; 0 for the others

  // The canonical form, which parse_uri reads back as an equal value.
  [[nodiscard]] std::string text() const;
  // It waits for others, and does not call them.
  [[nodiscard]] bool listens() const { return which == kind::udp_in || which == kind::tcp_in; }
  bool operator==(const uri&) const = default;
};

[[nodiscard]] tl::expected<uri, std::string> parse_uri(std::string_view text);

// "HOST:PORT", IPv6 in brackets, for people.
[[nodiscard]] std::string host_and_port(std::string_view host, std::uint16_t port);

} // namespace godwit::io::link
