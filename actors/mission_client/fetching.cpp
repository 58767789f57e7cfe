#include "actors/mission_client/fetching.hpp"

#include <algorithm>
#include <utility>

#include "actors/domain/mission/read.hpp"
#include "actors/mission_client/calls.hpp"
#include "actors/mission_client/judgement.hpp"

namespace godwit::mission_client {

namespace {

constexpr const char* fetch_kind = "fetching the mission";
constexpr const char* look_up_kind = "looking up the mission";
constexpr const char* ask_kind = "asking for the last report";

} // namespace

tl::expected<mission::document, unusable_mission> mission_in(const service_answer& answer, const std::string& id) {
  auto result = mission::read<mission::document>(answer.body);
  if (!result)
    return tl::unexpected(
        unusable_mission{"what the service sent is no mission: " + result.error().message(), result.error().sample});
  if (result->mission_id != id)
    return tl::unexpected(unusable_mission{"the service sent mission " + result->mission_id + " instead of " + id,
                                           answer.body.substr(0, mission::max_document_sample)});
  return std::move(*result);
}

tl::expected<mission::progress_status, unusable_mission> progress_in(const service_answer& answer,
                                                                     const std::string& id) {
  auto result = mission::read<mission::progress_status>(answer.body);
  if (!result)
    return tl::unexpected(unusable_mission{
        "what the service sent is no state of the progress: " + result.error().message(), result.error().sample});
  if (result->last_report && result->last_report->mission_id != id)
    return tl::unexpected(unusable_mission{
        "the service sent a report of mission " + result->last_report->mission_id + " as one of " + id, {}});
  return std::move(*result);
}

// -- at the begin ---------------------------------------------------------------------------------

void fetching::plan(planning_context& d) {
  if (d.s.now != phase::fetching || mission_id_ != d.s.mission_id) {
    attempt_.forget(d);
    mission_id_ = d.s.mission_id;
    mission_.reset();
  }
  if (d.s.now == phase::fetching && attempt_.may_start(d))
    attempt_.waiting = d.call(*this, mission_ ? get_progress(d.set, mission_id_) : get_mission(d.set, mission_id_));
}

void fetching::on_answer(planning_context& d, ticket number, const service_answer& answer) {
  if (!attempt_.ends_with(number))
    return;
  if (d.s.now != phase::fetching || mission_id_ != d.s.mission_id) // another mission was begun meanwhile
    return;
  if (mission_)
    take_progress(d, answer);
  else if (judge(answer) == judgement::success)
    take_mission(d, answer);
  else
    take_failure(d, answer);
}

void fetching::take_mission(planning_context& d, const service_answer& answer) {
  auto mission = mission_in(answer, mission_id_);
  if (!mission)
    return refuse(d, refusal::invalid, mission.error().reason, mission.error().sample);
  mission_ = *std::move(mission);
  attempt_.succeed();
}

void fetching::take_progress(planning_context& d, const service_answer& answer) {
  switch (judge(answer)) {
  case judgement::success:
    break;
  case judgement::not_found:
  case judgement::wrong: // 405: there is no such call
    return end(d, {});
  default:
    return take_failure(d, answer);
  }
  auto told = progress_in(answer, mission_id_);
  if (!told)
    return refuse(d, refusal::invalid, told.error().reason, told.error().sample);
  end(d, *std::move(told));
}

void fetching::end(planning_context& d, std::optional<mission::progress_status> told) {
  d.went_well(fetch_kind);
  mission_fetched result{*std::exchange(mission_, {}), {}, {}};
  if (told) {
    result.last_report_no = told->last_report_no;
    result.last_report = std::move(told->last_report);
  }
  d.happened(std::move(result));
}

void fetching::take_failure(planning_context& d, const service_answer& answer) {
  const auto why = sentence_of(answer);
  switch (judge(answer)) {
  case judgement::gone:
    d.count_fetch_error();
    return d.happened(mission_gone{d.s.mission_id});
  case judgement::not_allowed:
    return refuse(d, refusal::not_allowed, why);
  case judgement::not_found:
    return refuse(d, refusal::not_found, why);
  case judgement::misconfigured:
    return refuse(d, refusal::misconfigured, why);
  case judgement::transient:
    break;
  default:
    return refuse(d, refusal::invalid, why, answer.body.substr(0, mission::max_document_sample));
  }
  attempt_.fail(d, d.s.mission_id, answer.retry_after_ns);
  if (attempt_.failed >= static_cast<std::uint32_t>(d.set.max_tries))
    return refuse(d, refusal::unreachable, "after " + std::to_string(attempt_.failed) + " tries: " + why);
  d.count_fetch_error();
  d.went_wrong(fetch_kind, why);
}

void fetching::refuse(planning_context& d, refusal why, std::string reason, std::string sample) {
  d.count_fetch_error();
  d.went_wrong(fetch_kind, reason);
  d.happened(fetch_failed{{d.s.mission_id, why, std::move(reason), std::move(sample)}});
}

// -- with an older journal ------------------------------------------------------------------------

void asking_progress::plan(planning_context& d) {
  const auto asked = std::ranges::find_if(d.s.missions, &mission_note::asks_progress);
  const auto id = asked == d.s.missions.end() ? std::string() : asked->mission_id;
  if (mission_id_ != id) {
    attempt_.forget(d);
    d.went_well(ask_kind);
    is_blocked_ = false;
    mission_id_ = id;
  }
  if (!mission_id_.empty() && !is_blocked_ && attempt_.may_start(d))
    attempt_.waiting = d.call(*this, get_progress(d.set, mission_id_));
}

void asking_progress::on_answer(planning_context& d, ticket number, const service_answer& answer) {
  if (!attempt_.ends_with(number))
    return;
  switch (judge(answer)) {
  case judgement::success:
    if (auto told = progress_in(answer, mission_id_); told)
      d.happened(progress_told{mission_id_, told->last_report_no, std::move(told->last_report)});
    else
      fail(d, told.error().reason, answer);
    return;
  case judgement::not_found:
  case judgement::wrong: // 405: there is no such call
    return d.happened(progress_told{mission_id_, {}, {}});
  case judgement::gone:
    return d.happened(mission_gone{mission_id_});
  case judgement::not_allowed:
    is_blocked_ = true;
    break;
  default:
    break;
  }
  fail(d, sentence_of(answer), answer);
}

void asking_progress::fail(planning_context& d, const std::string& why, const service_answer& answer) {
  attempt_.fail_without_end(d, mission_id_, answer.retry_after_ns);
  d.count_fetch_error();
  d.went_wrong(ask_kind, why);
}

// -- after a change -------------------------------------------------------------------------------

void looking_up::plan(planning_context& d) {
  if (!d.s.looks_up || mission_id_ != d.s.mission_id) {
    attempt_.forget(d);
    d.went_well(look_up_kind);
    is_blocked_ = false;
    mission_id_ = d.s.mission_id;
  }
  if (d.s.looks_up && !is_blocked_ && attempt_.may_start(d))
    attempt_.waiting = d.call(*this, get_mission(d.set, mission_id_));
}

void looking_up::on_answer(planning_context& d, ticket number, const service_answer& answer) {
  if (!attempt_.ends_with(number))
    return;
  switch (judge(answer)) {
  case judgement::success:
    if (auto mission = mission_in(answer, mission_id_); mission) {
      d.happened(mission_looked_up{mission_id_, std::move(*mission), {}});
    } else {
      d.count_fetch_error();
      d.happened(mission_looked_up{mission_id_, {}, mission.error().reason});
    }
    return;
  case judgement::gone:
    return d.happened(mission_gone{mission_id_});
  case judgement::not_found:
  case judgement::wrong:
  case judgement::conflict:
    d.count_fetch_error();
    return d.happened(mission_looked_up{mission_id_, {}, sentence_of(answer)});
  case judgement::not_allowed:
    is_blocked_ = true;
    break;
  default:
    break;
  }
  attempt_.fail_without_end(d, mission_id_, answer.retry_after_ns);
  d.count_fetch_error();
  d.went_wrong(look_up_kind, sentence_of(answer));
}

} // namespace godwit::mission_client
