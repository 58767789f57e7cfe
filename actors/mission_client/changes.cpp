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

event try_again_or_fail(const outbox_row& row, const service_answer& answer, std::int64_t wall_ns) {
  const auto failed = row.tries + 1;
  const auto next_ns = wall_ns + change_pause_ns(failed, row.key, answer.retry_after_ns);
  if (failed < change_tries && next_ns < row.created_ns + change_window_ns)
    return rows_failed{{row.key}, sentence_of(answer), answer.retry_after_ns.value_or(0)};
  return change_failed{row.key, verdict_after(row, answer), sentence_of(answer)};
}

// The vehicle flies it already: it is tried until the service has it, or will not have it.
event try_again(const outbox_row& row, const service_answer& answer) {
  return rows_failed{{row.key}, sentence_of(answer), answer.retry_after_ns.value_or(0)};
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
  switch (judge(answer)) {
  case judgement::success:
    return take_mission(row, answer);
  case judgement::transient:
    return row.is_flown ? try_again(row, answer) : try_again_or_fail(row, answer, wall_ns);
  case judgement::gone:
    return mission_gone{row.mission_id};
  case judgement::conflict:
    return change_failed{row.key, change_verdict::stale, sentence_of(answer)};
  case judgement::bad_answer:
    return row.is_flown ? try_again(row, answer) : change_failed{row.key, change_verdict::unknown, sentence_of(answer)};
  case judgement::not_allowed:
  case judgement::misconfigured:
    if (row.is_flown)
      return try_again(row, answer);
    [[fallthrough]];
  default:
    return change_failed{row.key, change_verdict::refused, sentence_of(answer)};
  }
}

} // namespace godwit::mission_client
