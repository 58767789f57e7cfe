#include "actors/executor/flight/service_view.hpp"

#include <algorithm>
#include <utility>

namespace godwit::executor {

using mission_client::pull_state;

// -- what it tells ----------------------------------------------------------------------------------

void service_view::on_mission() {
  refusal_.clear();
  may_begin_again_ = false;
}

void service_view::on_refused(const mission_client::mission_refused& m, instant now) {
  refusal_ = m.reason;
  may_begin_again_ = m.why != mission_client::refusal::deleted;
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
}

// -- what is asked ----------------------------------------------------------------------------------

bool service_view::wants_status() const {
  return flight_.configured.has_service && !flight_.is_in_flight() && flight_.s.mission && map_ != pull_state::synced &&
         !is_over(flight_.s.status.now);
}

void service_view::ask_again(effects& out, instant now) {
  if (!flight_.configured.has_service || flight_.is_in_flight())
    return;
  const bool at_once = std::exchange(wants_pull_, false);
  if (may_begin_again_ && (at_once || now.now_ns >= begin_at_ns_)) {
    may_begin_again_ = false; // until it is refused again
    out.emplace_back(say_to_client{mission_client::begin_mission{flight_.configured.mission_id}});
    return;
  }
  if (wants_status() && !is_deleted())
    ask_for_map(out, now, at_once);
}

void service_view::ask_for_map(effects& out, instant now, bool at_once) {
  const auto& id = flight_.s.mission->mission_id;
  if (is_copy_accepted() && !at_once) {
    if (!std::exchange(is_told_of_copy_, true))
      out.emplace_back(say_to_client{mission_client::accept_copy{id}});
    return;
  }
  if (map_ != pull_state::failed && map_ != pull_state::cached_fallback)
    return;
  if (pull_at_ns_ == 0)
    pull_at_ns_ = now.now_ns + pull_pause_ns();
  if (!at_once && now.now_ns < pull_at_ns_)
    return;
  ++failed_pulls_; // until it goes well
  pull_at_ns_ = now.now_ns + pull_pause_ns();
  if (map_ == pull_state::failed)
    map_ = pull_state::in_flight;
  out.emplace_back(say_to_client{mission_client::pull_map{id}});
}

std::string service_view::pull() {
  if (!flight_.configured.has_service)
    return "the mission does not come from a missions service: there is nothing to pull";
  if (flight_.is_in_flight())
    return "a flight is under way; the map is pulled on the ground";
  const bool has_failed = map_ == pull_state::failed || map_ == pull_state::cached_fallback;
  if (is_deleted())
    return "the service has deleted the mission";
  if (!may_begin_again_ && !has_failed)
    return map_ == pull_state::synced ? "the mission and its map are there already"
                                      : "the mission or its map is being pulled already";
  wants_pull_ = true;
  return {};
}

std::int64_t service_view::pull_pause_ns() const {
  constexpr std::int64_t most_doublings = 4;
  return std::min(first_pull_pause_ns << std::min(failed_pulls_, most_doublings), longest_pull_pause_ns);
}

// -- what is known ----------------------------------------------------------------------------------

bool service_view::is_copy_accepted() const {
  const auto& checks = flight_.s.preflight;
  return map_ == pull_state::cached_fallback && checks.now == preflight::phase::pass && checks.report &&
         !checks.report->acknowledged_by.empty();
}

bool service_view::is_deleted() const {
  const auto& s = flight_.s;
  return s.mission && s.deleted_mission == s.mission->mission_id;
}

bool service_view::is_withdrawn() const { return is_deleted() && !flight_.flies_deleted_mission(); }

} // namespace godwit::executor
