// Whose share of a bound a client uses: that of its IPv4 address, or of its IPv6 network of 64 bits, which one
// subscriber has whole (RFC 6177). Programs on this computer have places of their own. Thread: pure.
#pragma once

#include <algorithm>
#include <string>

#include <boost/asio/ip/address.hpp>

namespace godwit::io::http {

[[nodiscard]] inline boost::asio::ip::address share_of(const boost::asio::ip::address& client) {
  if (client.is_v4())
    return client;
  const auto v6 = client.to_v6();
  if (v6.is_v4_mapped())
    return boost::asio::ip::make_address_v4(boost::asio::ip::v4_mapped, v6);
  if (v6.is_loopback())
    return v6;
  auto bytes = v6.to_bytes();
  std::fill(bytes.begin() + bytes.size() / 2, bytes.end(), 0);
  return boost::asio::ip::address_v6(bytes);
}

// What is no address is its own share.
[[nodiscard]] inline std::string share_of(const std::string& client) {
  boost::system::error_code failed;
  const auto address = boost::asio::ip::make_address(client, failed);
  return failed ? client : share_of(address).to_string();
}

} // namespace godwit::io::http
