#include "programs/godwitd/operator_port/api_answers.hpp"

#include "actors/domain/mission/utc_text.hpp"
#include "io/fields/json_text.hpp"
#include "io/http/server/response_head.hpp"

namespace godwit::operator_port {

using io::http::server_response;
using nlohmann::json;
using operator_bridge::verdict;

namespace {

json problem_document(unsigned status, const std::string& detail) {
  return {{"type", "about:blank"}, {"title", io::http::reason_phrase(status)}, {"status", status}, {"detail", detail}};
}

server_response as_problem(unsigned status, const json& document) {
  auto result = json_answer(status, document);
  result.content_type = io::http::problem_type;
  return result;
}

json json_of(const operators::principal& who) {
  return {{"name", who.name}, {"role", io::name_of(who.role)}, {"session", who.session}};
}

} // namespace

server_response json_answer(unsigned status, const json& document) {
  return {status, "application/json", document.dump(-1, ' ', false, json::error_handler_t::replace), {}};
}

server_response problem(unsigned status, const std::string& detail, const std::string& place) {
  auto document = problem_document(status, detail);
  if (!place.empty())
    document["place"] = place;
  auto result = as_problem(status, document);
  if (status == 401)
    result.headers.push_back({"WWW-Authenticate", "Bearer realm=\"godwit\""});
  return result;
}

unsigned status_of(verdict which) {
  switch (which) {
  case verdict::taken:
    return 200;
  case verdict::no_session:
    return 401;
  case verdict::wrong_role:
    return 403;
  case verdict::late:
    return 408;
  case verdict::refused:
  case verdict::superseded:
    return 409;
  case verdict::stale:
    return 412;
  case verdict::id_used:
    return 422;
  case verdict::no_control:
    return 423;
  case verdict::busy:
  case verdict::not_done:
    return 503;
  case verdict::unknown:
    break;
  }
  return 504;
}

server_response answer_of(const std::string& id, const operator_bridge::command_answer& answer) {
  const auto status = status_of(answer.verdict);
  auto document = answer.verdict == verdict::taken ? json::object() : problem_document(status, answer.reason);
  if (!id.empty())
    document["id"] = id;
  document["verdict"] = io::name_of(answer.verdict);
  if (!answer.state.empty())
    document["state"] = answer.state;
  if (answer.verdict == verdict::taken && !answer.reason.empty())
    document["advice"] = answer.reason;
  return answer.verdict == verdict::taken ? json_answer(status, document) : as_problem(status, document);
}

server_response answer_of(const operators::principal& who, std::int64_t ends_ns, std::int64_t wall_ns,
                          unsigned status) {
  auto document = json_of(who);
  document["now"] = mission::utc_text(wall_ns);
  if (ends_ns != 0)
    document["ends"] = mission::utc_text(ends_ns);
  return json_answer(status, document);
}

server_response answer_of(const operator_bridge::control_answer& answer) {
  if (!answer.is_done) {
    auto document = problem_document(409, answer.reason);
    document["holder"] = answer.holder;
    return as_problem(409, document);
  }
  return json_answer(200, {{"holder", answer.holder}});
}

server_response answer_of(const operator_bridge::operators_view& view, const operators::principal& who) {
  json document{{"holder", view.control ? view.control->who.name : std::string()},
                {"is_yours", view.control && view.control->who == who}};
  if (view.control)
    document["since"] = mission::utc_text(view.control->since_ns);
  return json_answer(200, document);
}

server_response answer_of(const operator_bridge::audit_page& page) {
  json rows = json::array();
  for (const auto& each : page.rows)
    rows.push_back({{"number", each.number},
                    {"at", mission::utc_text(each.at_ns)},
                    {"who", json_of(each.who)},
                    {"what", each.what},
                    {"id", each.id},
                    {"outcome", each.outcome},
                    {"reason", each.reason},
                    {"count", each.count}});
  return json_answer(200, {{"rows", std::move(rows)}, {"has_older", page.has_older}});
}

server_response answer_of(const telemetry_stream::points_update& seen) {
  return {200, "application/json", io::to_json(seen), {}};
}

} // namespace godwit::operator_port
