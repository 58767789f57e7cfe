// Every decision about the broker.
//
//             open_broker              broker_opened
//   [waiting] ───────────> [opening] ────────────────> [connected]
//       ^                     │ closed, or no word          │ closed
//       │                     v in open_patience            │
//       └──── a pause with jitter, up to 1 min <────────────┘
//
// Connected, events go out in the order of their numbers, a window of them at a time, as soon as they are on the disk;
// they are kept until the broker has them, and go again with the next connection, with the same id. What is live goes
// out beside them, and so is never behind more than one window. The state is put in with each call; what comes back is
// executed by the actor. Pure: time and seed come in. Thread: one owner.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "actors/fleet_link/broker_port.hpp"
#include "actors/fleet_link/live_texts.hpp"
#include "actors/fleet_link/settings.hpp"
#include "actors/fleet_link/state.hpp"
#include "io/time_units.hpp"
#include "messages/fleet_link/types.hpp"
#include "runtime/condition.hpp"

namespace godwit::fleet_link {

struct open_broker {
  std::uint64_t attempt = 0;
  publication will;
};
struct close_broker {
  std::uint64_t upto = 0;
};
struct publish {
  std::uint64_t attempt = 0;
  publication what;
};
struct announce {
  std::string sentence;
  bool is_warning = false;
};
using effect = std::variant<open_broker, close_broker, publish, announce>;
using effects = std::vector<effect>;

class core {
public:
  static constexpr std::int64_t beat_ns = 250'000'000; // live texts are looked at so often
  static constexpr std::int64_t open_patience_ns = 30'000'000'000;
  static constexpr std::int64_t shortest_pause_ns = 1'000'000'000;
  static constexpr std::int64_t longest_pause_ns = 60'000'000'000;
  static constexpr std::int64_t steady_after_ns = 10'000'000'000; // a connection that held so long was a good one
  // Events that the broker has been handed and has not acknowledged: what is live waits after no more than that.
  static constexpr std::size_t max_window = 20;
  static constexpr std::size_t max_window_bytes = std::size_t{32} * 1024;
  static constexpr std::size_t max_unsent_texts = 24; // live ones that have not left: one of each topic, twice
  static constexpr std::size_t events_a_write = 10;   // taken ones, before that is written

  // SESSION: another one for each process. Numbers of connections begin after FIRST_ATTEMPT.
  core(settings configured, std::uint64_t seed, std::string session, std::uint64_t first_attempt);

  [[nodiscard]] effects on_opened(const broker_opened& m, const state& s, instant now);
  [[nodiscard]] effects on_closed(const broker_closed& m, instant now);
  void on_taken(const event_taken& m);
  void on_left(const text_left& m);
  void on_text(text_ptr text) { live_.take(std::move(text)); }
  void on_written(std::uint64_t upto) { written_upto_ = upto; }

  // What is due now.
  [[nodiscard]] effects turn(const state& s, instant now);
  // What the broker has taken, when it is time to write that.
  [[nodiscard]] std::optional<delivered> newly_delivered(const state& s) const;
  [[nodiscard]] std::int64_t next_due_ns() const;

  [[nodiscard]] bool is_connected() const { return phase_ == phase::connected; }
  [[nodiscard]] std::uint64_t attempt() const { return attempt_; }
  [[nodiscard]] runtime::condition health(const state& s) const;
  [[nodiscard]] fleet_view view_of(const state& s, instant now) const;

private:
  enum class phase { waiting, opening, connected };

  // Uniform in [0, 1), another one for each failure.
  [[nodiscard]] double jitter() const;
  [[nodiscard]] open_broker next_attempt(instant now);
  void fail(effects& out, broker_failure why, const std::string& sentence, instant now);
  void send_events(effects& out, const state& s);
  void send_live(effects& out, std::int64_t now_ns);
  [[nodiscard]] publication status_text(const char* how, instant now) const;
  // Without its data where the broker takes no packet of that size.
  [[nodiscard]] publication event_text(const state& s, const queued_event& what);
  [[nodiscard]] bool is_too_large(const publication& what) const;
  [[nodiscard]] std::string topic(std::string_view rest) const;
  // Up to which the broker has taken all.
  [[nodiscard]] std::uint64_t taken_upto(const state& s) const;

  settings settings_;
  std::string session_;
  std::uint64_t seed_;
  phase phase_ = phase::waiting;
  std::uint64_t attempt_;
  std::int64_t due_ns_ = 0;   // waiting: of the next try; opening: of giving it up
  std::int64_t since_ns_ = 0; // connected since
  std::uint64_t failures_in_a_row_ = 0;
  std::string sentence_; // of the last failure; empty: connected, or not tried yet
  std::string said_;     // of it, to people

  std::uint64_t written_upto_ = 0;   // on our disk
  std::uint64_t sent_upto_ = 0;      // handed to this connection
  std::set<std::uint64_t> taken_;    // of these: by the broker, and still in the state
  std::size_t max_packet_bytes_ = 0; // of this connection: what the broker takes
  std::size_t unsent_texts_ = 0;
  live_texts live_;

  std::uint64_t connects_ = 0;
  std::uint64_t failures_ = 0;
  std::uint64_t texts_ = 0;
  std::uint64_t too_large_ = 0;
};

} // namespace godwit::fleet_link
