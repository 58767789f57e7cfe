#include "actors/mission_client/changes.hpp"

#include "actors/mission_client/fetching.hpp"
#include "actors/mission_client/judgement.hpp"
#include "actors/mission_client/retry_policy.hpp"

namespace godwit::mission_client {

namespace {

// Only 429 says for certain that nothing was changed, and only of this try.
change_verdict verdict_after(const outbox_row& row, const service_answer& answer) {
  const bool was_kept_out = answer.how == ending::answered && answer.status == 429;
  return was_kept_out && row.tries == 0 ? change_verdict::refused : change_verdict::unknown;
}

event try_again(const outbox_row& row, const service_answer& answer) {
  return rows_failed{{row.key}, sentence_of(answer), answer.retry_after_ns.value_or(0)};
}

event try_again_or_fail(const outbox_row& row, const service_answer& answer, std::int64_t wall_ns) {
  const auto failed = row.tries + 1;
  const auto next_ns = wall_ns + change_pause_ns(failed, row.key, answer.retry_after_ns);
  if (failed < change_tries && next_ns < row.created_ns + change_window_ns)
    return try_again(row, answer);
  return change_failed{row.key, verdict_after(row, answer), sentence_of(answer)};
}

// Neither that the service has the change nor that it never will. One that the vehicle flies already is tried until
// then.
bool leaves_open(judgement answer) {
  return answer == judgement::transient || answer == judgement::bad_answer || answer == judgement::not_allowed ||
         answer == judgement::misconfigured;
}

event take_mission(const outbox_row& row, const service_answer& answer) {
  auto mission = mission_in(answer, row.mission_id);
  if (!mission && row.is_flown)
    return try_again(row, answer);
  if (!mission)
    return change_failed{row.key, change_verdict::unknown, mission.error().reason};
  return change_done{row.key, std::move(*mission)};
}

} // namespace

event outcome_of_change(const outbox_row& row, const service_answer& answer, std::int64_t wall_ns) {
  const auto judged = judge(answer);
  if (row.is_flown && leaves_open(judged))
    return try_again(row, answer);
  switch (judged) {
  case judgement::success:
    return take_mission(row, answer);
  case judgement::transient:
    return try_again_or_fail(row, answer, wall_ns);
  case judgement::gone:
    return mission_gone{row.mission_id};
  case judgement::conflict:
    return change_failed{row.key, change_verdict::stale, sentence_of(answer)};
  case judgement::bad_answer:
    return change_failed{row.key, change_verdict::unknown, sentence_of(answer)};
  default:
    return change_failed{row.key, change_verdict::refused, sentence_of(answer)};
  }
}

} // namespace godwit::mission_client
