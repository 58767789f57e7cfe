#include "io/link/udp_in_link.hpp"

#include <algorithm>

#include <boost/asio/ip/v6_only.hpp>
#include <boost/asio/post.hpp>

#include "io/link/datagram_reader.hpp"
#include "io/link/reasons.hpp"

namespace godwit::io::link {

udp_in_link::udp_in_link(const uri& where, link_callbacks callbacks, const link_options& options)
    : where_(where), received_(std::move(callbacks.received)), peers_(options.max_peers, options.forget_peer_after),
      description_(where.text()), thread_(options.thread), lookup_(thread_.context()), socket_(thread_.context()),
      reader_(
          socket_, thread_.buffer(),
          [this](const udp::endpoint& from, std::span<const std::byte> bytes) { heard(from, bytes); },
          [this](int error) { return read_failed(error); }),
      life_(thread_.context(), {options.first_retry, options.udp_retry_cap}, counters_, std::move(callbacks.changed),
            [this] { open(); }) {
  boost::asio::post(thread_.context(), alive_.guard([this] { life_.begin("opening " + where_.text()); }));
  thread_.start();
}

void udp_in_link::open() {
  if (where_.host.empty()) {
    // One IPv6 socket hears both families; where the system has no IPv6, an IPv4 socket hears the rest.
    auto failure = bind({udp::v6(), where_.port});
    if (failure == boost::asio::error::address_family_not_supported)
      failure = bind({udp::v4(), where_.port});
    return failure ? life_.failed(local_reason(where_.text(), failure.value())) : opened();
  }
  lookup_.start(where_.host, [this](const found_addresses& found) {
    if (!found)
      return life_.failed(found.error());
    const auto failure = bind({found->front(), where_.port});
    return failure ? life_.failed(local_reason(where_.text(), failure.value())) : opened();
  });
}

boost::system::error_code udp_in_link::bind(const udp::endpoint& local) {
  boost::system::error_code failure;
  socket_.open(local.protocol(), failure);
  if (!failure && local.protocol() == udp::v6())
    socket_.set_option(boost::asio::ip::v6_only(!where_.host.empty()), failure);
  if (!failure)
    socket_.bind(local, failure);
  if (!failure)
    socket_.non_blocking(true, failure);
  boost::system::error_code ignored;
  if (failure)
    socket_.close(ignored);
  return failure;
}

void udp_in_link::opened() {
  boost::system::error_code ignored;
  auto real = where_;
  real.port = socket_.local_endpoint(ignored).port();
  {
    const std::lock_guard lock(mutex_);
    send_descriptor_ = socket_.native_handle();
    description_ = real.text();
  }
  reader_.start();
  life_.opened("listening on " + real.text());
}

void udp_in_link::heard(const udp::endpoint& from, std::span<const std::byte> bytes) {
  peer_id peer = every_peer;
  {
    const std::lock_guard lock(mutex_);
    peer = peers_.heard(from, std::chrono::steady_clock::now());
  }
  counters_.received(bytes.size());
  received_(peer, bytes, true);
}

bool udp_in_link::read_failed(int error) {
  counters_.errors.add();
  if (is_about_the_peer(error))
    return true;
  {
    const std::lock_guard lock(mutex_);
    send_descriptor_ = -1;
  }
  reader_.stop();
  boost::system::error_code ignored;
  socket_.close(ignored);
  life_.failed(local_reason(where_.text(), error));
  return false;
}

bool udp_in_link::send(std::span<const std::byte> bytes, peer_id to) {
  if (bytes.empty())
    return true;
  const std::lock_guard lock(mutex_);
  if (send_descriptor_ < 0) {
    counters_.tx_dropped.add();
    return false;
  }
  peers_.forget_silent(std::chrono::steady_clock::now());
  bool known = false;
  bool sent = false;
  for (const auto& each : peers_.all()) {
    if (to == every_peer || to == each.id) {
      known = true;
      sent = transmit(bytes, each.address) || sent;
    }
  }
  counters_.tx_no_peer.add(known ? 0 : 1);
  return sent;
}

// A send that fails says something about the way to this peer, not about the socket.
bool udp_in_link::transmit(std::span<const std::byte> bytes, const udp::endpoint& to) {
  const int error = send_datagram(send_descriptor_, bytes, to.data(), static_cast<socklen_t>(to.size()));
  if (error == 0) {
    counters_.sent(bytes.size());
    return true;
  }
  counters_.errors.add(error == EAGAIN ? 0 : 1);
  counters_.tx_dropped.add();
  return false;
}

link_counters udp_in_link::counters() const {
  auto all = counters_.values();
  const std::lock_guard lock(mutex_);
  peers_.forget_silent(std::chrono::steady_clock::now());
  all.peers = peers_.all().size();
  all.peers_forgotten = peers_.forgotten();
  all.peers_evicted = peers_.evicted();
  all.peers_refused = peers_.refused();
  return all;
}

std::string udp_in_link::description() const {
  const std::lock_guard lock(mutex_);
  return description_;
}

peer_table::peer_table(std::size_t max_peers, std::chrono::milliseconds forget_after)
    : max_peers_(max_peers), forget_after_(forget_after) {
  peers_.reserve(max_peers);
}

peer_id peer_table::heard(const endpoint& address, time_point now) {
  forget_silent(now);
  for (auto& each : peers_) {
    if (each.address == address) {
      each.heard_at = now;
      return each.id;
    }
  }
  if (peers_.size() == max_peers_ && !makes_room(now)) {
    ++refused_;
    return free_id();
  }
  peers_.push_back({free_id(), address, now});
  return last_id_;
}

void peer_table::forget_silent(time_point now) {
  forgotten_ += std::erase_if(peers_, [&](const peer& each) { return now - each.heard_at >= forget_after_; });
}

bool peer_table::makes_room(time_point now) {
  const auto earlier = [](const peer& a, const peer& b) { return a.heard_at < b.heard_at; };
  const auto longest = std::min_element(peers_.begin(), peers_.end(), earlier);
  if (now - longest->heard_at < keeps_place)
    return false;
  peers_.erase(longest);
  ++evicted_;
  return true;
}

// Numbers start again after four billion peers, which a flood reaches in a day; a number in use is then left out.
peer_id peer_table::free_id() {
  const auto in_use = [this](peer_id id) {
    return std::any_of(peers_.begin(), peers_.end(), [id](const peer& each) { return each.id == id; });
  };
  do {
    ++last_id_;
  } while (last_id_ == every_peer || in_use(last_id_));
  return last_id_;
}

} // namespace godwit::io::link
