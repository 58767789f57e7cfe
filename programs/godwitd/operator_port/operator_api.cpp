#include "programs/godwitd/operator_port/operator_api.hpp"

#include <utility>

#include "programs/godwitd/accounts/password.hpp"
#include "programs/godwitd/operator_port/api_answers.hpp"

namespace godwit::operator_port {

using io::http::responder;
using io::http::server_request;

namespace {

bool is_json(const server_request& asked) {
  const auto type = asked.find("Content-Type");
  return type == "application/json" || type.starts_with("application/json;");
}

bool refuse_form(const server_request& asked, responder& answer) {
  if (is_json(asked))
    return false;
  answer.send(problem(415, "the body is application/json"));
  return true;
}

io::http::server_response too_many_log_in() {
  return problem(429, "too many log in at once; try again in a few seconds");
}

void refuse(responder& answer, const body_problem& why) { answer.send(problem(400, why.sentence, why.place)); }

} // namespace

operator_api::operator_api(std::shared_ptr<waiting_answers> answers, accounts::account_keeper& keeper, inlet tell)
    : answers_(std::move(answers)), keeper_(keeper), tell_(std::move(tell)) {}

void operator_api::tell(api_request asked, const server_request& from, responder answer) {
  const auto token = token_of(from);
  asked.token_hash = token.empty() ? std::string() : accounts::hash_of_token(token);
  asked.from = from.from;
  if (const auto ticket = answers_->add(std::move(answer), io::http::secret_text(), from.place)) {
    asked.ticket = *ticket;
    tell_(std::move(asked));
  }
}

void operator_api::ask(api_act what, const server_request& asked, responder answer) {
  api_request wanted;
  wanted.what = what;
  tell(std::move(wanted), asked, std::move(answer));
}

void operator_api::admit(const server_request& asked, responder answer, std::function<void(responder)> then) {
  answer.keep_unread(); // it may want to become a WebSocket
  api_request wanted;
  wanted.what = api_act::look;
  const auto token = token_of(asked);
  if (token.empty())
    return answer.send(problem(401, "from another computer log in first, or send a token"));
  wanted.token_hash = accounts::hash_of_token(token);
  wanted.from = asked.from;
  if (const auto ticket = answers_->add(std::move(answer), std::move(then), asked.place)) {
    wanted.ticket = *ticket;
    tell_(std::move(wanted));
  }
}

void operator_api::note_other_origin(const std::string& from) {
  api_request wanted;
  wanted.what = api_act::refuse_origin;
  wanted.from = from;
  tell_(std::move(wanted));
}

void operator_api::command(const server_request& asked, responder answer) {
  if (refuse_form(asked, answer))
    return;
  auto said = read_command(asked.body);
  if (!said)
    return refuse(answer, said.error());
  api_request wanted;
  wanted.what = api_act::command;
  wanted.said = *std::move(said);
  tell(std::move(wanted), asked, std::move(answer));
}

void operator_api::change_control(const server_request& asked, responder answer) {
  if (refuse_form(asked, answer))
    return;
  auto said = read_control(asked.body);
  if (!said)
    return refuse(answer, said.error());
  api_request wanted;
  wanted.what = api_act::change_control;
  wanted.act = said->act;
  wanted.to = std::move(said->to);
  tell(std::move(wanted), asked, std::move(answer));
}

void operator_api::decide_point(const server_request& asked, responder answer) {
  if (refuse_form(asked, answer))
    return;
  auto said = read_decision(asked.body);
  if (!said)
    return refuse(answer, said.error());
  api_request wanted;
  wanted.what = api_act::decide_point;
  wanted.decided = *std::move(said);
  tell(std::move(wanted), asked, std::move(answer));
}

void operator_api::override_rule(const server_request& asked, responder answer) {
  if (refuse_form(asked, answer))
    return;
  auto said = read_override(asked.body);
  if (!said)
    return refuse(answer, said.error());
  api_request wanted;
  wanted.what = api_act::override_rule;
  wanted.overridden = std::move(said->wanted);
  wanted.lasts_s = said->lasts_s;
  tell(std::move(wanted), asked, std::move(answer));
}

void operator_api::read_audit(const server_request& asked, responder answer) {
  const auto page = read_audit_query(asked.target);
  if (!page)
    return refuse(answer, page.error());
  api_request wanted;
  wanted.what = api_act::read_audit;
  wanted.rows = page->most;
  wanted.before = page->before;
  tell(std::move(wanted), asked, std::move(answer));
}

void operator_api::log_in(server_request asked, responder answer) {
  if (refuse_form(asked, answer))
    return;
  auto said = read_login(std::move(asked.body));
  if (!said)
    return refuse(answer, said.error());
  if (said->link.empty())
    check_password(*std::move(said), asked.from, std::move(answer));
  else
    use_link(*std::move(said), asked.from, std::move(answer));
}

void operator_api::use_link(login_body said, const std::string& from, responder answer) {
  api_request wanted;
  wanted.what = api_act::use_link;
  wanted.from = from;
  wanted.link_hash = accounts::hash_of_token(said.link.revealed());
  auto token = accounts::new_token();
  wanted.new_token_hash = accounts::hash_of_token(token.revealed());
  if (const auto ticket = answers_->add(std::move(answer), std::move(token))) {
    wanted.ticket = *ticket;
    tell_(std::move(wanted));
  }
}

// Judged in the keeper's thread; a name that is not there is answered as a wrong password is.
void operator_api::check_password(login_body said, const std::string& from, responder answer) {
  auto token = accounts::new_token();
  auto token_hash = accounts::hash_of_token(token.revealed());
  const auto waiting =
      std::make_shared<std::pair<responder, io::http::secret_text>>(std::move(answer), std::move(token));
  const auto name = said.name;
  const bool is_taken = keeper_.check(
      {std::move(said.name), std::move(said.password), from},
      [answers = answers_, tell = tell_, waiting, name, from, token_hash](accounts::account_keeper::verdict who) {
        api_request wanted;
        wanted.from = from;
        if (!who && who.error() == accounts::account_keeper::refusal::gave_way) {
          waiting->first.send(too_many_log_in());
          return;
        }
        if (!who) {
          wanted.what = api_act::refuse_login;
          wanted.account.name = name;
          tell(std::move(wanted));
          waiting->first.send(problem(401, "the name or the password is wrong"));
          return;
        }
        wanted.what = api_act::open_session;
        wanted.account = *std::move(who);
        wanted.new_token_hash = token_hash;
        if (const auto ticket = answers->add(std::move(waiting->first), std::move(waiting->second))) {
          wanted.ticket = *ticket;
          tell(std::move(wanted));
        }
      });
  if (!is_taken)
    waiting->first.send(too_many_log_in());
}

namespace {

constexpr std::string_view session_path = "/api/v1/session";
constexpr std::string_view commands_path = "/api/v1/commands";
constexpr std::string_view control_path = "/api/v1/control";
constexpr std::string_view audit_path = "/api/v1/audit";
constexpr std::string_view points_path = "/api/v1/points";
constexpr std::string_view overrides_path = "/api/v1/overrides";

} // namespace

route_list routes_of(const std::shared_ptr<operator_api>& api) {
  const auto plain = [api](api_act what) {
    return [api, what](const server_request& asked, responder answer) { api->ask(what, asked, std::move(answer)); };
  };
  // Each looks after the session itself.
  route_list all{
      {"POST", session_path, max_login_body,
       [api](server_request asked, responder answer) { api->log_in(std::move(asked), std::move(answer)); }},
      {"GET", session_path, 0, plain(api_act::who_am_i)},
      {"DELETE", session_path, 0, plain(api_act::log_out)},
      {"POST", commands_path, max_command_body,
       [api](const server_request& asked, responder answer) { api->command(asked, std::move(answer)); }},
      {"GET", control_path, 0, plain(api_act::view_control)},
      {"POST", control_path, max_command_body,
       [api](const server_request& asked, responder answer) { api->change_control(asked, std::move(answer)); }},
      {"GET", points_path, 0, plain(api_act::list_points)},
      {"POST", points_path, max_command_body,
       [api](const server_request& asked, responder answer) { api->decide_point(asked, std::move(answer)); }},
      {"POST", overrides_path, max_command_body,
       [api](const server_request& asked, responder answer) { api->override_rule(asked, std::move(answer)); }},
      {"GET", audit_path, 0,
       [api](const server_request& asked, responder answer) { api->read_audit(asked, std::move(answer)); }}};
  for (auto& each : all)
    each.who = access::open;
  return all;
}

} // namespace godwit::operator_port
