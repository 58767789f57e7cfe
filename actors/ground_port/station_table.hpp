// Which ground stations are there, by which way they are reached, and when the human's was heard last.
//
// A station is whoever speaks with another system id than the vehicle's. At the bound the one that was silent longest
// makes room, if it was silent for makes_room_after; else the newcomer is not taken. It is the operator's link from its
// heartbeats_to_begin-th heartbeat within 5 s on, by one way. Pure. Thread: one at a time.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "actors/domain/confirmation/confirmation_table.hpp"
#include "io/link/status.hpp"
#include "io/mavlink/frame.hpp"
#include "io/mavlink/messages/heartbeat.hpp"
#include "messages/ground_port/operator_link.hpp"

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

} // namespace godwit::ground_port
