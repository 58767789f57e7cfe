// One request, from its place in the queue to its answer.
//
//   waiting --start--> connecting --> sending --> receiving --> ended
//             `----kept connection-----^   ^  `--dead, and may be repeated--> connecting (once)
//                                          |
//   any of them --time-out, stop, error--> ended
//
// Ends once, whatever happens. A service that answers before it has read everything, and closes, is still heard: when
// sending fails the answer is read all the same.
//
// Thread: the client's.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <boost/asio/steady_timer.hpp>

#include "io/http/connection.hpp"
#include "io/http/connector.hpp"
#include "io/http/counters.hpp"
#include "io/http/message.hpp"
#include "io/http/response_reader.hpp"
#include "io/http/secret_file.hpp"
#include "io/http/settings.hpp"

namespace godwit::io::http {

// Takes a token out of what a service sent: one that echoes the request must not bring it into a log or onto a disk.
//
// Also in the form in which JSON may write it, with a slash escaped. Thread: pure.

// A shorter one would be found in any text.
inline constexpr std::size_t min_redacted_bytes = 6;
inline constexpr std::string_view redacted = "(token)";

void redact(std::string& text, std::string_view token);

// Connections to the service that wait for their next request. The one used last comes first: the others may age out.
//
// Thread: the client's.
class connection_pool {
public:
  connection_pool(std::size_t max_kept, std::chrono::milliseconds keep_for, std::atomic<std::uint64_t>& gauge)
      : max_kept_(max_kept), keep_for_(keep_for), gauge_(gauge) {}

  // Null: none that is young enough and quiet. That it looks alive does not say that it is.
  [[nodiscard]] std::unique_ptr<connection> take(std::chrono::steady_clock::time_point now);
  void put(std::unique_ptr<connection> unused, std::chrono::steady_clock::time_point now);

private:
  std::size_t max_kept_;
  std::chrono::milliseconds keep_for_;
  std::atomic<std::uint64_t>& gauge_;
  std::deque<std::unique_ptr<connection>> idle_; // the oldest in front
};

// What all exchanges of a client share. Outlives them.
struct shared_parts {
  boost::asio::io_context& io;
  settings set;
  destination to;
  std::unique_ptr<boost::asio::ssl::context> tls; // null: plain HTTP
  counter_set counters;
  connection_pool pool{set.max_kept, set.keep_for, counters.kept};
};

class exchange : public std::enable_shared_from_this<exchange> {
public:
  // What went out counts against the read time-out only piece by piece: with 10 s, 1.6 kB/s are enough.
  static constexpr std::size_t send_piece_bytes = 16 * 1024;
  using done = std::function<void(result<response>)>;

  // ENDED: called before THEN, so that THEN finds the place free.
  exchange(shared_parts& parts, request asked, done then, std::function<void()> ended);

  void wait(); // the total time begins
  void start();
  void stop(errc code, std::string why);
  void resume();

private:
  using clock = std::chrono::steady_clock;
  enum class phase { waiting, connecting, sending, receiving, ended };

  void connect();
  void connected(result<std::unique_ptr<connection>> made);
  void use(std::unique_ptr<connection> ready);
  void send_piece();
  void read_piece();
  void received(const boost::system::error_code& failed, std::size_t bytes);
  void stream_ended(const boost::system::error_code& failed);
  void go_on_reading();

  void watch_reading();
  [[nodiscard]] bool repeat();
  [[nodiscard]] std::string place() const;
  [[nodiscard]] std::string where_it_was() const;
  [[nodiscard]] std::chrono::milliseconds read_timeout() const;
  [[nodiscard]] std::chrono::milliseconds total_timeout() const;
  void redact_token(result<response>& end) const;
  void finish(result<response> end);
  void fail(error why);

  shared_parts& parts_;
  request asked_;
  done then_;
  std::function<void()> ended_;
  phase phase_ = phase::waiting;
  boost::asio::steady_timer total_timer_;
  boost::asio::steady_timer phase_timer_; // connecting, then no byte for too long
  clock::time_point last_byte_at_;
  std::shared_ptr<connector> connector_;
  std::unique_ptr<connection> connection_;
  secret_text token_;
  secret_text head_; // it holds the token, too
  std::size_t body_sent_ = 0;
  std::optional<response_reader> reader_;
  std::vector<std::byte> piece_;
  bool is_sent_ = false; // the whole request
  bool is_reused_ = false;
  bool is_paused_ = false;
};

} // namespace godwit::io::http
