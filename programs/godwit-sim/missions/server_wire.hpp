// The server's end of one connection, with TLS or without.
//
// Handlers are called in the thread of the context, never before the call returns. A wire must outlive what it was
// asked for: whoever asks keeps it in the handler. Closing ends what is under way with operation_aborted. Thread: that
// of the context.
#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/ssl/stream.hpp>

namespace godwit::sim::missions {

class server_wire {
public:
  using done = std::function<void(const boost::system::error_code& failed, std::size_t bytes)>;

  explicit server_wire(boost::asio::ip::tcp::socket accepted) : socket_(std::move(accepted)) {}
  server_wire(const server_wire&) = delete;
  server_wire& operator=(const server_wire&) = delete;
  ~server_wire() = default;

  // From here on all goes through TLS. CONTEXT must outlive the wire.
  void shake_hands(boost::asio::ssl::context& context, done then);
  void read_some(boost::asio::mutable_buffer to, done then);
  void write(std::string_view bytes, done then); // all of them
  // Says what TLS says at the end, and that nothing more comes.
  void say_goodbye(done then);
  // Bytes as they are on the way, which nobody will understand: for who only waits for the end.
  void read_raw(boost::asio::mutable_buffer to, done then);
  // The other side has said something, or has gone.
  void wait_readable(done then);
  [[nodiscard]] bool is_gone();
  [[nodiscard]] boost::asio::any_io_executor executor() { return socket_.get_executor(); }

  void close();
  void reset(); // a TCP reset

private:
  boost::asio::ip::tcp::socket socket_;
  std::optional<boost::asio::ssl::stream<boost::asio::ip::tcp::socket&>> tls_;
};

} // namespace godwit::sim::missions
