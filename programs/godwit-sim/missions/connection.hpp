// One connection of a client: reads a request, has it answered, sends the answer as it is to be sent, reads the next.
//
//   start -> (TLS) -> reading -> asked -> deliver -> reading ...
//                        '-> refused: answered, and closed      '-> closed, or reset by a fault
//
// While a long poll waits the connection only looks whether the client is still there. Whoever is silent, or takes
// nothing, for longer than its time-out is closed.
//
// Thread: that of the context.
#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>

#include <boost/asio/steady_timer.hpp>

#include "programs/godwit-sim/missions/delivery.hpp"
#include "programs/godwit-sim/missions/outgoing.hpp"
#include "programs/godwit-sim/missions/request_reader.hpp"
#include "programs/godwit-sim/missions/server_wire.hpp"

namespace godwit::sim::missions {

class connection : public std::enable_shared_from_this<connection> {
public:
  static constexpr std::chrono::seconds handshake_timeout{10};
  static constexpr std::chrono::seconds idle_timeout{75};    // between two requests; clients keep theirs for less
  static constexpr std::chrono::seconds silence_timeout{30}; // in the middle of a request, or without taking a piece
  static constexpr std::chrono::seconds goodbye_timeout{1};
  static constexpr std::size_t read_bytes = 64 * 1024;
  static constexpr std::size_t piece_bytes = 1024 * 1024; // of an answer that goes as fast as it can

  struct callbacks {
    // A request is there: somebody calls deliver, now or later.
    std::function<void(connection& who, request asked)> asked;
    std::function<void(connection& who)> ended; // once
  };

  connection(boost::asio::ip::tcp::socket accepted, callbacks around);

  // TLS: none for plain HTTP; must outlive the connection.
  void start(boost::asio::ssl::context* tls);
  void deliver(const delivery& what);
  // Until it is delivered: whether the client goes away is looked at.
  void hold();
  void end();

private:
  void read();
  void have_read(const boost::system::error_code& failed, std::size_t bytes);
  void go_on(progress how_far);
  void send_continue();
  void begin_sending();
  void send();
  void have_sent();
  void send_more_later();
  void say_goodbye();
  void drain();
  void watch(std::chrono::steady_clock::duration time);
  void stop_watching();

  server_wire wire_;
  callbacks around_;
  boost::asio::steady_timer watchdog_;
  std::uint64_t watch_ = 0;        // number of what is watched: an older one that comes late is nobody's business
  boost::asio::steady_timer pace_; // of delays and slow answers
  request_reader reader_;
  std::array<std::byte, read_bytes> bytes_{};
  std::optional<delivery> delivery_;
  std::optional<outgoing> sending_;
  bool is_last_ = false; // the answer that is being sent
  bool has_ended_ = false;
};

} // namespace godwit::sim::missions
