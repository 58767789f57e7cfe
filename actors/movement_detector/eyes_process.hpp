// The helper process behind the port: what it says becomes mail of the actor.
//
//   auto process = std::make_shared<io::eyes::helper>(...);
//   auto port = std::make_shared<eyes_process>(process);
//   auto eyes = actors.add<movement_detector::actor>(..., port, ...);
//   port->open(actors.make_gateway("eyes_port"), eyes);   // before the actors start
//
// Thread: open by the owner; the rest from any.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "actors/movement_detector/eyes_port.hpp"
#include "io/eyes/helper.hpp"
#include "messages/movement_detector/handle.hpp"
#include "runtime/gateway.hpp"

namespace godwit::movement_detector {

class eyes_process final : public eyes_port {
public:
  // May be called by any thread and does not block.
  using picture_taker = std::function<void(const std::string& sighting_id, io::eyes::cutout what)>;
  // They come once a second of each track; what is older may be of another run, whose tracks had the same numbers.
  static constexpr std::int64_t cutout_lasts_ns = 1'200'000'000;

  eyes_process(std::shared_ptr<io::eyes::helper> process, picture_taker pictures)
      : process_(std::move(process)), pictures_(std::move(pictures)) {}

  void open(runtime::gateway gateway, port_handle actor);

  void start(std::uint32_t run, const io::eyes::begin& how) override { process_->start(run, how); }
  void end(std::uint32_t upto) override { process_->end(upto); }
  void tell(const io::eyes::pose& where) override { static_cast<void>(process_->send(where)); }
  void keep_picture(std::uint32_t track, std::int64_t captured_ns, const std::string& id) override;

private:
  std::shared_ptr<io::eyes::helper> process_;
  picture_taker pictures_;
};

} // namespace godwit::movement_detector
