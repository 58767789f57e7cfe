#include "tests/io/http/server/websocket_client.hpp"

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket/stream.hpp>

namespace godwit::io::http::test {

namespace asio = boost::asio;
namespace ws = boost::beast::websocket;
using tcp = asio::ip::tcp;

struct websocket_client::engine {
  asio::io_context io;
  ws::stream<tcp::socket, false> line{io};
  unsigned status = 0;
};

websocket_client::websocket_client(std::uint16_t port, const std::string& target, const std::string& origin)
    : engine_(std::make_unique<engine>()) {
  auto& e = *engine_;
  auto& socket = e.line.next_layer();
  boost::system::error_code failed;
  socket.open(tcp::v4());
  socket.set_option(asio::socket_base::receive_buffer_size(16 * 1024)); // so that one that reads nothing is soon full
  socket.connect({asio::ip::address_v4::loopback(), port}, failed);
  if (failed)
    return;
  if (!origin.empty())
    e.line.set_option(ws::stream_base::decorator(
        [origin](ws::request_type& asked) { asked.set(boost::beast::http::field::origin, origin); }));
  ws::response_type answer;
  e.line.handshake(answer, "localhost:" + std::to_string(port), target, failed);
  if (!failed || failed == ws::error::upgrade_declined)
    e.status = answer.result_int();
}

websocket_client::~websocket_client() = default;

unsigned websocket_client::status() const { return engine_->status; }

std::string websocket_client::read() {
  boost::beast::flat_buffer buffer;
  boost::system::error_code failed;
  engine_->line.read(buffer, failed);
  return failed ? std::string() : std::string(static_cast<const char*>(buffer.data().data()), buffer.size());
}

void websocket_client::write(const std::string& text, bool is_text) {
  boost::system::error_code gone;
  engine_->line.text(is_text);
  engine_->line.write(asio::buffer(text), gone);
}

void websocket_client::write_raw(const std::string& bytes) {
  boost::system::error_code gone;
  asio::write(engine_->line.next_layer(), asio::buffer(bytes), gone);
}

unsigned websocket_client::close_code() const { return engine_->line.reason().code; }

std::string websocket_client::close_reason() const {
  const auto& why = engine_->line.reason().reason;
  return {why.data(), why.size()};
}

} // namespace godwit::io::http::test
