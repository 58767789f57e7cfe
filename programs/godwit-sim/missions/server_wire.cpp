#include "programs/godwit-sim/missions/server_wire.hpp"

#include <cerrno>

#include <boost/asio/write.hpp>
#include <sys/socket.h>

namespace godwit::sim::missions {

namespace asio = boost::asio;
using boost::system::error_code;
using tcp = asio::ip::tcp;

void server_wire::shake_hands(asio::ssl::context& context, done then) {
  tls_.emplace(socket_, context);
  tls_->async_handshake(asio::ssl::stream_base::server,
                        [then = std::move(then)](const auto& failed) { then(failed, 0); });
}

void server_wire::read_some(asio::mutable_buffer to, done then) {
  if (tls_)
    tls_->async_read_some(to, std::move(then));
  else
    socket_.async_read_some(to, std::move(then));
}

void server_wire::write(std::string_view bytes, done then) {
  if (tls_)
    asio::async_write(*tls_, asio::buffer(bytes), std::move(then));
  else
    asio::async_write(socket_, asio::buffer(bytes), std::move(then));
}

void server_wire::say_goodbye(done then) {
  const auto end_tcp = [this, then = std::move(then)](const error_code& failed) {
    error_code ignored; // who has gone already needs no goodbye
    socket_.shutdown(tcp::socket::shutdown_send, ignored);
    then(failed, 0);
  };
  if (tls_)
    tls_->async_shutdown(end_tcp);
  else
    asio::post(socket_.get_executor(), [end_tcp] { end_tcp({}); });
}

void server_wire::read_raw(asio::mutable_buffer to, done then) { socket_.async_read_some(to, std::move(then)); }

void server_wire::wait_readable(done then) {
  socket_.async_wait(tcp::socket::wait_read, [then = std::move(then)](const auto& failed) { then(failed, 0); });
}

bool server_wire::is_gone() {
  char byte = 0;
  const auto got = ::recv(socket_.native_handle(), &byte, 1, MSG_PEEK | MSG_DONTWAIT);
  return got == 0 || (got < 0 && errno != EAGAIN && errno != EWOULDBLOCK);
}

void server_wire::close() {
  error_code ignored; // a socket that can not be closed is closed
  socket_.close(ignored);
}

void server_wire::reset() {
  error_code ignored;
  socket_.set_option(asio::socket_base::linger(true, 0), ignored);
  socket_.close(ignored);
}

} // namespace godwit::sim::missions
