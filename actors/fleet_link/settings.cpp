#include "actors/fleet_link/settings.hpp"

#include <algorithm>
#include <cstddef>

namespace godwit::fleet_link {
namespace {

constexpr std::size_t max_name = 64;

// Neither a wildcard nor a level of a topic.
bool is_name(const std::string& text) {
  return !text.empty() && text.size() <= max_name && std::ranges::all_of(text, [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '.' || c == '-' ||
           c == '_';
  });
}

} // namespace

std::optional<std::string> objection_to(const settings& configured) {
  if (!is_name(configured.vehicle))
    return (configured.vehicle.empty() ? std::string("vehicle is missing")
                                       : "vehicle is \"" + configured.vehicle + "\"") +
           ": name the vehicle by 1 to 64 letters, digits, points, - and _, by a name that no other one has at this "
           "broker";
  if (configured.username.empty() && !configured.password_file.empty())
    return "password_file needs telemetry.username beside it";
  if (configured.certificate_file.empty() != configured.key_file.empty())
    return "certificate_file and telemetry.key_file belong together: name both, or neither";
  if (!configured.broker.uses_tls && !(configured.ca_file.empty() && configured.certificate_file.empty()))
    return "ca_file, telemetry.certificate_file and telemetry.key_file are for mqtts://";
  return {};
}

} // namespace godwit::fleet_link
