// One WebSocket, after a request for it: texts to the client, one at a time, and what the client says.
//
//   if (!is_websocket_request(asked)) ...                             426, or another answer
//   auto line = std::make_shared<websocket>(io, settings, hooks);
//   answer.upgrade([&](auto taken, auto early) { line->accept(asked, std::move(taken), std::move(early)); });
//   line->write(text, [] { the next one });
//
//   accepting ──handshake──> open ──close(), the client closes, a time-out, a failure──> ended: on_end, once
//
// Nothing waits for a client: one that takes no text for write_timeout, or answers no ping within idle_timeout, is
// closed. It keeps itself while something is under way; whoever holds it may let go of it at any time after end().
// Errors: as the reason of on_end. Thread: that of the context, for all.
// Source: RFC 6455, by Boost.Beast; without extensions, because compression costs memory for each client.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include <boost/asio/io_context.hpp>

#include "io/http/connection.hpp"
#include "io/http/server/response_head.hpp"

namespace godwit::io::http {

struct websocket_settings {
  std::size_t max_message_bytes = 4096;       // of what the client says; a longer one ends it
  std::size_t send_buffer_bytes = 128 * 1024; // of the system; what it holds is on its way, and can not be dropped
  std::chrono::seconds handshake_timeout{10};
  std::chrono::seconds idle_timeout{
      30}; // nothing is heard, not even the answer to a ping, which goes out at half of it
  std::chrono::seconds write_timeout{20};
  std::chrono::seconds close_timeout{2}; // for the client to say that it closes, too
};

enum class close_code : std::uint16_t {
  normal = 1000,
  going_away = 1001, // the server ends
  policy = 1008,     // it has said something that it may not, or is too slow
  try_again_later = 1013
};

struct websocket_hooks {
  std::function<void()> on_open = {};
  std::function<void(std::string_view text)> on_text = {}; // none: who says something is closed
  std::function<void(const std::string& why)> on_end = {}; // once, also when it was never open
};

[[nodiscard]] bool is_websocket_request(const server_request& asked);

class websocket : public std::enable_shared_from_this<websocket> {
public:
  using done = std::function<void()>;

  websocket(boost::asio::io_context& io, const websocket_settings& set, websocket_hooks hooks);
  ~websocket();
  websocket(const websocket&) = delete;
  websocket& operator=(const websocket&) = delete;

  // EARLY: what the client has sent before it was answered, which it may not.
  void accept(const server_request& asked, std::unique_ptr<connection> taken, const std::string& early);
  // One at a time: not before THEN of the one before. TEXT stays as it is.
  void write(std::shared_ptr<const std::string> text, done then);
  // Says why and waits for the client to say so, too; what is being written still goes out.
  void close(close_code code, std::string why);
  void end(const std::string& why); // at once
  [[nodiscard]] bool is_open() const;

private:
  struct engine;

  void read();
  void have_read(const std::string& failed);
  void watch(std::chrono::seconds time, const char* why);
  void begin_close();

  std::unique_ptr<engine> engine_;
};

} // namespace godwit::io::http
