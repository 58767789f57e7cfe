#include "actors/ground_port/command_dedup.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <string_view>
#include <utility>

#include "runtime/assert.hpp"

namespace godwit::ground_port {

namespace {

using vehicle_role::order;

// By bits: a NaN that is repeated is the same one.
std::array<std::uint64_t, 7> bits_of(const order& what) {
  const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value); };
  return {bits(what.param1), bits(what.param2), bits(what.param3), bits(what.param4),
          bits(what.x),      bits(what.y),      bits(what.z)};
}

bool is_same(const order& a, const order& b) {
  return a.from == b.from && a.command == b.command && a.is_in_integers == b.is_in_integers && a.is_item == b.is_item &&
         a.frame == b.frame && bits_of(a) == bits_of(b);
}

} // namespace

bool command_dedup::is_forgotten(const entry& each, std::int64_t now_ns) {
  return each.result && now_ns - each.resolved_ns >= remembered_ns;
}

const command_dedup::entry* command_dedup::last_of(mavlink::sender from) const {
  const auto found =
      std::find_if(entries_.begin(), entries_.end(), [&](const entry& each) { return each.what.from == from; });
  return found == entries_.end() ? nullptr : &*found;
}

std::optional<mavlink::mav_result> command_dedup::heard_before(const order& what, std::int64_t now_ns) const {
  const auto* const last = last_of(what.from);
  if (last == nullptr || is_forgotten(*last, now_ns) || !is_same(last->what, what))
    return std::nullopt;
  return last->result.value_or(mavlink::mav_result::in_progress);
}

bool command_dedup::may_begin(mavlink::sender from, std::int64_t now_ns) const {
  if (const auto* const last = last_of(from))
    return last->result.has_value();
  return entries_.size() < max_stations ||
         std::any_of(entries_.begin(), entries_.end(), [&](const entry& each) { return is_forgotten(each, now_ns); });
}

std::uint64_t command_dedup::begin(const order& what, std::int64_t now_ns) {
  GODWIT_ASSERT(may_begin(what.from, now_ns), "one word of each station is under way");
  std::erase_if(entries_, [&](const entry& each) { return each.what.from == what.from || is_forgotten(each, now_ns); });
  entries_.push_back({.what = what, .request = ++last_request_});
  return last_request_;
}

std::optional<order> command_dedup::resolve(std::uint64_t request, mavlink::mav_result result, std::int64_t now_ns) {
  const auto found = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const entry& each) { return each.request == request && !each.result; });
  if (found == entries_.end())
    return std::nullopt;
  found->result = result;
  found->resolved_ns = now_ns;
  return found->what;
}

namespace {

using executor::start_verdict;
using io::mavlink::instant;
using io::mavlink::mav_result;
using io::mavlink::number;

constexpr std::string_view arm_it = "arm within 15 s to start it"; // at most 50 characters in all: one STATUSTEXT

mav_result result_for(start_verdict verdict) {
  switch (verdict) {
  case start_verdict::started:
  case start_verdict::awaits_arming:
    return mav_result::accepted;
  case start_verdict::not_ready:
  case start_verdict::too_late:
    return mav_result::temporarily_rejected;
  case start_verdict::disarmed:
    return mav_result::denied;
  case start_verdict::no_such_item:
  case start_verdict::failed:
    break;
  }
  return mav_result::failed;
}

std::string text_for(const executor::start_answer& answer) {
  if (answer.verdict == start_verdict::started)
    return "Mission started";
  if (answer.verdict == start_verdict::awaits_arming)
    return "Mission start: " + std::string(arm_it);
  if (!answer.reason.empty())
    return "Mission start: " + answer.reason;
  switch (answer.verdict) {
  case start_verdict::not_ready:
    return "Mission start: not ready";
  case start_verdict::disarmed:
    return "Mission start: disarmed";
  case start_verdict::no_such_item:
    return "Mission start: the plan has changed";
  case start_verdict::too_late:
    return "Mission start: it came too late";
  case start_verdict::started:
  case start_verdict::awaits_arming:
  case start_verdict::failed:
    break;
  }
  return "Mission start: failed";
}

} // namespace

