// Which ground stations are there, by which way they are reached, and when the human's was heard last.
//
// A station is whoever speaks with another system id than the vehicle's. At the bound the one that was silent longest
// makes room, if it was silent for makes_room_after; else the newcomer is not taken. It is the operator's link from its
// heartbeats_to_begin-th heartbeat within 5 s on, by one way. Pure. Thread: one at a time.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "actors/domain/confirmation/confirmation_table.hpp"
#include "io/link/status.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/frame.hpp"
#include "io/mavlink/messages/heartbeat.hpp"
#include "messages/ground_port/types.hpp"
#include "messages/operator/principal.hpp"

namespace godwit::ground_port {

namespace mavlink = io::mavlink;

struct station {
  mavlink::sender who;
  io::link::peer_id peer = io::link::every_peer; // where it was heard last
  std::int64_t last_frame_ns = 0;
  std::optional<std::int64_t> last_beat_ns = {};
  bool is_ground_station = false;
  std::optional<std::int64_t> told_about_commands_ns = {}; // that this port passes none on
  std::optional<std::int64_t> told_about_passing_ns = {};  // that something is not passed on
};

class station_table {
public:
  explicit station_table(int heartbeats_to_begin = 1) : heartbeats_to_begin_(heartbeats_to_begin) {}

  static constexpr std::size_t max_stations = 16;
  static constexpr std::int64_t makes_room_after_ns = 5'000'000'000;
  static constexpr std::int64_t counts_as_there_ns = 5'000'000'000; // five heartbeats

  // A frame of WHO came by PEER. Nothing: there is no room for it. Valid until the next call.
  [[nodiscard]] station* hear(mavlink::sender who, io::link::peer_id peer, std::int64_t now_ns);
  void note_heartbeat(station& of, const mavlink::heartbeat& m, std::int64_t now_ns);

  // Where to send what is meant for WHO; to everybody when it was not heard.
  [[nodiscard]] io::link::peer_id way_to(mavlink::sender who) const;

  [[nodiscard]] operator_link operator_now(std::int64_t now_ns) const;
  [[nodiscard]] std::span<const station> all() const { return stations_; }
  [[nodiscard]] std::uint64_t refused() const { return refused_; } // frames
  [[nodiscard]] std::uint64_t evicted() const { return evicted_; }

private:
  int heartbeats_to_begin_;
  domain::confirmation_table beats_;
  std::vector<station> stations_;
  std::optional<std::int64_t> operator_heard_ns_;
  std::uint64_t refused_ = 0;
  std::uint64_t evicted_ = 0;
};

// Whether stations may say what godwit does for them: start, resume, go to, choose an item, bring or clear a plan.
//
//   role        control                    they may
//   viewer      -                          DENIED
//   operator    not known yet              TEMPORARILY_REJECTED: in doubt nothing is done
//               somebody else has it       TEMPORARILY_REJECTED, with the name
//               free                       all of it
//
// A station can not take control, so somebody always is somebody else. Holding and returning are never asked about
// here. Pure. Thread: one owner.
class station_rules {
public:
  // What stations are; none: there are no operators beside them, and they may say everything.
  explicit station_rules(std::optional<operators::role> role) : role_(role) {}

  // Empty: nobody has control.
  void on_control(std::string holder) { holder_ = std::move(holder); }
  [[nodiscard]] bool knows_control() const { return holder_.has_value(); }

  struct objection {
    mavlink::mav_result result = mavlink::mav_result::denied;
    std::string why;     // short enough for a STATUSTEXT with what was wanted before it
    std::string outcome; // for the audit
  };
  // None: they may.
  [[nodiscard]] std::optional<objection> look() const;

private:
  std::optional<operators::role> role_;
  std::optional<std::string> holder_; // none: not heard yet
};

} // namespace godwit::ground_port
