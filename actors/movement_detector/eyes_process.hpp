// The helper process behind the port: what it says becomes mail of the actor.
//
//   auto process = std::make_shared<io::eyes::helper>(...);
//   auto port = std::make_shared<eyes_process>(process);
//   auto eyes = actors.add<movement_detector::actor>(..., port, ...);
//   port->open(actors.make_gateway("eyes_port"), eyes);   // before the actors start
//
// Thread: open by the owner; the rest from any.
#pragma once

#include <memory>
#include <utility>

#include "actors/movement_detector/eyes_port.hpp"
#include "io/eyes/helper.hpp"
#include "messages/movement_detector/handle.hpp"
#include "runtime/gateway.hpp"

namespace godwit::movement_detector {

class eyes_process final : public eyes_port {
public:
  explicit eyes_process(std::shared_ptr<io::eyes::helper> process) : process_(std::move(process)) {}

  void open(runtime::gateway gateway, port_handle actor);

  void start(std::uint32_t run, const io::eyes::begin& how) override { process_->start(run, how); }
  void end(std::uint32_t upto) override { process_->end(upto); }
  void tell(const io::eyes::pose& where) override { static_cast<void>(process_->send(where)); }

private:
  std::shared_ptr<io::eyes::helper> process_;
};

} // namespace godwit::movement_detector
