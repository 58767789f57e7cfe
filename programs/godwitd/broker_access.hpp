// The way to the broker of the settings, as far as this godwitd was built with one (CMake option GODWIT_MQTT).
// Thread: one owner.
#pragma once

#include <functional>
#include <memory>

#include "actors/fleet_link/broker_port.hpp"
#include "actors/fleet_link/settings.hpp"
#include "messages/fleet_link/handle.hpp"
#include "runtime/gateway.hpp"

namespace godwit::daemon {

struct broker_access {
  std::shared_ptr<fleet_link::broker_port> port; // none: the settings were refused where there is no MQTT
  std::function<void(runtime::gateway, fleet_link::port_handle)> attach; // before the actors start
  std::function<void()> detach;                                          // before they are stopped
};

[[nodiscard]] broker_access make_broker_access(const fleet_link::settings& wanted);

} // namespace godwit::daemon
