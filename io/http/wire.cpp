#include "io/http/wire.hpp"

#include <array>
#include <cerrno>
#include <optional>

#include <boost/asio/ssl/stream.hpp>
#include <boost/asio/write.hpp>
#include <sys/socket.h>

namespace godwit::io::http {

namespace asio = boost::asio;
using tcp = asio::ip::tcp;

struct wire::ends {
  explicit ends(asio::io_context& io) : socket(io) {}
  tcp::socket socket;
  std::optional<asio::ssl::stream<tcp::socket&>> tls;
};

wire::wire(asio::io_context& io) : ends_(std::make_unique<ends>(io)) {}
wire::~wire() = default;

tcp::socket& wire::socket() { return ends_->socket; }

SSL* wire::begin_tls(asio::ssl::context& context) { return ends_->tls.emplace(ends_->socket, context).native_handle(); }

void wire::shake_hands(done then) {
  ends_->tls->async_handshake(asio::ssl::stream_base::client,
                              [then = std::move(then)](const auto& failed) { then(failed, 0); });
}

void wire::read_some(asio::mutable_buffer to, done then) {
  if (ends_->tls)
    ends_->tls->async_read_some(to, std::move(then));
  else
    ends_->socket.async_read_some(to, std::move(then));
}

void wire::write(std::string_view first, std::string_view second, done then) {
  const std::array<asio::const_buffer, 2> both{asio::buffer(first), asio::buffer(second)};
  if (ends_->tls)
    asio::async_write(*ends_->tls, both, std::move(then));
  else
    asio::async_write(ends_->socket, both, std::move(then));
}

void wire::close() {
  boost::system::error_code ignored; // a socket that can not be closed is closed
  ends_->socket.close(ignored);
}

bool wire::is_quiet() {
  char byte = 0;
  const auto got = ::recv(ends_->socket.native_handle(), &byte, 1, MSG_PEEK | MSG_DONTWAIT);
  return got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK);
}

} // namespace godwit::io::http
