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

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <boost/asio/steady_timer.hpp>

#include "io/http/connection_pool.hpp"
#include "io/http/connector.hpp"
#include "io/http/counters.hpp"
#include "io/http/message.hpp"
#include "io/http/response_reader.hpp"
#include "io/http/secret_text.hpp"
#include "io/http/settings.hpp"

namespace godwit::io::http {

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
