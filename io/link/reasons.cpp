#include "io/link/reasons.hpp"

#include <cerrno>
#include <span>
#include <system_error>

namespace godwit::io::link {
namespace {

struct sentence {
  int error;
  std::string_view text;
};

constexpr sentence of_devices[] = {
    {ENOENT, "no such device; is the autopilot plugged in?"},
    {ENODEV, "the device is not there any more; is the autopilot plugged in?"},
    {ENXIO, "the device is not there any more; is the autopilot plugged in?"},
    {EIO, "the device went away; is the autopilot plugged in?"},
    {EACCES, "permission denied; add the user to the group dialout"},
    {EPERM, "permission denied; add the user to the group dialout"},
    {EBUSY, "another program holds the device; close it, or give this link another device"},
    {EWOULDBLOCK, "another program holds the device; close it, or give this link another device"},
    {ENOTTY, "not a serial line"},
    {EISDIR, "not a serial line but a folder"},
};

constexpr sentence of_remote_places[] = {
    {ECONNREFUSED, "nobody listens there (connection refused)"},
    {ECONNRESET, "the other side has closed the connection"},
    {EPIPE, "the other side has closed the connection"},
    {ETIMEDOUT, "no answer (timed out)"},
    {EHOSTUNREACH, "no such host can be reached; is it switched on and in the same network?"},
    {EHOSTDOWN, "no such host can be reached; is it switched on and in the same network?"},
    {ENETUNREACH, "no network leads there; is this computer connected?"},
    {ENETDOWN, "the network is down; is this computer connected?"},
    {EACCES, "permission denied; is it a broadcast address, which links do not send to?"},
    {EPERM, "permission denied; does a firewall forbid it?"},
};

constexpr sentence of_local_places[] = {
    {EADDRINUSE, "another program listens on this port"},
    {EADDRNOTAVAIL, "no interface of this computer has this address"},
    {EACCES, "permission denied; ports below 1024 are for administrators"},
};

std::string reason(std::string_view place, int error, std::span<const sentence> sentences) {
  for (const auto& each : sentences)
    if (each.error == error)
      return std::string(place) + ": " + std::string(each.text);
  return std::string(place) + ": " + std::generic_category().message(error);
}

} // namespace

std::string device_reason(std::string_view device, int error) { return reason(device, error, of_devices); }
std::string remote_reason(std::string_view place, int error) { return reason(place, error, of_remote_places); }
std::string local_reason(std::string_view place, int error) { return reason(place, error, of_local_places); }

bool is_about_the_peer(int error) {
  return error == ECONNREFUSED || error == ECONNRESET || error == EHOSTUNREACH || error == EHOSTDOWN ||
         error == ENOPROTOOPT || error == EPROTO;
}

} // namespace godwit::io::link
