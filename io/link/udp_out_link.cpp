#include "io/link/udp_out_link.hpp"

#include <boost/asio/post.hpp>

#include "io/link/datagram_reader.hpp"
#include "io/link/reasons.hpp"

namespace godwit::io::link {

namespace {

// The datagram is lost and the socket is as good as before: no room at the moment, too long, or a firewall's word.
bool is_about_one_datagram(int error) {
  return error == EAGAIN || error == ENOBUFS || error == ENOMEM || error == EMSGSIZE || error == EPERM;
}

} // namespace

udp_out_link::udp_out_link(const uri& where, link_callbacks callbacks, const link_options& options)
    : where_(where), place_(host_and_port(where.host, where.port)), received_(std::move(callbacks.received)),
      thread_(options.thread), lookup_(thread_.context()), socket_(thread_.context()),
      reader_(
          socket_, thread_.buffer(), [this](const udp::endpoint&, std::span<const std::byte> bytes) { heard(bytes); },
          [this](int error) { return read_failed(error); }),
      refusal_timer_(thread_.context()), life_(thread_.context(), {options.first_retry, options.udp_retry_cap},
                                               counters_, std::move(callbacks.changed), [this] { open(); }) {
  boost::asio::post(thread_.context(), alive_.guard([this] { life_.begin("opening " + where_.text()); }));
  thread_.start();
}

void udp_out_link::open() {
  lookup_.start(where_.host, [this](const found_addresses& found) {
    if (!found)
      return life_.failed(found.error());
    connect(found->front());
  });
}

void udp_out_link::connect(const boost::asio::ip::address& address) {
  const udp::endpoint remote(address, where_.port);
  boost::system::error_code failure;
  socket_.open(remote.protocol(), failure);
  if (!failure)
    socket_.connect(remote, failure);
  if (!failure)
    socket_.non_blocking(true, failure);
  if (failure) {
    boost::system::error_code ignored;
    socket_.close(ignored);
    return life_.failed(remote_reason(place_, failure.value()));
  }
  {
    const std::lock_guard lock(mutex_);
    send_descriptor_ = socket_.native_handle();
    report_under_way_ = false;
    watch_.refused(); // what was sent over an older socket tells nothing about this one
  }
  reader_.start();
  life_.opened("sending to " + place_);
}

void udp_out_link::heard(std::span<const std::byte> bytes) {
  counters_.received(bytes.size());
  if (life_.phase() == link_phase::down)
    life_.answered("sending to " + place_);
  received_(only_peer, bytes, true);
}

bool udp_out_link::read_failed(int error) {
  counters_.errors.add();
  if (is_about_the_peer(error)) {
    refused(error);
    return true;
  }
  lost(error);
  return false;
}

void udp_out_link::refused(int error) {
  {
    const std::lock_guard lock(mutex_);
    watch_.refused();
  }
  life_.unanswered(remote_reason(place_, error) + "; still sending");
  if (!refusal_timer_runs_)
    look_whether_refusal_is_over();
}

void udp_out_link::look_whether_refusal_is_over() {
  refusal_timer_runs_ = true;
  refusal_timer_.expires_after(look_again);
  refusal_timer_.async_wait(alive_.guard([this](const boost::system::error_code&) {
    refusal_timer_runs_ = false;
    if (life_.phase() != link_phase::down || !socket_.is_open())
      return;
    bool over = false;
    {
      const std::lock_guard lock(mutex_);
      over = watch_.is_over(std::chrono::steady_clock::now());
    }
    if (over)
      life_.answered("sending to " + place_);
    else
      look_whether_refusal_is_over();
  }));
}

// Such an error means that the way there has changed, say the network's address: a new socket finds the new way.
void udp_out_link::lost(int error) {
  {
    const std::lock_guard lock(mutex_);
    send_descriptor_ = -1;
  }
  reader_.stop();
  boost::system::error_code ignored;
  socket_.close(ignored);
  life_.failed(remote_reason(place_, error));
}

bool udp_out_link::send(std::span<const std::byte> bytes, peer_id to) {
  if (bytes.empty())
    return true;
  if (to > only_peer) {
    counters_.tx_no_peer.add();
    return false;
  }
  const std::lock_guard lock(mutex_);
  int error = ENOTCONN;
  if (send_descriptor_ >= 0) {
    error = send_datagram(send_descriptor_, bytes, nullptr, 0);
    if (is_about_the_peer(error)) {
      // The system gives the news of an earlier datagram instead of sending this one, and only once.
      report(error);
      error = send_datagram(send_descriptor_, bytes, nullptr, 0);
    }
    if (error != 0)
      report(error);
  }
  if (error != 0) {
    counters_.tx_dropped.add();
    return false;
  }
  watch_.sent(std::chrono::steady_clock::now());
  counters_.sent(bytes.size());
  return true;
}

// Called by senders, under the lock. What follows from an error is for the link's own thread.
void udp_out_link::report(int error) {
  if (error == EAGAIN)
    return; // the send buffer is full: a drop, not an error
  counters_.errors.add();
  if (is_about_one_datagram(error) || report_under_way_)
    return;
  report_under_way_ = true;
  const bool peer = is_about_the_peer(error);
  if (!peer)
    send_descriptor_ = -1;
  boost::asio::post(thread_.context(), alive_.guard([this, error, peer] {
    {
      const std::lock_guard lock(mutex_);
      report_under_way_ = false;
    }
    if (!socket_.is_open())
      return;
    if (peer)
      refused(error);
    else
      lost(error);
  }));
}

} // namespace godwit::io::link
