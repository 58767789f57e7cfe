#include "io/link/tcp_in_link.hpp"

#include <algorithm>
#include <cerrno>

#include <boost/asio/ip/v6_only.hpp>
#include <boost/asio/post.hpp>

#include "io/link/reasons.hpp"
#include "io/link/tcp_opener.hpp"

namespace godwit::io::link {

tcp_in_link::tcp_in_link(const uri& where, link_callbacks callbacks, const link_options& options)
    : where_(where), callbacks_(std::move(callbacks)), max_peers_(options.max_peers),
      queue_bytes_(options.send_queue_bytes), thread_(options.thread), description_(where.text()),
      lookup_(thread_.context()), acceptor_(thread_.context()),
      life_(thread_.context(), {options.first_retry, options.tcp_retry_cap}, counters_, callbacks_.changed,
            [this] { open(); }) {
  boost::asio::post(thread_.context(), alive_.guard([this] { life_.begin("opening " + where_.text()); }));
  thread_.start();
}

void tcp_in_link::open() {
  const auto end_with = [this](const boost::system::error_code& failure) {
    return failure ? life_.failed(local_reason(where_.text(), failure.value())) : opened();
  };
  if (where_.host.empty()) {
    // One IPv6 socket hears both families; where the system has no IPv6, an IPv4 socket hears the rest.
    auto failure = listen({tcp::v6(), where_.port});
    if (failure == boost::asio::error::address_family_not_supported)
      failure = listen({tcp::v4(), where_.port});
    return end_with(failure);
  }
  lookup_.start(where_.host, [this, end_with](const found_addresses& found) {
    if (!found)
      return life_.failed(found.error());
    end_with(listen({found->front(), where_.port}));
  });
}

boost::system::error_code tcp_in_link::listen(const tcp::endpoint& local) {
  boost::system::error_code failure;
  acceptor_.open(local.protocol(), failure);
  if (!failure && local.protocol() == tcp::v6())
    acceptor_.set_option(boost::asio::ip::v6_only(!where_.host.empty()), failure);
  if (!failure)
    acceptor_.set_option(tcp::acceptor::reuse_address(true), failure);
  if (!failure)
    acceptor_.bind(local, failure);
  if (!failure)
    acceptor_.listen(tcp::acceptor::max_listen_connections, failure);
  if (!failure)
    acceptor_.non_blocking(true, failure);
  boost::system::error_code ignored;
  if (failure)
    acceptor_.close(ignored);
  return failure;
}

void tcp_in_link::opened() {
  boost::system::error_code ignored;
  auto real = where_;
  real.port = acceptor_.local_endpoint(ignored).port();
  {
    const std::lock_guard lock(mutex_);
    description_ = real.text();
    is_up_ = true;
  }
  wait_for_peers();
  life_.opened("listening on " + real.text());
}

void tcp_in_link::wait_for_peers() {
  acceptor_.async_wait(tcp::acceptor::wait_read, alive_.guard([this](const boost::system::error_code& cancelled) {
    if (!cancelled)
      accept();
  }));
}

void tcp_in_link::accept() {
  for (int n = 0; n < max_accepts_a_turn; ++n) {
    tcp::socket socket(thread_.context());
    boost::system::error_code error;
    acceptor_.accept(socket, error);
    if (error == boost::asio::error::would_block)
      break;
    if (error == boost::asio::error::connection_aborted || error == boost::asio::error::interrupted)
      continue; // somebody has changed his mind
    if (error)
      return accept_failed(error.value());
    connected(std::move(socket));
  }
  wait_for_peers();
}

// No descriptor or memory left, as a rule. Listening goes on after the pause of the lifecycle; who is connected stays.
void tcp_in_link::accept_failed(int error) {
  counters_.errors.add();
  boost::system::error_code ignored;
  acceptor_.close(ignored);
  {
    const std::lock_guard lock(mutex_);
    is_up_ = false;
  }
  life_.failed(local_reason(where_.text(), error));
}

void tcp_in_link::connected(tcp::socket socket) {
  boost::system::error_code error = set_up_tcp(socket);
  if (error)
    return; // gone already
  {
    const std::lock_guard lock(mutex_);
    if (peers_.size() == max_peers_) {
      ++peers_refused_;
      return;
    }
  }
  ++last_id_;
  descriptor held(socket.release(error));
  if (error)
    return;
  auto stream =
      std::make_shared<open_stream>(thread_.context(), thread_.buffer(), queue_bytes_, counters_, hooks(last_id_));
  if (stream->take(std::move(held)))
    return;
  const std::lock_guard lock(mutex_);
  peers_.push_back({last_id_, std::move(stream)});
}

open_stream::hooks tcp_in_link::hooks(peer_id of) {
  return {.write = write_tcp,
          .discard_output = [](int) {}, // closing a TCP socket does not wait
          .received = [this, of](std::span<const std::byte> bytes) { callbacks_.received(of, bytes, false); },
          .ended = [this, of](int) { left(of); }};
}

void tcp_in_link::left(peer_id who) {
  std::shared_ptr<open_stream> stream;
  {
    const std::lock_guard lock(mutex_);
    const auto found = std::find_if(peers_.begin(), peers_.end(), [who](const peer& each) { return each.id == who; });
    if (found == peers_.end())
      return;
    stream = std::move(found->stream);
    peers_.erase(found);
  }
  // The stream calls us: it ends when it has returned.
  boost::asio::post(thread_.context(), [ended = std::move(stream)]() mutable { ended.reset(); });
  if (callbacks_.left)
    callbacks_.left(who);
}

bool tcp_in_link::send(std::span<const std::byte> bytes, peer_id to) {
  if (bytes.empty())
    return true;
  const std::lock_guard lock(mutex_);
  if (!is_up_ && peers_.empty()) {
    counters_.tx_dropped.add();
    return false;
  }
  bool known = false;
  bool sent = false;
  for (const auto& each : peers_) {
    if (to == every_peer || to == each.id) {
      known = true;
      sent = each.stream->send(bytes) || sent;
    }
  }
  counters_.tx_no_peer.add(known ? 0 : 1);
  return sent;
}

link_counters tcp_in_link::counters() const {
  auto all = counters_.values();
  const std::lock_guard lock(mutex_);
  all.peers = peers_.size();
  all.peers_refused = peers_refused_;
  for (const auto& each : peers_)
    all.tx_queued_bytes += each.stream->queued_bytes();
  return all;
}

std::string tcp_in_link::description() const {
  const std::lock_guard lock(mutex_);
  return description_;
}

} // namespace godwit::io::link
