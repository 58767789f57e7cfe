#include "actors/fleet_link/remedy.hpp"

namespace godwit::fleet_link {

std::string_view remedy_of(broker_failure why) {
  switch (why) {
  case broker_failure::none:
  case broker_failure::lost:
    return {};
  case broker_failure::not_resolved:
    return "check the name in telemetry.broker, and the name servers of this computer";
  case broker_failure::unreachable:
    return "check that the broker runs and listens there, and what stands between";
  case broker_failure::certificate:
    return "name the issuer of the broker's certificate in telemetry.ca_file, call the broker by a name in its "
           "certificate, and check the clock";
  case broker_failure::not_authorised:
    return "check telemetry.username and telemetry.password_file, and that the broker lets this user publish to the "
           "topics gw/v1/VEHICLE/#";
  case broker_failure::taken_over:
    return "give each vehicle a telemetry.vehicle of its own";
  case broker_failure::refused:
    return "read the log of the broker";
  case broker_failure::retain_refused:
    return "late subscribers do not get the state of the vehicle: let the broker retain messages";
  case broker_failure::unusable:
    return "fix the file and its mode; it is read again with each try";
  }
  return {};
}

} // namespace godwit::fleet_link
