#include "actors/ground_port/station_table.hpp"

#include <algorithm>

#include "io/mavlink/enums.hpp"

namespace godwit::ground_port {

station* station_table::hear(mavlink::sender who, io::link::peer_id peer, std::int64_t now_ns) {
  auto found = std::find_if(stations_.begin(), stations_.end(), [&](const station& s) { return s.who == who; });
  if (found == stations_.end()) {
    if (stations_.size() < max_stations) {
      found = stations_.insert(stations_.end(), station{.who = who});
    } else {
      found = std::min_element(stations_.begin(), stations_.end(),
                               [](const station& a, const station& b) { return a.last_frame_ns < b.last_frame_ns; });
      if (now_ns - found->last_frame_ns < makes_room_after_ns) {
        ++refused_;
        return nullptr;
      }
      ++evicted_;
      *found = station{.who = who};
    }
  }
  found->peer = peer;
  found->last_frame_ns = now_ns;
  return &*found;
}

void station_table::note_heartbeat(station& of, const mavlink::heartbeat& m, std::int64_t now_ns) {
  of.last_beat_ns = now_ns;
  const auto who = (std::uint64_t{of.peer} << 16U) | (std::uint64_t{of.who.system} << 8U) | of.who.component;
  of.is_ground_station =
      m.type == mavlink::number(mavlink::mav_type::gcs) && beats_.note(who, heartbeats_to_begin_, now_ns);
  if (of.is_ground_station)
    operator_heard_ns_ = now_ns;
}

io::link::peer_id station_table::way_to(mavlink::sender who) const {
  const auto found = std::find_if(stations_.begin(), stations_.end(), [&](const station& s) { return s.who == who; });
  return found == stations_.end() ? io::link::every_peer : found->peer;
}

operator_link station_table::operator_now(std::int64_t now_ns) const {
  operator_link result;
  if (operator_heard_ns_) {
    result.ever_heard = true;
    result.age_ms = (now_ns - *operator_heard_ns_) / 1'000'000;
  }
  result.stations = static_cast<std::uint32_t>(std::count_if(stations_.begin(), stations_.end(), [&](const station& s) {
    return s.is_ground_station && s.last_beat_ns && now_ns - *s.last_beat_ns < counts_as_there_ns;
  }));
  return result;
}

std::optional<station_rules::objection> station_rules::look() const {
  using mavlink::mav_result;
  if (!role_)
    return std::nullopt;
  if (*role_ < operators::role::operator_)
    return objection{mav_result::denied, "stations only look here", "wrong_role"};
  if (!holder_)
    return objection{mav_result::temporarily_rejected, "who has control is not known yet", "no_control"};
  if (!holder_->empty())
    return objection{mav_result::temporarily_rejected, *holder_ + " has control", "no_control"};
  return std::nullopt;
}

} // namespace godwit::ground_port
