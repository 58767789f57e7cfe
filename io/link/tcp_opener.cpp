#include "io/link/tcp_opener.hpp"

#include <cerrno>
#include <vector>

#include <boost/asio/connect.hpp>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include "io/link/reasons.hpp"

namespace godwit::io::link {

tcp_opener::tcp_opener(boost::asio::io_context& io, const uri& where, std::chrono::milliseconds connect_timeout)
    : where_(where), place_(host_and_port(where.host, where.port)), connect_timeout_(connect_timeout), lookup_(io),
      socket_(std::make_shared<tcp::socket>(io)), timer_(io) {}

// What is under way holds the socket, and would go on without us.
tcp_opener::~tcp_opener() {
  boost::system::error_code ignored;
  socket_->close(ignored);
}

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
  // The operation looks at its socket also after it was given up, so it holds it.
  boost::asio::async_connect(*socket_, endpoints,
                             alive_.guard([this, held = socket_](const boost::system::error_code& failure,
                                                                 const tcp::endpoint&) { connected(failure); }));
  timer_.expires_after(connect_timeout_);
  timer_.async_wait(alive_.guard([this, this_try = tries_](const boost::system::error_code& cancelled) {
    if (cancelled || this_try != tries_)
      return;
    timed_out_ = true;
    boost::system::error_code ignored;
    socket_->close(ignored);
  }));
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
    error = set_up_tcp(*socket_);
  boost::system::error_code ignored;
  if (error) {
    socket_->close(ignored);
    return done_(tl::make_unexpected(remote_reason(place_, error.value())));
  }
  descriptor stream(socket_->release(error));
  if (error)
    return done_(tl::make_unexpected(remote_reason(place_, error.value())));
  done_(std::move(stream));
}

// Who tries a free local port often enough gets it as his own port, and TCP connects him to himself.
bool tcp_opener::is_connected_to_itself() const {
  boost::system::error_code ignored;
  return socket_->local_endpoint(ignored) == socket_->remote_endpoint(ignored);
}

std::string tcp_opener::why_it_ended(int error) const { return remote_reason(place_, error == 0 ? EPIPE : error); }

boost::system::error_code set_up_tcp(boost::asio::ip::tcp::socket& socket) {
  using unacknowledged_for = boost::asio::detail::socket_option::integer<IPPROTO_TCP, TCP_USER_TIMEOUT>;
  using first_probe_after = boost::asio::detail::socket_option::integer<IPPROTO_TCP, TCP_KEEPIDLE>;
  using next_probe_after = boost::asio::detail::socket_option::integer<IPPROTO_TCP, TCP_KEEPINTVL>;
  using std::chrono::milliseconds;
  boost::system::error_code error;
  socket.non_blocking(true, error);
  if (!error)
    socket.set_option(boost::asio::ip::tcp::no_delay(true), error);
  if (!error)
    socket.set_option(unacknowledged_for(static_cast<int>(milliseconds(tcp_peer_vanished_after).count())), error);
  // Probes find a peer that vanished while we had nothing to send; how many is for TCP_USER_TIMEOUT to say.
  if (!error)
    socket.set_option(boost::asio::socket_base::keep_alive(true), error);
  if (!error)
    socket.set_option(first_probe_after(1), error);
  if (!error)
    socket.set_option(next_probe_after(1), error);
  return error;
}

ssize_t write_tcp(int stream, std::span<const std::byte> bytes) {
  return ::send(stream, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
}

} // namespace godwit::io::link
