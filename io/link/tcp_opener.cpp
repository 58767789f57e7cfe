#include "io/link/tcp_opener.hpp"

#include <cerrno>
#include <vector>

#include <boost/asio/connect.hpp>
#include <netinet/tcp.h>

#include "io/link/reasons.hpp"

namespace godwit::io::link {

tcp_opener::tcp_opener(boost::asio::io_context& io, const uri& where, std::chrono::milliseconds connect_timeout)
    : where_(where), place_(host_and_port(where.host, where.port)), connect_timeout_(connect_timeout), lookup_(io),
      socket_(io), timer_(io) {}

void tcp_opener::open(std::function<void(result)> done) {
  done_ = std::move(done);
  lookup_.start(where_.host, [this](const found_addresses& found) {
    if (!found)
      return done_(tl::make_unexpected(found.error()));
    connect(*found);
  });
}

void tcp_opener::connect(const std::vector<boost::asio::ip::address>& addresses) {
  std::vector<tcp::endpoint> endpoints;
  for (const auto& each : addresses)
    endpoints.emplace_back(each, where_.port);
  timed_out_ = false;
  ++tries_;
  boost::asio::async_connect(
      socket_, endpoints,
      [this](const boost::system::error_code& failure, const tcp::endpoint&) { connected(failure); });
  timer_.expires_after(connect_timeout_);
  timer_.async_wait([this, this_try = tries_](const boost::system::error_code& cancelled) {
    if (cancelled || this_try != tries_)
      return;
    timed_out_ = true;
    boost::system::error_code ignored;
    socket_.close(ignored);
  });
}

void tcp_opener::connected(const boost::system::error_code& failure) {
  ++tries_; // the timer of this try means nothing any more, even where it was over just now
  timer_.cancel();
  boost::system::error_code error = failure;
  if (timed_out_)
    error = boost::asio::error::timed_out;
  if (!error && is_connected_to_itself())
    error = boost::asio::error::connection_refused;
  if (!error)
    error = set_up();
  boost::system::error_code ignored;
  if (error) {
    socket_.close(ignored);
    return done_(tl::make_unexpected(remote_reason(place_, error.value())));
  }
  descriptor stream(socket_.release(error));
  if (error)
    return done_(tl::make_unexpected(remote_reason(place_, error.value())));
  done_(std::move(stream));
}

// Who tries a free local port often enough gets it as his own port, and TCP connects him to himself.
bool tcp_opener::is_connected_to_itself() const {
  boost::system::error_code ignored;
  return socket_.local_endpoint(ignored) == socket_.remote_endpoint(ignored);
}

boost::system::error_code tcp_opener::set_up() {
  using unacknowledged_for = boost::asio::detail::socket_option::integer<IPPROTO_TCP, TCP_USER_TIMEOUT>;
  using first_probe_after = boost::asio::detail::socket_option::integer<IPPROTO_TCP, TCP_KEEPIDLE>;
  using next_probe_after = boost::asio::detail::socket_option::integer<IPPROTO_TCP, TCP_KEEPINTVL>;
  using std::chrono::milliseconds;
  boost::system::error_code error;
  socket_.non_blocking(true, error);
  if (!error)
    socket_.set_option(tcp::no_delay(true), error);
  if (!error)
    socket_.set_option(unacknowledged_for(static_cast<int>(milliseconds(vanished_after).count())), error);
  // Probes find a peer that vanished while we had nothing to send; how many is for TCP_USER_TIMEOUT to say.
  if (!error)
    socket_.set_option(boost::asio::socket_base::keep_alive(true), error);
  if (!error)
    socket_.set_option(first_probe_after(1), error);
  if (!error)
    socket_.set_option(next_probe_after(1), error);
  return error;
}

ssize_t tcp_opener::write(int stream, std::span<const std::byte> bytes) const {
  return ::send(stream, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
}

std::string tcp_opener::why_it_ended(int error) const { return remote_reason(place_, error == 0 ? EPIPE : error); }

} // namespace godwit::io::link
