// Who talks to whom about which plan: fills in the address of what is sent, and tells what is ours of what arrives.
//
// Two ground stations may share a link, so answers meant for the other one arrive here too. A target of 0 means
// everybody, or an older sender that does not fill it in. Source: MAVLink mission protocol. Thread: values.
#pragma once

#include "io/mavlink/enums.hpp"
#include "io/mavlink/frame.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"

namespace godwit::vehicle_link::transfer {

namespace mavlink = io::mavlink;

struct parties {
  mavlink::sender ourselves;
  mavlink::sender peer;
  mavlink::mav_mission_type mission_type = mavlink::mav_mission_type::mission;

  // MESSAGE with the peer as target, and our mission type.
  template <class M>
  [[nodiscard]] M addressed(M message) const {
    message.target_system = peer.system;
    message.target_component = peer.component;
    message.mission_type = mavlink::number(mission_type);
    return message;
  }

  template <class M>
  [[nodiscard]] bool concerns(const M& message) const {
    return (message.target_system == 0 || message.target_system == ourselves.system) &&
           (message.target_component == 0 || message.target_component == ourselves.component) &&
           message.mission_type == mavlink::number(mission_type);
  }
};

} // namespace godwit::vehicle_link::transfer
