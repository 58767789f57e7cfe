#include "actors/mission_client/polling.hpp"

#include <algorithm>

#include "actors/domain/mission/read.hpp"
#include "actors/mission_client/calls.hpp"
#include "actors/mission_client/judgement.hpp"

namespace godwit::mission_client {

namespace {

constexpr const char* poll_kind = "asking for assignments";

// An insert that was taken meanwhile does not hide an assignment of before it. 0: in a journal of an earlier version.
std::int32_t asks_after(const state& s) { return s.asks_after != 0 ? s.asks_after : s.revision; }

bool is_new(const state& s, const mission::assignment& seen) {
  return std::ranges::none_of(
      s.assignments, [&](const open_assignment& each) { return each.what.assignment_id == seen.assignment_id; });
}

// What is open has to be responded to first; the service keeps the others.
bool has_no_room(const state& s) {
  const auto open = std::ranges::count(s.assignments, false, &open_assignment::is_responded);
  return static_cast<std::size_t>(open) >= max_open_assignments;
}

} // namespace

void polling::plan(planning_context& d) {
  if (d.s.now != phase::ready || is_deleted(d.s, d.s.mission_id) || mission_id_ != d.s.mission_id) {
    attempt_.forget(d);
    d.went_well(poll_kind);
    is_blocked_ = false;
    mission_id_ = d.s.mission_id;
  }
  if (d.s.now != phase::ready || is_deleted(d.s, mission_id_) || is_blocked_ || has_no_room(d.s) ||
      !attempt_.may_start(d))
    return;
  started_ns_ = d.now.monotonic_ns;
  attempt_.waiting = d.call(*this, get_assignments(d.set, mission_id_, asks_after(d.s)));
}

void polling::on_answer(planning_context& d, ticket number, const service_answer& answer) {
  if (!attempt_.ends_with(number))
    return;
  const auto verdict = judge(answer);
  auto why = verdict == judgement::success ? std::string() : sentence_of(answer);
  if (verdict == judgement::success) {
    auto list = mission::read<mission::assignment_list>(answer.body);
    if (list) {
      attempt_.succeed();
      attempt_.not_before_ns = started_ns_ + least_poll_period_ns;
      d.went_well(poll_kind);
      std::erase_if(list->assignments, [&](const mission::assignment& each) { return !is_new(d.s, each); });
      if (!list->assignments.empty())
        d.happened(assignments_seen{mission_id_, std::move(list->assignments)});
      return;
    }
    why = "what the service sent is no list of assignments: " + list.error().message();
  }
  if (verdict == judgement::gone)
    return d.happened(mission_gone{mission_id_});
  is_blocked_ = verdict == judgement::not_allowed;
  attempt_.fail_without_end(d, mission_id_, answer.retry_after_ns);
  d.went_wrong(poll_kind, cut_error(why));
}

} // namespace godwit::mission_client