// The clocks of an earlier life have no meaning here but by the time of day; a clock that was set makes nobody wait for
// longer than in one life.
start_dedup::start_dedup(std::optional<start_record> restored, instant now) : record_(std::move(restored)) {
  if (!record_)
    return;
  const auto age_of = [&](std::int64_t wall_ns) { return std::max<std::int64_t>(0, now.wall_ns - wall_ns); };
  deadline_ns_ = now.monotonic_ns + std::max<std::int64_t>(0, answer_patience_ns - age_of(record_->asked_at_ns));
  resolved_ns_ = now.monotonic_ns - age_of(record_->resolved_at_ns);
}

start_dedup::kind start_dedup::judge(const vehicle_role::order& what, std::uint32_t plan_id, instant now) const {
  if (!record_)
    return kind::fresh;
  const auto& asked_by = record_->asked.asked_by;
  const bool is_same = asked_by.system == what.from.system && asked_by.component == what.from.component &&
                       record_->first_item == what.param1 && record_->last_item == what.param2;
  if (is_asked())
    return is_same ? kind::repeated_while_asked : kind::busy;
  // After a refusal nothing was started: who asks again without counting may have changed what was in the way.
  const bool was_refused = record_->is_answered && record_->result != number(mav_result::accepted);
  if (record_->asked.plan_id != plan_id || (was_refused && what.confirmation == 0))
    return kind::fresh;
  const auto remembered = what.confirmation > 0 ? remembered_ns : repeats_uncounted_ns;
  return is_same && now.monotonic_ns - resolved_ns_ < remembered ? kind::repeated_after : kind::fresh;
}

start_record start_dedup::begin(const vehicle_role::order& what, const vehicle_role::start_decision& decided,
                                std::uint32_t plan_id, instant now) {
  const auto last_key = record_ ? record_->asked.key : 0;
  start_record next;
  // Rises also when the journal was lost, so that no start is taken for one of an earlier life.
  next.asked.key = std::max(last_key + 1, static_cast<std::uint64_t>(now.wall_ns));
  next.asked.first = static_cast<std::uint16_t>(decided.first);
  next.asked.last = static_cast<std::uint16_t>(decided.last);
  next.asked.plan_id = plan_id;
  next.asked.asked_by = {what.from.system, what.from.component};
  next.asked.obey_until_ns = now.wall_ns + obeyed_within_ns;
  next.asked.by_mode = what.command != number(io::mavlink::mav_cmd::mission_start);
  next.command = what.command;
  next.asked_component = what.target_component;
  next.first_item = what.param1;
  next.last_item = what.param2;
  next.asked_at_ns = now.wall_ns;
  deadline_ns_ = now.monotonic_ns + answer_patience_ns;
  record_ = next;
  return next;
}

std::optional<start_record> start_dedup::resolve(const executor::start_answer& answer, instant now) {
  if (!record_ || record_->asked.key != answer.key || record_->is_answered)
    return std::nullopt;
  return resolved(result_for(answer.verdict), text_for(answer), true, now);
}

std::optional<start_record> start_dedup::on_time(instant now) {
  if (!is_asked() || now.monotonic_ns < deadline_ns_)
    return std::nullopt;
  return resolved(mav_result::temporarily_rejected, "Mission start: the executor does not answer", false, now);
}

start_record start_dedup::resolved(mav_result result, std::string text, bool is_answered, instant now) {
  record_->is_correction = record_->is_resolved;
  record_->is_resolved = true;
  record_->is_answered = is_answered;
  record_->result = number(result);
  record_->text = std::move(text);
  record_->resolved_at_ns = now.wall_ns;
  resolved_ns_ = now.monotonic_ns;
  return *record_;
}

} // namespace godwit::ground_port
