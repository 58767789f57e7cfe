// Which vehicle is on the link, whether it lives, and whether its autopilot has started again.
//
//   down ──transport up──> silent ──heartbeat──> connected ──lost_after_ms without one──> lost
//    ^                        ^                      ^                                     │
//    └──────transport gone────┴──────────────────────┴──────────heartbeat──────────────────┘
//
// The first autopilot heard is the vehicle, or the one with the configured system id. It is bound by system, component
// and the peer that it was heard from: while that one is heard, frames under its name from elsewhere are not the
// vehicle's, and are counted. After a silence it may come from another peer. An autopilot that fell silent before it
// was heard kept_after times is let go; from then on it stays the vehicle until the process ends, so that a second
// vehicle on the same radio is never commanded by mistake. While a flight is open its vehicle is kept over a restart of
// the process as well (keep): it is waited for, and another one is named and not taken.
// Where anybody can speak, an autopilot is believed at its heartbeats_to_begin-th heartbeat within 5 s, and so is a new
// peer of it: a few forged frames begin nothing. Pure: time comes in as monotonic nanoseconds.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "actors/domain/confirmation/confirmation_table.hpp"
#include "io/link/status.hpp"
#include "io/mavlink/messages/heartbeat.hpp"
#include "messages/vehicle_link/connection.hpp"

namespace godwit::vehicle_link {

struct watch_settings {
  std::uint8_t system = 0;            // of the vehicle; 0: the first autopilot heard
  std::uint8_t component = 1;         // of its autopilot
  std::int64_t lost_after_ms = 5'000; // five heartbeats of an autopilot, which sends one a second
  int heartbeats_to_begin = 1;        // of an autopilot, or of a new peer of it
};

// UDP may deliver a frame late, and streams are stamped at different moments: going back less is no restart.
inline constexpr std::uint32_t boot_time_tolerance_ms = 1'000;
inline constexpr int frames_of_new_clock = 3;
inline constexpr std::int64_t new_clock_ns = 1'000'000'000; // from the first of them to the last, at least
inline constexpr std::int64_t late_within_ns = 1'500'000'000;

// Heartbeats after which a vehicle is not let go any more.
inline constexpr std::uint64_t kept_after = 10;

// Another autopilot is on the line while its heartbeats, one a second, come: a few may be lost.
inline constexpr std::int64_t others_count_ns = 10'000'000'000;

struct known_vehicle {
  std::uint8_t system = 0;
  std::uint8_t component = 0;
  io::link::peer_id peer = io::link::every_peer; // every_peer: its next heartbeats say
  std::uint8_t autopilot = 0;                    // MAV_AUTOPILOT
  std::uint8_t type = 0;                         // MAV_TYPE
};

class vehicle_watch {
public:
  explicit vehicle_watch(watch_settings settings) : settings_(settings) {}

  // Each returns the change of phase that it caused, if any.
  [[nodiscard]] std::optional<connection_changed> on_transport(bool up, const std::string& reason);
  [[nodiscard]] std::optional<connection_changed> on_heartbeat(const io::mavlink::heartbeat& beat, std::uint8_t system,
                                                               std::uint8_t component, std::int64_t now_ns,
                                                               io::link::peer_id peer = io::link::only_peer);
  // The vehicle of the flight that is open: no other one is taken. None: no flight is open.
  [[nodiscard]] std::optional<connection_changed> keep(const std::optional<vehicle_name>& who);
  [[nodiscard]] const std::optional<vehicle_name>& kept() const { return kept_; }
  // Frames come and are not believed, which is why there is no heartbeat.
  [[nodiscard]] std::optional<connection_changed> on_refused(const std::string& why);
  [[nodiscard]] std::optional<connection_changed> on_time(std::int64_t now_ns);

