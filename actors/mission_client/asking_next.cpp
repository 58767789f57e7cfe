#include "actors/mission_client/asking_next.hpp"

#include <tl/expected.hpp>

#include "actors/domain/mission/error.hpp"
#include "actors/domain/mission/read.hpp"
#include "actors/mission_client/calls.hpp"
#include "actors/mission_client/judgement.hpp"
#include "actors/mission_client/polling.hpp"
#include "messages/mission/answer.hpp"

namespace godwit::mission_client {

namespace {

constexpr const char* ask_kind = "asking for the next mission";
constexpr unsigned no_content = 204;

// Errors: a sentence for people.
tl::expected<std::string, std::string> next_in(const state& s, const service_answer& answer) {
  const auto given = mission::read<mission::next_mission>(answer.body);
  if (!given)
    return tl::unexpected("what the service sent names no next mission: " + given.error().message());
  if (given->vehicle_id != s.vehicle_id)
    return tl::unexpected("the service sent a mission of vehicle " + mission::in_quotes(given->vehicle_id) +
                          " instead of " + mission::in_quotes(s.vehicle_id));
  if (is_mission_over(s, given->mission_id))
    return tl::unexpected("the service gives mission " + given->mission_id +
                          " again, which is over on board and is not begun again by itself; give the vehicle another "
                          "one, with an id of its own");
  return given->mission_id;
}

std::string sentence_for(const state& s, const service_answer& answer) {
  if (judge(answer) != judgement::not_found)
    return sentence_of(answer);
  return "the service knows no vehicle " + mission::in_quotes(s.vehicle_id) +
         ", or gives no next missions: check service.url and service.vehicle, or name one mission with mission.id (" +
         sentence_of(answer) + ")";
}

} // namespace

void asking_next::plan(planning_context& d) {
  if (d.s.now != phase::asking_next) {
    attempt_.forget(d);
    d.went_well(ask_kind);
    is_blocked_ = false;
    return;
  }
  if (is_blocked_ || !attempt_.may_start(d))
    return;
  started_ns_ = d.now.monotonic_ns;
  attempt_.waiting = d.call(*this, get_next(d.set, d.s.vehicle_id));
}

void asking_next::on_answer(planning_context& d, ticket number, const service_answer& answer) {
  if (!attempt_.ends_with(number) || d.s.now != phase::asking_next)
    return;
  const auto verdict = judge(answer);
  std::string why;
  if (verdict == judgement::success && answer.status == no_content) {
    attempt_.succeed();
    attempt_.not_before_ns = started_ns_ + least_poll_period_ns;
    return d.went_well(ask_kind);
  }
  if (verdict == judgement::success) {
    const auto next = next_in(d.s, answer);
    if (next)
      return d.happened(next_given{*next});
    why = next.error();
  } else {
    why = sentence_for(d.s, answer);
  }
  is_blocked_ = verdict == judgement::not_allowed;
  attempt_.fail_without_end(d, d.s.vehicle_id, answer.retry_after_ns);
  d.count_fetch_error();
  d.went_wrong(ask_kind, cut_error(why));
}

} // namespace godwit::mission_client
