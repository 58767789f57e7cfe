#include "actors/mission_client/judgement.hpp"

#include "actors/domain/mission/read.hpp"
#include "actors/mission_client/outbox/outbox.hpp"

namespace godwit::mission_client {

namespace {

judgement judge_status(unsigned status) {
  switch (status) {
  case 401:
  case 403:
    return judgement::not_allowed;
  case 404:
    return judgement::not_found;
  case 408:
  case 429:
    return judgement::transient;
  case 409:
    return judgement::conflict;
  case 410:
    return judgement::gone;
  default:
    break;
  }
  if (status >= 500)
    return judgement::transient;
  if (status >= 400)
    return judgement::wrong;
  return status >= 300 ? judgement::misconfigured : status >= 200 ? judgement::success : judgement::bad_answer;
}

std::string sentence_of_problem(const service_answer& answer) {
  auto result = "the service answered " + std::to_string(answer.status);
  const auto problem = mission::read<mission::problem>(answer.body);
  if (!problem)
    return result;
  result += " " + problem->title;
  if (problem->detail)
    result += ": " + *problem->detail;
  for (const auto& each : problem->errors)
    result += " " + each.pointer + " " + each.detail + ".";
  return result;
}

} // namespace

judgement judge(const service_answer& answer) {
  switch (answer.how) {
  case ending::answered:
    return judge_status(answer.status);
  case ending::page_begun: // is no end, and never judged
  case ending::not_reached:
    return judgement::transient;
  case ending::misconfigured:
    return judgement::misconfigured;
  case ending::no_picture:
    return judgement::wrong;
  case ending::bad_answer:
    break;
  }
  return judgement::bad_answer;
}

std::string sentence_of(const service_answer& answer) {
  return cut_error(answer.how == ending::answered ? sentence_of_problem(answer) : answer.error);
}

} // namespace godwit::mission_client
