#include "io/link/line.hpp"

#include <utility>

namespace godwit::io::link {

tl::expected<void, std::string> line::open(const uri& where, const link_options& options,
                                           const std::function<void()>& wake) {
  link_callbacks callbacks;
  callbacks.received = [this, wake](peer_id peer, std::span<const std::byte> bytes, bool is_datagram) {
    if (tap_)
      tap_->received(peer, bytes, is_datagram);
    if (incoming().put(peer, bytes, is_datagram))
      wake();
  };
  callbacks.changed = [this, wake](const link_status& status) {
    if (incoming().put(status))
      wake();
  };
  auto opened = open_link(where, std::move(callbacks), options);
  if (!opened)
    return tl::unexpected(opened.error());
  const std::lock_guard guard(mutex_);
  link_ = std::move(*opened);
  return {};
}

void line::close() {
  std::shared_ptr<link> last; // ends the link's thread when it goes, outside of the lock
  const std::lock_guard guard(mutex_);
  last.swap(link_);
}

std::shared_ptr<link> line::current() const {
  const std::lock_guard guard(mutex_);
  return link_;
}

bool line::send(std::span<const std::byte> frame, peer_id to) {
  const auto open = current();
  if (!open || !open->send(frame, to))
    return false;
  if (tap_)
    tap_->sent(frame);
  return true;
}

link_counters line::counters() const {
  const auto open = current();
  return open ? open->counters() : link_counters{};
}

std::string line::description() const {
  const auto open = current();
  return open ? open->description() : std::string("closed");
}

} // namespace godwit::io::link
