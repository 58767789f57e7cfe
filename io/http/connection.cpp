#include "io/http/connection.hpp"

#include <array>
#include <cerrno>
#include <optional>

#include <boost/asio/post.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/asio/write.hpp>
#include <sys/socket.h>

namespace godwit::io::http {

namespace asio = boost::asio;
using boost::system::error_code;
using tcp = asio::ip::tcp;

struct connection::ends {
  explicit ends(tcp::socket made) : socket(std::move(made)) {}
  tcp::socket socket;
  std::optional<asio::ssl::stream<tcp::socket&>> tls;
};

connection::connection(asio::io_context& io) : connection(tcp::socket(io)) {}
connection::connection(tcp::socket accepted) : ends_(std::make_unique<ends>(std::move(accepted))) {}
connection::~connection() {
  if (place_)
    place_->end_connection = nullptr;
}

void connection::occupy(std::shared_ptr<client_place> place) {
  place_ = std::move(place);
  if (place_)
    place_->end_connection = [this] { close(); };
}

tcp::socket& connection::socket() { return ends_->socket; }

SSL* connection::begin_tls(asio::ssl::context& context) {
  return ends_->tls.emplace(ends_->socket, context).native_handle();
}

void connection::shake_hands(side ours, done then) {
  ends_->tls->async_handshake(ours, [then = std::move(then)](const auto& failed) { then(failed, 0); });
}

void connection::read_some(asio::mutable_buffer to, done then) {
  if (ends_->tls)
    ends_->tls->async_read_some(to, std::move(then));
  else
    ends_->socket.async_read_some(to, std::move(then));
}

void connection::write(std::string_view first, std::string_view second, done then) {
  const std::array<asio::const_buffer, 2> both{asio::buffer(first), asio::buffer(second)};
  if (ends_->tls)
    asio::async_write(*ends_->tls, both, std::move(then));
  else
    asio::async_write(ends_->socket, both, std::move(then));
}

void connection::write_plain(std::string_view first, std::string_view second, done then) {
  const std::array<asio::const_buffer, 2> both{asio::buffer(first), asio::buffer(second)};
  asio::async_write(ends_->socket, both, std::move(then));
}

void connection::shut_down(done then) {
  auto end_tcp = [&socket = ends_->socket, then = std::move(then)](const error_code& failed) {
    error_code ignored; // who has gone already needs no goodbye
    socket.shutdown(tcp::socket::shutdown_send, ignored);
    then(failed, 0);
  };
  if (ends_->tls)
    ends_->tls->async_shutdown(std::move(end_tcp));
  else
    asio::post(ends_->socket.get_executor(), [end_tcp = std::move(end_tcp)] { end_tcp({}); });
}

void connection::read_raw(asio::mutable_buffer to, done then) { ends_->socket.async_read_some(to, std::move(then)); }

void connection::reset() {
  error_code ignored;
  ends_->socket.set_option(asio::socket_base::linger(true, 0), ignored);
  close();
}

void connection::close() {
  error_code ignored; // a socket that can not be closed is closed
  ends_->socket.close(ignored);
}

bool connection::is_quiet() {
  char byte = 0;
  const auto got = ::recv(ends_->socket.native_handle(), &byte, 1, MSG_PEEK | MSG_DONTWAIT);
  return got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK);
}

} // namespace godwit::io::http
