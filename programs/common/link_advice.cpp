#include "programs/common/link_advice.hpp"

namespace godwit::programs {

std::string advice_for_silence(const io::link::uri& line, std::chrono::seconds silent, bool sends_heartbeat) {
  using kind = io::link::uri::kind;
  const std::string nothing = "nothing was heard for " + std::to_string(silent.count()) + " s. ";
  const std::string heartbeat = sends_heartbeat ? "" : " Some speak only when they hear somebody: try --heartbeat.";
  switch (line.which) {
  case kind::udp_in:
  case kind::tcp_in:
    return nothing + "Does the vehicle or simulator send to this computer, port " + std::to_string(line.port) +
           "? A firewall may hold it back, and another program may have the port.";
  case kind::udp_out:
    return nothing + "Does somebody listen at " + io::link::host_and_port(line.host, line.port) + "?" + heartbeat;
  case kind::tcp:
    return nothing + "Is MAVLink spoken at " + io::link::host_and_port(line.host, line.port) + "?" + heartbeat;
  case kind::serial:
    break;
  }
  return nothing + "Is " + line.device +
         " the port of the autopilot, are RX and TX crossed, and is MAVLink switched on for that port?" + heartbeat;
}

std::string advice_for_noise(const io::link::uri& line, std::uint64_t bytes) {
  const bool is_serial = line.which == io::link::uri::kind::serial;
  return std::to_string(bytes) + " bytes came and not one MAVLink frame. " +
         (is_serial ? "Is " + std::to_string(line.baud) + " the baud rate of the other end?"
                    : std::string("Is it MAVLink that is sent here?"));
}

} // namespace godwit::programs