  // The autopilot's time since boot, from any of its messages. It has started again when three of them that rise, over
  // a second at least, go back to before what was heard, and none of the old clock comes between.
  [[nodiscard]] std::optional<vehicle_restarted> on_boot_time(std::uint32_t boot_ms, std::int64_t now_ns);
  // The autopilot's heartbeats: it has started again when it boots after it did not (ArduPilot BOOT, PX4 UNINIT), and
  // that comes before all else that it sends (seen on ArduCopter 4.7-dev and PX4 1.17).
  [[nodiscard]] std::optional<vehicle_restarted> on_state(const io::mavlink::heartbeat& beat);
  // For each frame of the vehicle: its number as if it did not wrap, by which one that comes late, or twice, is known.
  // A loss of more than 127 frames in a row makes it too low for a while.
  [[nodiscard]] std::int64_t number_of(std::uint8_t sequence, std::int64_t now_ns);

  [[nodiscard]] bool is_vehicle(std::uint8_t system, std::uint8_t component, io::link::peer_id peer) const {
    return has_its_name(system, component) && vehicle_->peer == peer;
  }
  // Under the vehicle's name, whoever it is.
  [[nodiscard]] bool has_its_name(std::uint8_t system, std::uint8_t component) const {
    return vehicle_ && vehicle_->system == system && vehicle_->component == component;
  }
  [[nodiscard]] const std::optional<known_vehicle>& vehicle() const { return vehicle_; }
  [[nodiscard]] connection_phase phase() const { return phase_; }
  [[nodiscard]] const std::string& reason() const { return reason_; }
  [[nodiscard]] std::int64_t heartbeat_age_ms(std::int64_t now_ns) const; // -1: none yet
  [[nodiscard]] std::int64_t heard_for_ms(std::int64_t now_ns) const;     // connection::heard_for_ms
  [[nodiscard]] std::optional<std::int64_t> next_deadline_ns() const;
  [[nodiscard]] std::uint64_t restarts() const { return restarts_; }
  [[nodiscard]] std::uint64_t other_autopilots() const { return other_autopilots_; } // heartbeats of them
  // Autopilots of other names that were heard within others_count_ns, by their names.
  [[nodiscard]] std::vector<vehicle_name> others(std::int64_t now_ns) const;

private:
  struct other_autopilot {
    vehicle_name who;
    std::int64_t heard_ns = 0;
  };

  [[nodiscard]] bool is_autopilot(const io::mavlink::heartbeat& beat, std::uint8_t component) const;
  [[nodiscard]] std::uint8_t wanted_system() const; // 0: any
  void note_other(vehicle_name who, std::int64_t now_ns);
  [[nodiscard]] std::string waits_for() const; // as a sentence; empty: for any autopilot
  [[nodiscard]] std::string why_silent() const;
  [[nodiscard]] std::optional<connection_changed> wait_on(std::int64_t now_ns);
  [[nodiscard]] bool may_begin(std::uint8_t system, io::link::peer_id peer, std::int64_t now_ns);
  [[nodiscard]] std::optional<connection_changed> enter(connection_phase phase, std::string reason);

  watch_settings settings_;
  connection_phase phase_ = connection_phase::down;
  std::string reason_ = "the link is not open yet";
  std::optional<known_vehicle> vehicle_;
  std::uint64_t heartbeats_ = 0; // of this vehicle
  std::optional<vehicle_name> kept_;
  std::vector<other_autopilot> others_; // at most max_other_autopilots
  domain::confirmation_table candidates_;
  std::optional<std::int64_t> last_heartbeat_ns_;
  std::int64_t heard_since_ns_ = 0; // with last_heartbeat_ns_
  // A clock that may be a new one.
  struct new_clock {
    std::uint32_t newest_ms = 0;
    int frames = 1;
    std::int64_t since_ns = 0;
  };

  bool was_up_ = false; // its last heartbeat was of one that does not boot
  std::optional<std::uint32_t> boot_ms_;
  std::optional<new_clock> maybe_;
  std::int64_t newest_number_ = 0; // of all frames
  std::optional<std::int64_t> newest_ns_;
  std::uint64_t restarts_ = 0;
  std::uint64_t other_autopilots_ = 0;
};

} // namespace godwit::vehicle_link
