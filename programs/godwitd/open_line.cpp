#include "programs/godwitd/open_line.hpp"

#include <boost/asio/ip/address.hpp>

#include "actors/domain/confirmation/confirmation_table.hpp"

namespace godwit::daemon {
namespace {

using kind = io::link::uri::kind;

bool is_loopback(const std::string& host) {
  boost::system::error_code is_name;
  const auto address = boost::asio::ip::make_address(host, is_name);
  return is_name ? host == "localhost" : address.is_loopback();
}

} // namespace

int heartbeats_to_begin(const io::link::uri& line, bool is_signed) {
  const bool can_be_forged = line.which == kind::udp_in || line.which == kind::udp_out;
  return can_be_forged && !is_signed ? domain::heartbeats_to_believe : 1;
}

bool stays_in_vehicle(const io::link::uri& line) { return line.which == kind::serial || is_loopback(line.host); }

std::string open_line(const io::link::uri& line, bool is_signed) {
  return is_signed || stays_in_vehicle(line) ? std::string() : line.text();
}

std::string open_line_warning(const io::link::uri& line, bool is_signed, std::string_view option) {
  const auto open = open_line(line, is_signed);
  if (open.empty())
    return {};
  return open + " has no key: whoever is in this network can speak on it; give it one with " + std::string(option) +
         ", or bind it to 127.0.0.1";
}

} // namespace godwit::daemon
