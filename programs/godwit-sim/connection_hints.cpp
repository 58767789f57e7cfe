#include "programs/godwit-sim/connection_hints.hpp"

namespace godwit::sim {
namespace {

// Where a station on this computer finds what listens on all interfaces.
std::string reachable(const io::link::uri& where) {
  const bool is_everywhere = where.host.empty() || where.host == "0.0.0.0" || where.host == "::";
  return io::link::host_and_port(is_everywhere ? "127.0.0.1" : where.host, where.port);
}

std::vector<std::string> lines(const std::string& qgroundcontrol, const std::string& mavproxy,
                               const std::string& mavsdk) {
  return {"  QGroundControl  " + qgroundcontrol, "  MAVProxy        mavproxy.py --master=" + mavproxy,
          "  MAVSDK          " + mavsdk};
}

} // namespace

std::vector<std::string> connection_hints(const io::link::uri& where) {
  using kind = io::link::uri::kind;
  const auto place = reachable(where);
  const auto port = std::to_string(where.port);
  switch (where.which) {
  case kind::udp_in:
    return lines("Comm Links, Add, type UDP, server address " + place, "udpout:" + place, "udpout://" + place);
  case kind::udp_out:
    return lines(where.port == 14550 ? "connects by itself" : "Comm Links, Add, type UDP, port " + port,
                 "udpin:0.0.0.0:" + port, "udpin://0.0.0.0:" + port);
  case kind::tcp_in:
    return lines("Comm Links, Add, type TCP, server address " + place, "tcp:" + place, "tcpout://" + place);
  case kind::tcp:
    return lines("does not listen on TCP", "tcpin:0.0.0.0:" + port, "tcpin://0.0.0.0:" + port);
  case kind::serial:
    break;
  }
  return {"  the other end of the line, at " + std::to_string(where.baud) + " baud"};
}

} // namespace godwit::sim
