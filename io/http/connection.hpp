// One connection, with TLS or without: of the client to its service, or of the server to one of its clients.
//
// Handlers are called in the thread of the context, never before the call returns. A connection must outlive what it
// was asked for: whoever asks keeps it in the handler. Closing ends what is under way with operation_aborted. One may
// read and write at the same time, but not read twice. Thread: that of the context.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/ssl/stream_base.hpp>

namespace godwit::io::http {

// The place of a connection among those that a server has at a time, made by whoever counts them
// (server_hooks::admit). It stays with the connection, also when that becomes a WebSocket, and is given back with it.
//
// Thread: end_connection and is_websocket in that of the context; prove by any; destroyed in any.
class client_place {
public:
  client_place() = default;
  client_place(const client_place&) = delete;
  client_place& operator=(const client_place&) = delete;
  virtual ~client_place() = default;

  // A request that came by it has a session.
  virtual void prove(const std::string& session) { static_cast<void>(session); }

  std::function<void()> end_connection = {}; // set by the connection, for as long as there is one
  bool is_websocket = false;                 // set by the connection when it becomes one
};

class connection {
public:
  using done = std::function<void(const boost::system::error_code& failed, std::size_t bytes)>;
  using side = boost::asio::ssl::stream_base::handshake_type; // client or server

  explicit connection(boost::asio::io_context& io);
  explicit connection(boost::asio::ip::tcp::socket accepted);
  ~connection();
  connection(const connection&) = delete;
  connection& operator=(const connection&) = delete;

  [[nodiscard]] boost::asio::ip::tcp::socket& socket();
  // From here on reading and writing go through TLS. The handle: for rules and verdicts.
  SSL* begin_tls(boost::asio::ssl::context& context);
  void shake_hands(side ours, done then);

  void read_some(boost::asio::mutable_buffer to, done then);
  void write(std::string_view first, std::string_view second, done then); // all of both
  // The same past TLS, whose handshake has failed.
  void write_plain(std::string_view first, std::string_view second, done then);
  // Says what TLS says at the end, and that nothing more comes; what comes in can still be read with read_raw.
  void shut_down(done then);
  // Bytes as they are on their way, which nobody will understand: for who only waits for the end.
  void read_raw(boost::asio::mutable_buffer to, done then);
  void close();
  void reset(); // a TCP reset: the other side is to know that something is missing

  // True when the other side has neither closed nor said anything that was not asked for.
  [[nodiscard]] bool is_quiet();
  std::chrono::steady_clock::time_point idle_since;
  // By which a server counts it; given back with it, whoever has it then.
  void occupy(std::shared_ptr<client_place> place);
  [[nodiscard]] std::weak_ptr<client_place> place() const { return place_; }
  // Kept for as long as it is spoken.
  void keep(std::shared_ptr<boost::asio::ssl::context> tls) { tls_ = std::move(tls); }

private:
  struct ends;
  std::shared_ptr<client_place> place_;
  std::shared_ptr<boost::asio::ssl::context> tls_; // goes after what speaks it
  std::unique_ptr<ends> ends_;
};

} // namespace godwit::io::http
