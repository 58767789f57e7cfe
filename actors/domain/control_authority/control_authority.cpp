#include "actors/domain/control_authority/control_authority.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <utility>

#include "actors/domain/control_authority/mode_tables.hpp"
#include "actors/domain/vehicle_text/vehicle_text.hpp"

namespace godwit::flight {
namespace {

constexpr std::uint16_t no_sequence = 65535;
constexpr flight_mode not_known{mode_kind::unknown, std::numeric_limits<std::uint32_t>::max()};

} // namespace

void control_authority::begin(const flight_mode& mode) {
  failsafe_told_ns_.reset();
  breach_told_ns_.reset();
  landing_told_ns_.reset();
  told_.reset();
  drop_expected(mode);
  adopt(mode, holder::godwit);
  is_uncertain_ = false;
}

// What stands before it will not come any more.
void control_authority::drop_expected(const flight_mode& mode) {
  const auto found = std::ranges::find(expected_, mode.custom_mode);
  if (found != expected_.end())
    expected_.erase(expected_.begin(), std::next(found));
}

void control_authority::resume(std::vector<std::uint32_t> left_in, std::int64_t now_ns) {
  begin(not_known);
  expect(std::move(left_in), now_ns, now_ns + order_is_expected_ns);
  is_acknowledged_ = true; // as far as anybody can know now
}

void control_authority::end() { *this = {}; }

void control_authority::adopt(const flight_mode& mode, holder who) {
  ours_ = mode;
  ours_since_ns_.reset();
  who_ = who;
  was_ordered_ = false;
  unclear_.reset();
  awaits_heartbeat_ = false;
  taken_ns_.reset();
}

void control_authority::expect(std::vector<std::uint32_t> modes, std::int64_t now_ns, std::int64_t until_ns) {
  expected_ = std::move(modes);
  expected_until_ns_ = until_ns;
  begin_order(now_ns);
}

void control_authority::expect_also(const std::vector<std::uint32_t>& modes, std::int64_t now_ns,
                                    std::int64_t until_ns) {
  if (now_ns >= expected_until_ns_ + silences_until(now_ns))
    expected_.clear();
  for (const auto each : modes)
    if (std::ranges::find(expected_, each) == expected_.end())
      expected_.push_back(each);
  expected_until_ns_ = std::max(expected_until_ns_, until_ns);
  begin_order(now_ns);
}

void control_authority::begin_order(std::int64_t now_ns) {
  heard_ns_ = now_ns;
  silences_ns_ = 0;
  is_acknowledged_ = false;
}

void control_authority::acknowledge() {
  is_acknowledged_ = true;
  is_uncertain_ = false;
}

void control_authority::withdraw(const std::vector<std::uint32_t>& modes) {
  std::erase_if(expected_, [&](auto each) { return std::ranges::find(modes, each) != modes.end(); });
}

// While something was expected.
std::int64_t control_authority::silences_until(std::int64_t now_ns) const {
  const auto unheard_ns = now_ns - heard_ns_;
  const bool counts = unheard_ns > silence_ns && heard_ns_ < expected_until_ns_ + silences_ns_;
  return silences_ns_ + (counts ? unheard_ns : 0);
}

void control_authority::on_heartbeat(std::int64_t now_ns) {
  silences_ns_ = silences_until(now_ns);
  heard_ns_ = std::max(heard_ns_, now_ns);
}

bool control_authority::expects(const flight_mode& mode, std::int64_t now_ns) const {
  // That it goes on or returns nobody could have seen in a silence; a hold may be of a person who stopped it then.
  const bool moves = mode.kind == mode_kind::mission || mode.kind == mode_kind::returning;
  return now_ns < expected_until_ns_ + (moves ? silences_until(now_ns) : 0) &&
         std::ranges::find(expected_, mode.custom_mode) != expected_.end();
}

void control_authority::set_plan_end(plan_end end) {
  plan_end_ = std::move(end);
  sequence_.reset();
  is_complete_ = false;
}

bool control_authority::leads_to(const flight_mode& mode) const {
  return std::ranges::find(plan_end_.modes, mode.custom_mode) != plan_end_.modes.end();
}

bool control_authority::is_at_end() const {
  return sequence_ && *sequence_ >= plan_end_.from_sequence && (plan_end_.as_it_begins || is_complete_);
}

void control_authority::on_place(std::uint16_t sequence, bool is_complete, std::int64_t now_ns) {
  if (sequence == no_sequence)
    return;
  sequence_ = sequence;
  is_complete_ = is_complete;
  place_heard_ns_ = now_ns;
  on_time(now_ns);
}

void control_authority::on_mode(const mode_owner& whose, const flight_mode& mode, bool is_critical,
                                std::int64_t now_ns) {
  on_heartbeat(now_ns);
  awaits_heartbeat_ = false;
  if (!is_watching() || !is_ours())
    return;
  if (unclear_ && mode == unclear_->to)
    return on_time(now_ns);
  if (!unclear_ && mode == *ours_)
    return;
  if (expects(mode, now_ns)) {
    drop_expected(mode);
    adopt(mode, holder::godwit);
    ours_since_ns_ = now_ns;
    was_ordered_ = true;
    is_uncertain_ = mode.kind == mode_kind::hold && !is_acknowledged_;
    return;
  }
  if (follows_by_itself(whose, ours_->custom_mode, mode.custom_mode, was_ordered_))
    return adopt(mode, who_);
  if (!unclear_ && may_be_landing(whose, mode, now_ns)) {
    unclear_ = change{mode, now_ns, is_critical, false, true};
    return on_time(now_ns);
  }
  if (leads_to(mode) && !unclear_) {
    unclear_ = change{mode, now_ns, is_critical, false};
    return on_time(now_ns);
  }
  lose(is_critical, now_ns);
}

void control_authority::on_current_mode(const mode_owner& whose, const told_modes& told, std::int64_t now_ns) {
  if (!is_watching())
    return;
  const auto before = std::exchange(told_, told);
  judge_intention(whose, told, before, now_ns);
  const auto& actual = told.actual;
  const bool is_settled = actual == *ours_ || (unclear_ && actual == unclear_->to) || expects(actual, now_ns);
  if (is_ours() && !is_settled && may_follow_disarm(whose, actual.custom_mode))
    awaits_heartbeat_ = true;
  else
    on_mode(whose, actual, told.is_critical, now_ns);
}

// What was asked for before, or by us, is nobody's news. Without a word from before only what is ours is known.
void control_authority::judge_intention(const mode_owner& whose, const told_modes& told,
                                        const std::optional<told_modes>& before, std::int64_t now_ns) {
  if (told.intended == 0)
    return;
  const bool is_obeyed = told.intended == told.actual.custom_mode;
  if (is_obeyed) {
    taken_ns_.reset(); // who has taken it has asked for it
    return;
  }
  const bool was_ours = told.intended == ours_->custom_mode;
  const bool is_expected = expects(mode_of(whose, told.intended), now_ns);
  const bool is_known = was_ours || (before && before->intended == told.intended);
  const bool has_changed = before ? before->actual != told.actual : told.actual != *ours_;
  if (is_ours() && before && !is_known && !is_expected)
    take_away(holder::person);
  else if (is_ours() && has_changed && (is_known || is_expected))
    change_by_itself(told, now_ns);
  else if (who_ == holder::person && has_changed && is_known && taken_ns_ &&
           now_ns - *taken_ns_ <= failsafe_is_told_within_ns)
    who_ = holder::autopilot_failsafe;
}

// A PX4 that lands by its plan may hold for a moment when that is complete, before it disarms.
void control_authority::change_by_itself(const told_modes& told, std::int64_t now_ns) {
  const bool is_at_last = sequence_ && *sequence_ >= plan_end_.from_sequence;
  if (plan_end_.as_it_begins || !is_at_last || !leads_to(told.actual))
    return take_away(holder::autopilot_failsafe);
  unclear_ = change{told.actual, unclear_ ? unclear_->since_ns : now_ns, told.is_critical, true};
  on_time(now_ns);
}

bool tells_of_authority(std::string_view text) {
  return tells_failsafe(text) || tells_fence_breach(text) || tells_landing_of_plan(text);
}

void control_authority::on_text(const mode_owner& whose, std::string_view text, std::int64_t now_ns) {
  if (whose.autopilot != io::mavlink::mav_autopilot::ardupilotmega)
    return;
  if (tells_failsafe(text))
    failsafe_told_ns_ = now_ns;
  else if (tells_fence_breach(text))
    breach_told_ns_ = now_ns;
  else if (tells_landing_of_plan(text)) {
    landing_told_ns_ = now_ns;
    return on_time(now_ns);
  } else
    return;
  if (who_ == holder::person && taken_ns_ && is_told(*taken_ns_))
    who_ = holder::autopilot_failsafe;
}

bool control_authority::is_told(std::int64_t since_ns) const {
  return (failsafe_told_ns_ && std::abs(since_ns - *failsafe_told_ns_) <= failsafe_is_told_within_ns) ||
         (breach_told_ns_ && std::abs(since_ns - *breach_told_ns_) <= breach_is_told_within_ns);
}

void control_authority::on_time(std::int64_t now_ns) {
  if (!unclear_)
    return;
  if (unclear_->is_landing)
    return judge_landing(now_ns);
  if (is_at_end()) {
    const auto seen = *unclear_;
    plan_end_.modes.clear(); // believed once
    expected_.clear();
    adopt(seen.to, holder::autopilot_end);
    ours_since_ns_ = seen.since_ns;
    return;
  }
  const bool is_denied = place_heard_ns_ >= unclear_->since_ns + end_is_denied_after_ns;
  if (is_denied || now_ns >= unclear_->since_ns + end_is_told_within_ns)
    lose(unclear_->is_critical || unclear_->is_by_itself, unclear_->since_ns);
}

// Out of a return that was just seen to begin.
bool control_authority::may_be_landing(const mode_owner& whose, const flight_mode& mode, std::int64_t now_ns) const {
  return ours_since_ns_ && now_ns - *ours_since_ns_ <= landing_begins_within_ns &&
         may_land_by_plan(whose, ours_->custom_mode, mode.custom_mode);
}

void control_authority::judge_landing(std::int64_t now_ns) {
  const auto seen = *unclear_;
  if (landing_told_ns_ && std::abs(seen.since_ns - *landing_told_ns_) <= landing_is_told_within_ns)
    adopt(seen.to, who_);
  else if (now_ns - seen.since_ns > landing_is_told_within_ns)
    lose(seen.is_critical, seen.since_ns);
}

void control_authority::lose(bool is_critical, std::int64_t since_ns) {
  take_away(is_critical || is_told(since_ns) ? holder::autopilot_failsafe : holder::person);
  taken_ns_ = since_ns;
}

void control_authority::take_away(holder by) {
  who_ = by;
  unclear_.reset();
  awaits_heartbeat_ = false;
  expected_.clear();
  taken_ns_.reset();
}

} // namespace godwit::flight
