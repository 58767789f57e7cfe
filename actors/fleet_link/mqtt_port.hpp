// A broker behind the port: what becomes of its connection is mail of the actor.
//
//   auto port = std::make_shared<mqtt_port>(settings);
//   auto fleet = actors.add<fleet_link::actor>(..., port, ...);
//   port->attach(actors.make_gateway("broker_port"), fleet);   // before the actors start
//
// One connection at a time: a new one ends the one before it, and detach() from outside ends it for good. All of them
// share one thread, which also reads the files of keys and passwords. Thread: any.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>

#include "actors/fleet_link/broker_port.hpp"
#include "actors/fleet_link/settings.hpp"
#include "io/link/io_thread.hpp"
#include "io/mqtt/connection.hpp"
#include "messages/fleet_link/handle.hpp"
#include "runtime/gateway.hpp"

namespace godwit::fleet_link {

class mqtt_port final : public broker_port {
public:
  explicit mqtt_port(const settings& configured);
  ~mqtt_port() override;

  void attach(runtime::gateway gateway, port_handle actor);
  // The broker then publishes the will: the vehicle is offline.
  void detach();

  void open(std::uint64_t attempt, const publication& will) override;
  void close(std::uint64_t upto) override;
  void publish(std::uint64_t attempt, const publication& what) override;

private:
  struct way_in; // to the actor; shared with what listens to the connections

  [[nodiscard]] io::mqtt::listener listener_of(std::uint64_t attempt) const;

  io::link::io_thread thread_; // first, so that its context is there until all that uses it is gone
  io::mqtt::connection_settings wanted_;
  std::shared_ptr<way_in> way_in_;
  std::mutex mutex_; // over the rest
  std::uint64_t attempt_ = 0;
  std::shared_ptr<io::mqtt::connection> connection_; // none: there is none
  bool is_detached_ = false;
};

} // namespace godwit::fleet_link
