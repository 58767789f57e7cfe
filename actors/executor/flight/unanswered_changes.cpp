// plan_changes: what becomes of a change that the missions service does not answer in time.
#include <algorithm>
#include <limits>
#include <utility>

#include "actors/executor/flight/plan_changes.hpp"

namespace godwit::executor {
namespace {

// For an answer of the service, at least: a call over a slow line and a second try.
constexpr std::int64_t least_wait_ns = 500'000'000;

// Nobody expects a command to be executed so late: the computer was off, or the vehicle was not heard.
constexpr std::int64_t oldest_ns = 30'000'000'000;

constexpr auto never_ns = std::numeric_limits<std::int64_t>::max();

} // namespace

std::int64_t plan_changes::service_wait_ns() const { return flight_.configured.service_wait_ms * 1'000'000; }

// Counted from the command. Who took long to stand leaves the service the time for an answer all the same.
std::int64_t plan_changes::fly_at_ns(std::int64_t said_ns, instant now) const {
  const auto wait_ns = service_wait_ns();
  return std::max(said_ns + wait_ns, now.now_ns + std::min(wait_ns, least_wait_ns));
}

bool plan_changes::may_fly_unanswered() const {
  const auto& s = flight_.s;
  return s.change && !s.change->is_flown && !s.change->items.empty() && s.mission && !s.arrived && s.waiting.empty() &&
         flight_.has_service() && !flight_.configured.changes_need_service;
}

bool plan_changes::is_too_old(std::int64_t said_ns, instant now) { return now.wall_ns - said_ns > oldest_ns; }

// A new incarnation knows by the wall clock how long it has waited; one that was set counts for no more than the wait.
bool plan_changes::is_wait_over(instant now) {
  const auto& asked = *flight_.s.change;
  if (!waits_for_ || waits_for_->key != asked.key) {
    const auto wait_ns = service_wait_ns();
    const auto left_ns = std::clamp(asked.said_ns + wait_ns - now.wall_ns, std::int64_t{0}, wait_ns);
    waits_for_.emplace(awaited{asked.key, now.now_ns + left_ns});
  }
  return now.now_ns >= waits_for_->until_ns;
}

std::int64_t plan_changes::next_deadline_ns() const {
  return may_fly_unanswered() && waits_for_ ? waits_for_->until_ns : never_ns;
}

bool plan_changes::fly_unanswered(effects& out, instant now) {
  const auto& wanted = flight_.wanted; // another word ends the change
  if (!may_fly_unanswered() || !is_wait_over(now) || wanted.go_on || wanted.halt || flight_.has_open_intent() ||
      !flight_.may_change_plan() || !flight_.view.is_under_way() || !flight_.may_plan(now))
    return false;
  const auto& asked = *flight_.s.change;
  plan_change what;
  what.kind = asked.kind;
  what.after_item_id = asked.after_item_id;
  what.items = asked.items;
  auto revised = changed(what);
  auto why = revised ? why_not_changed(what, now) : revised.error();
  if (why.empty() && is_too_old(asked.said_ns, now))
    why = "it was commanded too long ago; repeat it";
  if (why.empty() && flight_.s.mission->revision != asked.base_revision)
    why = "it was made to revision " + std::to_string(asked.base_revision) + " of the mission";
  if (!why.empty()) {
    out.emplace_back(announce{"the missions service does not answer, and the mission is not changed: " + why, true});
    out.emplace_back(note{change_resolved{asked.key, false}});
    return true;
  }
  out.emplace_back(announce{"the missions service has not answered within " +
                                std::to_string(flight_.configured.service_wait_ms) +
                                " ms: the change is flown, and the service gets it as soon as it is back",
                            true});
  out.emplace_back(note{change_flown{asked.key, *std::move(revised)}});
  return true;
}

bool plan_changes::is_flown_unanswered(const std::string& key) const {
  return std::ranges::find(flight_.s.flown_changes, key, &flown_change::key) != flight_.s.flown_changes.end();
}

effects plan_changes::on_answer_to_flown(const mission_client::change_outcome& m) const {
  using mission_client::change_verdict;
  if (m.verdict == change_verdict::unknown)
    return {};
  const bool has_it = m.verdict == change_verdict::done;
  const auto sentence =
      has_it ? "the missions service has the change that was flown without its answer"
             : "the missions service does not have the change that was flown without its answer: " + m.reason +
                   ". Another revision of it is flown as soon as it comes";
  return {announce{sentence, !has_it}, note{change_answered{m.key, has_it}}};
}

} // namespace godwit::executor
