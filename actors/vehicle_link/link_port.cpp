#include "actors/vehicle_link/link_port.hpp"

#include <utility>

namespace godwit::vehicle_link {

tl::expected<void, std::string> link_port::open(const io::link::uri& where, const io::link::link_options& options,
                                                runtime::gateway gateway, wake_handle actor) {
  // Both callbacks come in the link's one thread, and so share one gateway.
  const auto way_in = std::make_shared<runtime::gateway>(std::move(gateway));
  const auto wake_actor = [way_in, actor = std::move(actor)] { way_in->tell(actor, wake{}); };
  io::link::link_callbacks callbacks;
  callbacks.received = [this, wake_actor](io::link::peer_id peer, std::span<const std::byte> bytes, bool is_datagram) {
    if (incoming().put(peer, bytes, is_datagram))
      wake_actor();
  };
  callbacks.changed = [this, wake_actor](const io::link::link_status& status) {
    if (incoming().put(status))
      wake_actor();
  };
  auto opened = io::link::open_link(where, std::move(callbacks), options);
  if (!opened)
    return tl::unexpected(opened.error());
  const std::lock_guard guard(mutex_);
  link_ = std::move(*opened);
  return {};
}

void link_port::close() {
  std::shared_ptr<io::link::link> last; // ends the link's thread when it goes, outside of the lock
  const std::lock_guard guard(mutex_);
  last.swap(link_);
}

std::shared_ptr<io::link::link> link_port::current() const {
  const std::lock_guard guard(mutex_);
  return link_;
}

bool link_port::send(std::span<const std::byte> frame, io::link::peer_id to) {
  const auto link = current();
  return link && link->send(frame, to);
}

io::link::link_counters link_port::counters() const {
  const auto link = current();
  return link ? link->counters() : io::link::link_counters{};
}

std::string link_port::description() const {
  const auto link = current();
  return link ? link->description() : std::string("closed");
}

} // namespace godwit::vehicle_link
