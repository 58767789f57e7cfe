// What a publisher and its broker say to each other over one connection, from CONNECT to its end. Without a socket and
// without a clock: bytes and time come in, bytes and events go out.
//
//   [fresh] ──begin──> [connecting] ──CONNACK──> [open] ──end──> [leaving] ──written──> [over]
//                          │  refused, nothing in 10 s  │ DISCONNECT, refused,  ^
//                          └───────────────────────────>┴── violation, silence ─┘
//
// Messages go out in their order, but for those with an acknowledgement that the broker's Receive Maximum holds back.
// Of the broker's limits, Receive Maximum, Server Keep Alive, Maximum Packet Size and Retain Available are kept to; one
// that acknowledges nothing (Maximum QoS 0), or takes packets of a few bytes only, is refused, because events would be
// lost there. Whoever sends what does not belong here is told so by a DISCONNECT, and the session is over.
//
// Errors: the event `closed`, once and last. Thread: one owner. Times: any clock that only rises.
// Source: MQTT Version 5.0 (OASIS), 3.1.2.11, 3.2.2.3, 4.8, 4.9, 4.12, 4.13.
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "io/mqtt/decoder.hpp"
#include "io/mqtt/failure.hpp"
#include "io/mqtt/message.hpp"

namespace godwit::io::mqtt {

struct session_settings {
  std::string client_id;
  std::string username;            // empty: none
  std::uint16_t keep_alive_s = 15; // the broker publishes the will when it has heard nothing for 1.5 times that
};

struct session_opened {
  std::uint32_t max_packet_bytes = 0; // what a message of ours may have, as publish_bytes() counts
};
// The broker has it; without acknowledgement: it has left.
struct session_published {
  std::uint64_t token = 0;
};
struct session_closed {
  failure why = failure::none;
  std::string sentence;
};
using session_event = std::variant<session_opened, session_published, session_closed>;

class session {
public:
  static constexpr std::int64_t answer_timeout_ms = 10'000; // CONNACK: 300 times there and back over a satellite
  static constexpr std::int64_t ping_timeout_ms = 15'000;   // after the ping has left
  static constexpr std::int64_t write_timeout_ms = 30'000;  // one batch: 8 KiB, so 2.2 kbit/s
  static constexpr std::int64_t puback_timeout_ms = 60'000; // without any acknowledgement while one is due
  static constexpr std::int64_t leaving_timeout_ms = 1'000; // for the last DISCONNECT
  static constexpr std::size_t max_queued = 128;            // messages: fleet_link hands over at most 45
  static constexpr std::size_t batch_bytes = std::size_t{8} * 1024;
  static constexpr std::uint32_t least_max_packet_bytes = 1024; // an event without data has some 200
  static constexpr std::int64_t never_ms = std::numeric_limits<std::int64_t>::max();

  session(session_settings settings, message will) : settings_(std::move(settings)), will_(std::move(will)) {}

  // The transport stands. PASSWORD: null: none.
  void begin(const std::string_view* password, std::int64_t now_ms);
  void on_bytes(std::string_view bytes, std::int64_t now_ms);
  void on_written(std::int64_t now_ms); // the batch that was taken
  void on_time(std::int64_t now_ms);
  // The transport, or what comes before it, has failed.
  void on_failed(failure why, std::string sentence);
  // In the phase [open]; else nothing happens.
  void publish(const message& what, std::uint64_t token, std::int64_t now_ms);
  // The broker publishes the will; no event any more.
  void end(std::int64_t now_ms);

  // What is to be written next; empty: nothing, or the last batch is not written yet. The caller wipes the first one,
  // which may hold a password.
  [[nodiscard]] std::string take_batch(std::int64_t now_ms);
  [[nodiscard]] std::vector<session_event> take_events();
  // Of on_time().
  [[nodiscard]] std::int64_t next_due_ms() const;
  // The transport is needed no more.
  [[nodiscard]] bool is_over() const { return phase_ == phase::over; }
  [[nodiscard]] bool is_open() const { return phase_ == phase::open; }

private:
  enum class phase { fresh, connecting, open, leaving, over };
  struct outgoing {
    enum class kind { other, unacknowledged, ping };
    std::string bytes;
    kind what = kind::other;
    std::uint64_t token = 0; // of what is not acknowledged: published when it is written
  };
  struct waiting_message {
    message what;
    std::uint64_t token = 0;
  };

  void on_packet(const connack& m, std::int64_t now_ms);
  void on_packet(const puback& m, std::int64_t now_ms);
  void on_packet(const pingresp& m, std::int64_t now_ms);
  void on_packet(const disconnect& m, std::int64_t now_ms);
  void keep_limits(const connack& m);
  void enqueue(const message& what, std::uint64_t token, std::int64_t now_ms);
  void send_waiting(std::int64_t now_ms);
  [[nodiscard]] std::uint16_t next_packet_id();
  void close(failure why, std::string sentence);
  // With a DISCONNECT before it.
  void leave(reason_code answer, failure why, const std::string& sentence, std::int64_t now_ms);
  void check_due(std::int64_t now_ms);

  session_settings settings_;
  message will_;
  phase phase_ = phase::fresh;
  packet_reader reader_;
  std::vector<session_event> events_;

  std::deque<outgoing> unwritten_;
  std::vector<std::uint64_t> written_tokens_; // of the batch under way
  bool is_writing_ = false;
  bool is_ping_in_batch_ = false;
  std::deque<waiting_message> waiting_;                // for the Receive Maximum
  std::map<std::uint16_t, std::uint64_t> unconfirmed_; // token by packet id
  std::uint16_t last_packet_id_ = 0;

  std::uint16_t receive_maximum_ = 0;
  bool may_retain_ = true;
  std::uint32_t max_packet_bytes_ = 0;
  std::int64_t keep_alive_ms_ = 0;

  std::int64_t phase_since_ms_ = 0;
  std::int64_t sent_ms_ = 0;        // the last packet
  std::int64_t received_ms_ = 0;    // the same
  std::int64_t batch_ms_ = 0;       // the batch under way was taken
  std::int64_t puback_ms_ = 0;      // the last one, or the beginning of waiting for one
  bool is_ping_due_ = false;        // queued or sent, and not answered
  std::int64_t ping_ms_ = never_ms; // left for the network
};

} // namespace godwit::io::mqtt
