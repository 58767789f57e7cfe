#include "actors/failsafe/takeover_detector.hpp"

#include <algorithm>

namespace godwit::failsafe {

takeover_detector::takeover_detector(const pilot_memory& restored, const flight::plan_end& end, instant now)
    : plan_end_(end), last_(restored.ours) {
  if (restored.ours)
    authority_.begin(*restored.ours);
  authority_.set_plan_end(end);
  std::vector<std::uint32_t> modes;
  std::int64_t left_ns = 0;
  for (const auto& each : restored.expected)
    if (each.custom_mode && each.until_ns) {
      modes.push_back(*each.custom_mode);
      left_ns = std::clamp(*each.until_ns - now.wall_ns, left_ns, max_expectation_ms * ns_per_ms);
    }
  if (left_ns > 0)
    expect(modes, left_ns / ns_per_ms, now);
  if (restored.taken_over)
    take_over();
}

void takeover_detector::expect(const std::vector<std::uint32_t>& modes, std::int64_t lasts_ms, instant now) {
  const auto lasts_ns = std::clamp<std::int64_t>(lasts_ms, 0, max_expectation_ms) * ns_per_ms;
  authority_.expect_also(modes, now.monotonic_ns, now.monotonic_ns + lasts_ns);
  expected_until_wall_ns_ = std::max(expected_until_wall_ns_.value_or(0), now.wall_ns + lasts_ns);
}

void takeover_detector::set_plan_end(const flight::plan_end& end) {
  plan_end_ = end;
  authority_.set_plan_end(end);
}

void takeover_detector::take_over() {
  authority_.take_away(flight::holder::person);
  begun_ns_.reset();
  adopts_ = false;
}

void takeover_detector::hand_back() {
  adopts_ = true;
  authority_.set_plan_end(plan_end_); // a failsafe that had acted has forgotten it
}

void takeover_detector::on_place(std::uint16_t sequence, bool is_complete, instant now) {
  authority_.on_place(sequence, is_complete, now.monotonic_ns);
}

void takeover_detector::on_text(const flight::mode_owner& whose, std::string_view text, instant now) {
  authority_.on_text(whose, text, now.monotonic_ns);
}

// Who begins a flight is judged by heartbeats alone.
void takeover_detector::on_current_mode(const flight::mode_owner& whose, const flight::told_modes& told, instant now) {
  if (begun_ns_)
    return;
  authority_.on_current_mode(whose, told, now.monotonic_ns);
  last_ = authority_.ours();
}

bool takeover_detector::begins_as_ours(const seen_mode& seen, instant now) const {
  if (authority_.expects(seen.mode, now.monotonic_ns))
    return true;
  if (has_acted_at_begin_)
    return false;
  if (bounces_ && came_down_ == seen.mode)
    return true;
  return seen.mode.kind == mode_kind::mission || (!is_found_ && seen.mode.kind == mode_kind::take_off);
}

void takeover_detector::judge_begin(const seen_mode& seen, instant now) {
  if (begins_as_ours(seen, now))
    authority_.begin(seen.mode);
  else if (is_found_ || seen.heard_ns > *begun_ns_)
    take_over();
  else
    return;
  begun_ns_.reset();
}

void takeover_detector::evaluate(const flight_now& flight, const seen_mode& seen, instant now) {
  if (flight.ends)
    came_down_ = authority_.is_ours() ? authority_.ours() : std::nullopt;
  if (flight.ends && authority_.is_ours()) { // who has taken it still has it
    authority_.end();
    authority_.set_plan_end(plan_end_);
    expected_until_wall_ns_.reset();
    begun_ns_.reset();
  }
  if (judged_ns_ != seen.heard_ns)
    authority_.on_heartbeat(now.monotonic_ns);
  const bool was_known = authority_.is_watching();
  if (adopts_) {
    authority_.begin(seen.newest.value_or(seen.mode));
    begun_ns_.reset();
  } else if (flight.in_flight && authority_.is_ours() && (flight.begins || begun_ns_ || !was_known)) {
    if (!begun_ns_) {
      begun_ns_ = now.monotonic_ns;
      is_found_ = flight.is_found;
      bounces_ = flight.is_bounce;
      has_acted_at_begin_ = false;
    }
    judge_begin(seen, now);
  } else if (flight.in_flight) {
    if (judged_ns_ != seen.heard_ns)
      authority_.on_mode(seen.whose, seen.mode, seen.is_critical, now.monotonic_ns);
    authority_.on_time(now.monotonic_ns);
  }
  judged_ns_ = seen.heard_ns;
  adopts_ = false;
  last_ = flight.in_flight ? authority_.ours() : seen.mode;
}

pilot_memory takeover_detector::memory() const {
  pilot_memory result{last_, is_taken_over(), {}};
  for (const auto each : authority_.expected())
    result.expected.push_back({mode_kind::unknown, expected_until_wall_ns_, each});
  return result;
}

} // namespace godwit::failsafe
