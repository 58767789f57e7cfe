#include "actors/vehicle_link/stream_keeper.hpp"

#include <algorithm>
#include <utility>

#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages.hpp"
#include "io/time_units.hpp"

namespace godwit::vehicle_link {

namespace {

namespace mavlink = io::mavlink;

constexpr std::int64_t windows_per_judgement = 3; // intervals that have to fit into a window

std::int64_t window_ns(const wanted_stream& s) {
  return std::max(stream_window_min_ms, windows_per_judgement * s.interval_ms) * ns_per_ms;
}

// MAV_DATA_STREAM of the older request, which knows groups and not messages. 0: all of them.
std::uint8_t group_of(std::uint32_t message) {
  switch (message) {
  case mavlink::attitude::message_id:
    return 10; // EXTRA1
  case mavlink::vfr_hud::message_id:
    return 11; // EXTRA2
  case mavlink::battery_status::message_id:
  case mavlink::ekf_status_report::message_id:
  case mavlink::estimator_status::message_id:
  case mavlink::extended_sys_state::message_id:
  case mavlink::system_time::message_id:
    return 12; // EXTRA3
  case mavlink::global_position_int::message_id:
    return 6; // POSITION
  case mavlink::sys_status::message_id:
  case mavlink::gps_raw_int::message_id:
  case mavlink::mission_current::message_id:
  case mavlink::fence_status::message_id:
    return 2; // EXTENDED_STATUS
  default:
    return 0;
  }
}

} // namespace

stream_keeper::stream_keeper(std::vector<wanted_stream> wanted) {
  if (wanted.size() > max_wanted_streams)
    wanted.resize(max_wanted_streams);
  for (const auto& each : wanted)
    streams_.push_back({.wanted = each});
}

void stream_keeper::begin(std::int64_t now_ns, std::optional<mavlink::mav_autopilot> whose) {
  is_begun_ = true;
  for (auto& each : streams_) {
    const bool has_it = !each.wanted.only_of || each.wanted.only_of == whose;
    each = {.wanted = each.wanted, .at = has_it ? step::unasked : step::idle, .due_ns = now_ns, .window_from = now_ns};
  }
}

void stream_keeper::end() {
  is_begun_ = false;
  for (auto& each : streams_)
    each = {.wanted = each.wanted};
}

void stream_keeper::want_heartbeats(bool is_close, std::int64_t now_ns) {
  const auto interval_ms = is_close ? close_heartbeat_ms : usual_heartbeat_ms;
  auto found = std::ranges::find(streams_, mavlink::heartbeat::message_id,
                                 [](const stream& each) { return each.wanted.message; });
  if (found == streams_.end()) {
    if (!is_close)
      return; // it was never asked for more
    found = streams_.insert(streams_.end(), {.wanted = {mavlink::heartbeat::message_id, interval_ms, {}, true}});
  } else if (found->wanted.interval_ms == interval_ms) {
    return;
  }
  const bool is_asked = found->at == step::asked; // the answer to that request comes first
  found->wanted.interval_ms = interval_ms;
  if (!is_asked && is_begun_) // else with all others, when the vehicle is there
    *found = {.wanted = found->wanted, .at = step::unasked, .due_ns = now_ns, .window_from = now_ns};
}

void stream_keeper::on_message(std::uint32_t id) {
  for (auto& each : streams_)
    if (each.wanted.message == id)
      ++each.arrived;
}

stream_keeper::stream* stream_keeper::asked() {
  const auto found =
      std::find_if(streams_.begin(), streams_.end(), [](const stream& s) { return s.at == step::asked; });
  return found == streams_.end() ? nullptr : &*found;
}

void stream_keeper::on_outcome(const command_outcome& outcome, std::int64_t now_ns) {
  auto* s = asked();
  if (s == nullptr)
    return;
  if (s->wanted.is_occasional && outcome.verdict != command_verdict::timed_out)
    s->at = step::idle;
  else // accepted or not: what comes is judged
    watch(*s, now_ns);
}

void stream_keeper::watch(stream& s, std::int64_t now_ns) {
  s.at = step::watched;
  s.arrived = 0;
  s.window_from = now_ns;
  s.due_ns = now_ns + window_ns(s.wanted);
}

void stream_keeper::judge(stream& s, std::int64_t now_ns) {
  // Half of what was asked for counts as coming: a slow radio and a busy autopilot send less.
  const auto expected = (now_ns - s.window_from) / (s.wanted.interval_ms * ns_per_ms);
  if (static_cast<std::int64_t>(s.arrived) * 2 >= expected && s.arrived > 0) {
    s.is_missing = false;
    s.tries = 0;
    s.fell_back = false;
    watch(s, now_ns);
    return;
  }
  s.is_missing = s.arrived == 0 && !s.wanted.is_optional;
  s.at = step::unasked;
  s.due_ns = now_ns;
  if (s.fell_back || (s.wanted.is_optional && s.tries == stream_tries)) { // nothing helped; try it all again much later
    s.tries = 0;
    s.fell_back = false;
    s.due_ns = now_ns + stream_retry_ms * ns_per_ms;
  }
}

stream_keeper::request stream_keeper::request_for(stream& s) {
  if (s.tries < stream_tries) {
    ++s.tries;
    s.at = step::asked;
    send_command what;
    what.command = static_cast<std::uint16_t>(mavlink::mav_cmd::set_message_interval);
    what.param1 = static_cast<float>(s.wanted.message);
    what.param2 = static_cast<float>(s.wanted.interval_ms) * 1'000.0F;
    return what;
  }
  s.fell_back = true;
  mavlink::request_data_stream older;
  older.req_stream_id = group_of(s.wanted.message);
  older.req_message_rate = static_cast<std::uint16_t>(std::max(1, 1'000 / std::max(1, s.wanted.interval_ms)));
  older.start_stop = 1;
  return older;
}

std::optional<stream_keeper::request> stream_keeper::next_request(std::int64_t now_ns) {
  for (auto& each : streams_)
    if (each.at == step::watched && each.due_ns <= now_ns)
      judge(each, now_ns);
  if (asked() != nullptr)
    return std::nullopt;
  for (auto& each : streams_) {
    if (each.at != step::unasked || each.due_ns > now_ns)
      continue;
    auto result = request_for(each);
    if (each.fell_back)
      watch(each, now_ns);
    return result;
  }
  return std::nullopt;
}

std::optional<std::int64_t> stream_keeper::next_deadline_ns() const {
  std::optional<std::int64_t> result;
  const bool busy = std::any_of(streams_.begin(), streams_.end(), [](const stream& s) { return s.at == step::asked; });
  for (const auto& each : streams_)
    if (each.at == step::watched || (each.at == step::unasked && !busy))
      result = std::min(result.value_or(each.due_ns), each.due_ns);
  return result;
}

std::vector<std::uint32_t> stream_keeper::missing() const {
  std::vector<std::uint32_t> result;
  for (const auto& each : streams_)
    if (each.is_missing)
      result.push_back(each.wanted.message);
  return result;
}

} // namespace godwit::vehicle_link
