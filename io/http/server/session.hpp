// One connection of a client: reads a request, has it answered, writes the answer, reads the next one.
//
//   start --[TLS]--> reading --request--> handling <--piece by piece--> writing --> reading ...
//                      |  ^                  '--gone, aborted--> ended      |
//                      |  '--------------- the next request ----------------+--last--> closing --> ended
//                      '--refused: answered as the last, above              '--not taken in time--> ended
//
// Requests that come together are answered one after the other, in their order. While an answer is awaited the
// connection is read one piece ahead, to see whether the client is still there; one that closes its sending side counts
// as gone.
//
// Closing at once would throw away an answer when the client is still sending: so at the end the server says that it is
// done, and drops whatever comes until the client closes too, or close_timeout is over.
//
// Thread: that of the context. Source: RFC 9112, 9 (connections, pipelining, closing).
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <boost/asio/steady_timer.hpp>

#include "io/http/server/request_reader.hpp"
#include "io/http/server/responder.hpp"
#include "io/http/server/settings.hpp"

namespace godwit::io::http {

// What all sessions of a server share.
struct session_parts {
  boost::asio::io_context& io;
  server_settings set;
  std::function<void(server_request asked, responder answer)> handle;
  body_limit limit;
  server_counters counters;
  std::function<void(session& who)> ended; // once for each; empty: the server is gone
};

class session : public std::enable_shared_from_this<session> {
public:
  static constexpr std::size_t piece_bytes = 16 * 1024; // of an answer; what is written at a time

  session(std::shared_ptr<session_parts> parts, boost::asio::ip::tcp::socket accepted,
          std::shared_ptr<client_place> place);

  void start(std::shared_ptr<boost::asio::ssl::context> tls); // null: plain HTTP
  void close(); // when the answer that is under way has gone out; at once without one
  void end();   // at once

  // -- for its responder
  [[nodiscard]] bool awaits(std::uint64_t request_number) const;
  void respond(const server_response& whole);
  void begin_answer(const server_response& what, std::optional<std::uint64_t> body_bytes, responder::next then);
  void write(std::string bytes, responder::next then);
  void finish();
  void abort();
  void on_gone(responder::next then) { on_gone_ = std::move(then); }
  void upgrade(const responder::taker& then);
  void keep_unread() { keeps_unread_ = true; }

private:
  using clock = std::chrono::steady_clock;
  using error_code = boost::system::error_code;
  enum class phase { handshaking, reading, handling, writing, closing, ended };

  void read();
  void start_reading();
  void have_read(const error_code& failed, std::size_t bytes);
  void go_on(progress how_far);
  [[nodiscard]] std::string head_of(const server_response& what, std::optional<std::uint64_t> body_bytes) const;
  void send_continue();
  void handle();
  void refuse();
  void look_for_end();
  void send(std::string head, std::string body, responder::next then);
  void send_piece();
  void have_sent();
  void answered();
  void send_goodbye();
  void drain();
  void lost();
  void note_addresses();
  void refuse_plain();

  void watch(clock::time_point until, std::uint64_t server_counters::*counted);
  void watch_reading();
  void stop_watching();

  std::shared_ptr<session_parts> parts_;
  std::unique_ptr<connection> connection_; // null: somebody else has it
  std::string from_;
  std::string to_;
  phase phase_ = phase::handshaking;
  boost::asio::steady_timer watchdog_;
  std::uint64_t watch_ = 0; // number of what is watched: an older one that comes late is nobody's business
  request_reader reader_;
  std::array<std::byte, request_reader::read_bytes> bytes_{};
  bool is_reading_ = false;
  bool keeps_unread_ = false;                 // until the answer
  std::size_t early_bytes_ = 0;               // in bytes_, read while an answer was awaited
  std::optional<clock::time_point> begun_at_; // the request that is being read
  std::uint64_t request_number_ = 0;
  bool is_head_only_ = false;         // of HEAD, 204 and the like: no body goes out
  bool is_last_ = false;              // the answer
  std::optional<std::uint64_t> owed_; // bytes of the body that were promised and not given yet
  std::string head_;
  std::string body_; // what is being written, after the head
  std::size_t sent_ = 0;
  responder::next then_;
  responder::next on_gone_;
};

} // namespace godwit::io::http
