#include "actors/executor/flight/service_view.hpp"

#include <algorithm>
#include <utility>

namespace godwit::executor {

using mission_client::pull_state;

// -- what it tells ----------------------------------------------------------------------------------

void service_view::on_mission(const mission_client::mission_loaded& m) {
  if (m.cause == mission_client::load_cause::brought)
    return;
  refusal_.clear();
  may_begin_again_ = false;
  next_at_ns_ = 0;
  if (m.cause != mission_client::load_cause::fetched)
    return;
  map_ = pull_state::in_flight; // that of the mission before is none for this one
  map_problem_.clear();
}

void service_view::on_refused(const mission_client::mission_refused& m, instant now) {
  const bool is_next = flight_.configured.asks_next();
  refusal_ = is_next ? "mission " + m.mission_id + ": " + m.reason : m.reason;
  may_begin_again_ = m.why != mission_client::refusal::deleted && !is_next;
  next_at_ns_ = now.now_ns + begin_again_ns;
  begin_at_ns_ = now.now_ns + begin_again_ns;
}

void service_view::on_map(const mission_client::map_pulled& m) {
  map_ = m.state;
  map_problem_ = m.reason;
  pull_at_ns_ = 0;
  if (map_ == pull_state::synced)
    failed_pulls_ = 0;
}

// While a pull that failed is made again, the copy from before is still there.
void service_view::on_status(const mission_client::service_status& m) {
  if (!flight_.s.mission || m.mission_id != flight_.s.mission->mission_id)
    return;
  if (m.pull == pull_state::in_flight && map_ == pull_state::cached_fallback)
    return;
  map_ = m.pull;
  if (map_ == pull_state::synced)
    map_problem_.clear();
}

void service_view::forget_told() {
  pull_at_ns_ = 0;
  is_told_of_copy_ = false;
  next_at_ns_ = 0;
}

// -- what is asked ----------------------------------------------------------------------------------

bool service_view::wants_status() const {
  return flight_.has_service() && !flight_.is_in_flight() && flight_.s.mission && map_ != pull_state::synced &&
         !is_over(flight_.s.status.now);
}

void service_view::ask_again(effects& out, instant now) {
  if (!flight_.configured.has_service || flight_.is_in_flight())
    return;
  const bool at_once = std::exchange(wants_pull_, false);
  if (flight_.waits_for_next())
    return ask_for_next(out, now, at_once);
  if (may_begin_again_ && (at_once || now.now_ns >= begin_at_ns_)) {
    may_begin_again_ = false; // until it is refused again
    out.emplace_back(send_to_client{mission_client::begin_mission{flight_.configured.mission_id}});
    return;
  }
  if ((wants_status() || (at_once && flight_.s.mission && flight_.has_service())) && !flight_.is_mission_deleted())
    ask_for_map(out, now, at_once);
}

std::vector<std::string> service_view::over() const {
  std::vector<std::string> result;
  const auto add = [&](const progress::mission_record& each) {
    if (progress::has_ended(flight_.s.progress, each.mission_id, each.revision))
      result.push_back(each.mission_id);
  };
  for (const auto& each : flight_.s.progress.past_missions)
    add(each);
  if (flight_.s.progress.mission)
    add(*flight_.s.progress.mission);
  if (flight_.s.mission && std::ranges::find(result, flight_.s.mission->mission_id) == result.end())
    result.push_back(flight_.s.mission->mission_id); // withdrawn, or called off before anything was told of it
  return result;
}

void service_view::ask_for_next(effects& out, instant now, bool at_once) {
  auto ended = over();
  if (!at_once && now.now_ns < next_at_ns_ && ended == told_over_)
    return;
  next_at_ns_ = now.now_ns + begin_again_ns;
  told_over_ = std::move(ended);
  out.emplace_back(send_to_client{mission_client::begin_next{flight_.configured.vehicle_id, told_over_}});
}

void service_view::ask_for_map(effects& out, instant now, bool at_once) {
  const auto& id = flight_.s.mission->mission_id;
  if (is_copy_accepted() && !at_once) {
    if (!std::exchange(is_told_of_copy_, true))
      out.emplace_back(send_to_client{mission_client::accept_copy{id}});
    return;
  }
  const bool is_there = map_ == pull_state::synced && at_once; // it is shown until a newer one is whole
  if (map_ != pull_state::failed && map_ != pull_state::cached_fallback && !is_there)
    return;
  if (pull_at_ns_ == 0)
    pull_at_ns_ = now.now_ns + pull_pause_ns();
  if (!at_once && now.now_ns < pull_at_ns_)
    return;
  if (!is_there)
    ++failed_pulls_; // until it goes well
  pull_at_ns_ = now.now_ns + pull_pause_ns();
  if (map_ != pull_state::cached_fallback)
    map_ = pull_state::in_flight;
  out.emplace_back(send_to_client{mission_client::pull_map{id}});
}

std::string service_view::pull() {
  if (!flight_.has_service() && !flight_.waits_for_next())
    return "the mission does not come from a missions service: there is nothing to pull";
  if (flight_.is_in_flight())
    return "a flight is under way; the map is pulled on the ground";
  if (flight_.waits_for_next()) {
    wants_pull_ = true;
    return {};
  }
  if (flight_.is_mission_deleted())
    return "the service has deleted the mission";
  if (!may_begin_again_ && map_ == pull_state::in_flight)
    return "the mission or its map is being pulled already";
  wants_pull_ = true;
  return {};
}

std::int64_t service_view::pull_pause_ns() const {
  constexpr std::int64_t most_doublings = 4;
  return std::min(first_pull_pause_ns << std::min(failed_pulls_, most_doublings), longest_pull_pause_ns);
}

// -- what is known ----------------------------------------------------------------------------------

std::string service_view::mission_under_way() const {
  const auto& s = flight_.s;
  if (!flight_.configured.asks_next())
    return flight_.configured.has_service ? flight_.configured.mission_id : std::string();
  const auto& next = s.arrived ? s.arrived : s.mission;
  const bool is_theirs = next && !is_of_people(s, next->mission_id);
  return is_theirs && (s.arrived || !flight_.waits_for_next()) ? next->mission_id : std::string();
}

bool service_view::is_copy_accepted() const {
  const auto& checks = flight_.s.preflight;
  return map_ == pull_state::cached_fallback && checks.now == preflight::phase::pass && checks.report &&
         !checks.report->acknowledged_by.empty();
}

} // namespace godwit::executor
