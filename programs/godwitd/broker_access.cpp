#include "programs/godwitd/broker_access.hpp"

#ifdef GODWIT_HAS_MQTT
#include <utility>

#include "actors/fleet_link/mqtt_port.hpp"
#endif

namespace godwit::daemon {

#ifdef GODWIT_HAS_MQTT

broker_access make_broker_access(const fleet_link::settings& wanted) {
  auto port = std::make_shared<fleet_link::mqtt_port>(wanted);
  return {port,
          [port](runtime::gateway way_in, fleet_link::port_handle actor) {
            port->attach(std::move(way_in), std::move(actor));
          },
          [port] { port->detach(); }};
}

#else

broker_access make_broker_access(const fleet_link::settings&) { return {}; }

#endif

} // namespace godwit::daemon
