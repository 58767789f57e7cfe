#include "programs/godwit-trace/link_hints.hpp"

namespace godwit::trace_tool {

std::optional<std::string> link_hints::due(std::chrono::milliseconds elapsed, const io::mavlink::scan_counters& heard) {
  if (heard.frames != 0)
    return std::nullopt;
  if (!told_v1_ && elapsed >= v1_after && heard.v1_frames >= v1_frames_enough) {
    told_v1_ = true;
    told_silence_ = true;
    return "only MAVLink 1 is heard, which is not shown. Switch the autopilot to MAVLink 2: ArduPilot by "
           "SERIALn_PROTOCOL = 2 for the port n, PX4 by MAV_PROTO_VER = 2; then restart it.";
  }
  if (told_silence_ || elapsed < silent_after || heard.v1_frames != 0)
    return std::nullopt;
  told_silence_ = true;
  return heard.bytes == 0 ? silence() : noise(heard.bytes);
}

std::string link_hints::silence() const {
  using kind = io::link::uri::kind;
  const std::string nothing = "nothing was heard for " + std::to_string(silent_after.count()) + " s. ";
  const std::string heartbeat = has_heartbeat_ ? "" : " Some speak only when they hear somebody: try --heartbeat.";
  switch (where_.which) {
  case kind::udp_in:
  case kind::tcp_in:
    return nothing + "Does the vehicle or simulator send to this computer, port " + std::to_string(where_.port) +
           "? A firewall may hold it back, and another program may have the port.";
  case kind::udp_out:
    return nothing + "Does somebody listen at " + io::link::host_and_port(where_.host, where_.port) + "?" + heartbeat;
  case kind::tcp:
    return nothing + "Is MAVLink spoken at " + io::link::host_and_port(where_.host, where_.port) + "?" + heartbeat;
  case kind::serial:
    break;
  }
  return nothing + "Is " + where_.device +
         " the port of the autopilot, are RX and TX crossed, and is MAVLink switched "
         "on for that port?" +
         heartbeat;
}

std::string link_hints::noise(std::uint64_t bytes) const {
  const bool is_serial = where_.which == io::link::uri::kind::serial;
  return std::to_string(bytes) + " bytes came and not one MAVLink frame. " +
         (is_serial ? "Is " + std::to_string(where_.baud) + " the baud rate of the other end?"
                    : std::string("Is it MAVLink that is sent here?"));
}

} // namespace godwit::trace_tool
