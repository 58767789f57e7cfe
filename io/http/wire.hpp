// One connection, with TLS or without.
//
// Handlers are called in the thread of the context, never before the call returns. A wire must outlive what it was
// asked for: whoever asks keeps it in the handler. Closing ends what is under way with operation_aborted.
// Thread: that of the context.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string_view>

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>

namespace godwit::io::http {

class wire {
public:
  using done = std::function<void(const boost::system::error_code& failed, std::size_t bytes)>;

  explicit wire(boost::asio::io_context& io);
  ~wire();
  wire(const wire&) = delete;
  wire& operator=(const wire&) = delete;

  [[nodiscard]] boost::asio::ip::tcp::socket& socket();
  // From here on reading and writing go through TLS. The handle: for rules and verdicts.
  SSL* begin_tls(boost::asio::ssl::context& context);
  void shake_hands(done then);

  void read_some(boost::asio::mutable_buffer to, done then);
  void write(std::string_view first, std::string_view second, done then); // all of both
  void close();

  // True when the other side has neither closed nor said anything that was not asked for.
  [[nodiscard]] bool is_quiet();
  std::chrono::steady_clock::time_point idle_since;

private:
  struct ends;
  std::unique_ptr<ends> ends_;
};

} // namespace godwit::io::http
