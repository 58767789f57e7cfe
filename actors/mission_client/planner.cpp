#include "actors/mission_client/planner.hpp"

#include <utility>

namespace godwit::mission_client {

namespace {

std::uint64_t lost_reports(const state& s) {
  std::uint64_t result = 0;
  for (const auto& note : s.missions)
    result += note.lost_reports;
  return result;
}

} // namespace

requests planner::plan(const state& s, instant now) {
  planning_context d(s, now, settings_, book_, random_);
  for (part* each : std::initializer_list<part*>{&deliveries_, &store_operations_, &backlog_, &asking_next_, &fetching_,
                                                 &asking_progress_, &looking_up_, &pulling_, &polling_})
    each->plan(d);
  wake_ns_ = d.wake_ns;
  return std::move(d.out);
}

part* planner::take_waiting(ticket number) {
  const auto found = book_.waiting.find(number);
  if (found == book_.waiting.end())
    return nullptr;
  auto* result = found->second;
  book_.waiting.erase(found);
  return result;
}

requests planner::on_answer(const state& s, instant now, ticket number, const service_answer& answer) {
  planning_context d(s, now, settings_, book_, random_);
  const bool was_there = answer.how != ending::not_reached && answer.how != ending::misconfigured;
  connection_ = was_there ? connection_state::reachable : connection_state::unreachable;
  if (answer.how == ending::page_begun) {
    if (const auto found = book_.waiting.find(number); found != book_.waiting.end())
      found->second->on_page_begun(d, number, answer.body);
  } else if (auto* to = take_waiting(number)) {
    to->on_answer(d, number, answer);
  }
  return std::move(d.out);
}

requests planner::on_store(const state& s, instant now, ticket number, const store_answer& answer) {
  planning_context d(s, now, settings_, book_, random_);
  if (auto* to = take_waiting(number))
    to->on_store(d, number, answer);
  return std::move(d.out);
}

void planner::on_disk(const mission_client::on_disk& news) {
  deliveries_.on_disk(news.below_order);
  if (!news.frees_lanes)
    return;
  deliveries_.free();
  for (blockable_part* each :
       std::initializer_list<blockable_part*>{&polling_, &looking_up_, &asking_progress_, &asking_next_})
    each->free();
}

std::string planner::last_error(std::string_view kinds) const {
  std::string result;
  for (const auto& [kind, sentence] : book_.troubles)
    if (kind.starts_with(kinds))
      result.append(result.empty() ? "" : "; ").append(kind).append(": ").append(sentence);
  return result;
}

service_status planner::status(const state& s) const {
  const auto counts = count_rows(s.rows);
  return {.mission_id = s.mission_id,
          .revision = s.revision,
          .schema_version = s.schema_version,
          .last_fetch_ns = s.last_fetch_ns,
          .fetch_errors = book_.fetch_errors,
          .connection = connection_,
          .pull = s.pull,
          .push_pending = deliveries_.rows_in_batches(),
          .pending = counts.pending,
          .orphaned = counts.orphaned,
          .expired = counts.expired,
          .last_error = last_error(),
          .delivery_error = last_error(delivering),
          .may_deliver = !deliveries_.is_blocked(s.mission_id),
          .refused = s.refused ? s.refused->reason : std::string(),
          .refused_sample = s.refused ? s.refused->sample : std::string(),
          .lost_reports = lost_reports(s),
          .waits_for_next = s.now == phase::asking_next};
}

runtime::condition planner::health(const state& s) const {
  const auto why = last_error();
  if (s.now == phase::refused)
    return {runtime::health_colour::red, "the mission is refused" + (why.empty() ? "" : ": " + why)};
  if (deliveries_.blocked() != 0 || polling_.is_blocked() || looking_up_.is_blocked() ||
      asking_progress_.is_blocked() || asking_next_.is_blocked())
    return {runtime::health_colour::red, "the missions service does not allow it: " + why};
  if (s.refused_rows != 0 && is_full(s.rows))
    return {runtime::health_colour::red,
            "the outbox is full: " + std::to_string(s.refused_rows) + " reports were not taken"};
  const auto counts = count_rows(s.rows);
  std::string reason = why;
  const auto add = [&reason](std::uint32_t count, const char* what) {
    if (count != 0)
      reason.append(reason.empty() ? "" : "; ").append(std::to_string(count)).append(" deliveries ").append(what);
  };
  add(counts.orphaned, "are orphaned");
  add(counts.expired, "are expired");
  if (const auto lost = lost_reports(s); lost != 0)
    reason.append(reason.empty() ? "" : "; ").append(std::to_string(lost)).append(" reports of progress are lost");
  if (s.pull == pull_state::failed || s.pull == pull_state::cached_fallback)
    reason.append(reason.empty() ? "" : "; ").append("the map is not the service's");
  if (s.now == phase::asking_next && reason.empty())
    return {runtime::health_colour::green, "waits for the next mission of vehicle " + s.vehicle_id};
  if (is_deleted(s, s.mission_id))
    reason.append(reason.empty() ? "" : "; ").append("the service has deleted the mission");
  for (const auto& note : s.missions)
    if (note.is_pushing) {
      reason.append(reason.empty() ? "" : "; ").append("the map is being delivered");
      break;
    }
  return {reason.empty() ? runtime::health_colour::green : runtime::health_colour::yellow, reason};
}

} // namespace godwit::mission_client
