// Error numbers of the system as sentences that say what to do.
//
// Thread: any, pure. Source: errno(3), and what Linux gives for devices and sockets in open(2), bind(2), connect(2).
#pragma once

#include <string>
#include <string_view>

namespace godwit::io::link {

// For a serial device: "/dev/ttyACM0: no such device; is the autopilot plugged in?"
[[nodiscard]] std::string device_reason(std::string_view device, int error);

// For a remote place: "127.0.0.1:5760: nobody listens there (connection refused)"
[[nodiscard]] std::string remote_reason(std::string_view place, int error);

// For the place to listen at: "127.0.0.1:14550: another program listens on this port"
[[nodiscard]] std::string local_reason(std::string_view place, int error);

// True for what the network tells about the other side of a UDP socket while the socket itself goes on working: nobody
// listens there, or nobody is there.
[[nodiscard]] bool is_about_the_peer(int error);

} // namespace godwit::io::link
