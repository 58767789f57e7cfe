// The address of an MQTT broker, as it stands in the configuration.
//
//   mqtts://HOST[:PORT]   over TLS; port 8883
//   mqtt://HOST[:PORT]    in clear, to this computer only (127.0.0.0/8, [::1], localhost); port 1883
//
// HOST is a name, an IPv4 address, or an IPv6 address in brackets. Who one is stands in settings of its own, and never
// in the address, which is shown and logged. Errors: a sentence that says the remedy. Thread: pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

namespace godwit::io::mqtt {

inline constexpr std::size_t max_uri_length = 512; // a longer text is a mistake

struct broker_uri {
  bool uses_tls = true;
  std::string host; // without brackets
  std::uint16_t port = 8883;

  [[nodiscard]] std::string text() const;
};

[[nodiscard]] tl::expected<broker_uri, std::string> parse_broker_uri(std::string_view text);

} // namespace godwit::io::mqtt
