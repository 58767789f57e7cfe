#include "programs/godwitd/operator_port/request_body.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>
#include <openssl/crypto.h>

#include "actors/domain/mission/utc_text.hpp"
#include "io/fields/json_value.hpp"
#include "io/text.hpp"
#include "messages/mission/item_fields.hpp"
#include "messages/operator_bridge/rules.hpp"

namespace godwit::operator_port {
namespace {

using nlohmann::json;
using operators::command_kind;

constexpr std::uint64_t max_row = std::numeric_limits<std::int64_t>::max();

// As it stands in the body.
struct command_body {
  std::string id;
  std::optional<operators::command_kind> command;
  std::string valid_until;
  std::string state;
  std::uint32_t report = 0;
  std::optional<mission::position> place;
  std::string after;
  GODWIT_FIELDS(command_body, "operator_port.command", id, command, valid_until, state, report, place, after);
};

struct control_fields {
  std::optional<operator_bridge::control_act> act;
  std::string to;
  GODWIT_FIELDS(control_fields, "operator_port.control", act, to);
};

struct decision_body {
  std::uint64_t point = 0;
  std::optional<scan_controller::decision> decision;
  GODWIT_FIELDS(decision_body, "operator_port.decision", point, decision);
};

struct override_fields {
  std::optional<failsafe::rule> rule;
  std::uint32_t seconds = 0;
  std::string reason;
  GODWIT_FIELDS(override_fields, "operator_port.override", rule, seconds, reason);
};

tl::unexpected<body_problem> wrong(std::string place, std::string sentence) {
  return tl::make_unexpected(body_problem{std::move(place), std::move(sentence)});
}

template <class Body>
tl::expected<Body, body_problem> read_body(std::string_view text) {
  const auto document = json::parse(text, nullptr, false);
  if (!document.is_object())
    return wrong({}, "the body is a JSON object");
  Body result;
  if (const auto read = io::read_json(document, result); !read)
    return wrong(read.error().path, read.error().message());
  return result;
}

bool needs_state(command_kind kind) {
  return !operators::is_stop(kind) && kind != command_kind::check && kind != command_kind::pull;
}

// Text that is overwritten when nobody needs it any more.
class wiped {
public:
  explicit wiped(std::string& text) : text_(text) {}
  ~wiped() { OPENSSL_cleanse(text_.data(), text_.size()); }
  wiped(const wiped&) = delete;
  wiped& operator=(const wiped&) = delete;

private:
  std::string& text_;
};

io::http::secret_text secret_of(const std::string& text) {
  io::http::secret_text result(text.size());
  std::ranges::copy(text, result.data());
  return result;
}

} // namespace

tl::expected<operator_bridge::operator_command, body_problem> read_command(std::string_view text) {
  auto body = read_body<command_body>(text);
  if (!body)
    return tl::make_unexpected(std::move(body.error()));
  if (!body->command)
    return wrong("command", "a command is missing, such as \"start\"");
  const auto kind = *body->command;
  operator_bridge::operator_command result;
  if (body->id.empty())
    return wrong("id", "an id is missing: another one for each command that is meant, the same when it is sent again");
  if (body->valid_until.empty() && kind != command_kind::pause)
    return wrong("valid_until", "a time is missing, such as 2026-05-04T10:15:30Z: later it is not executed");
  if (!body->valid_until.empty()) {
    const auto until = mission::time_of_utc_text(body->valid_until);
    if (!until || *until <= 0)
      return wrong("valid_until", "this is no time in UTC, such as 2026-05-04T10:15:30Z");
    result.valid_until_ns = *until;
  }
  if (body->state.empty() && needs_state(kind))
    return wrong("state", "the state that it is meant for is missing, as the flight's status has it");
  if (!body->place && (kind == command_kind::go_to || kind == command_kind::insert))
    return wrong("place", "a place is missing");
  if (body->report == 0 && kind == command_kind::acknowledge)
    return wrong("report", "the number of the preflight report is missing");
  result.id = std::move(body->id);
  result.what.kind = kind;
  result.what.state = std::move(body->state);
  result.what.report = body->report;
  result.what.place = body->place;
  result.what.after = std::move(body->after);
  return result;
}

tl::expected<control_body, body_problem> read_control(std::string_view text) {
  auto body = read_body<control_fields>(text);
  if (!body)
    return tl::make_unexpected(std::move(body.error()));
  if (!body->act)
    return wrong("act", "take, take_over, give or hand_over is missing");
  if (!operator_bridge::names_whom_it_needs(*body->act, body->to))
    return wrong("to", body->to.empty() ? "to whom is missing" : "only hand_over has a receiver");
  return control_body{*body->act, std::move(body->to)};
}

tl::expected<scan_controller::decide_point, body_problem> read_decision(std::string_view text) {
  auto body = read_body<decision_body>(text);
  if (!body)
    return tl::make_unexpected(std::move(body.error()));
  if (body->point == 0)
    return wrong("point", "the number of the point is missing");
  if (!body->decision)
    return wrong("decision", "confirm or decline is missing");
  return scan_controller::decide_point{body->point, *body->decision, {}};
}

tl::expected<override_body, body_problem> read_override(std::string_view text) {
  auto body = read_body<override_fields>(text);
  if (!body)
    return tl::make_unexpected(std::move(body.error()));
  if (!body->rule)
    return wrong("rule", "the rule is missing, such as \"operator_link\"");
  if (body->seconds == 0)
    return wrong("seconds", "for how many seconds is missing");
  if (io::trimmed(body->reason).empty())
    return wrong("reason", "a reason is missing: it stands in the audit");
  return override_body{{*body->rule, std::move(body->reason), 0}, body->seconds};
}

tl::expected<login_body, body_problem> read_login(std::string text) {
  const wiped all(text);
  auto document = json::parse(text, nullptr, false);
  if (!document.is_object())
    return wrong({}, "the body is a JSON object");
  login_body result;
  for (auto& [key, value] : document.items()) {
    if (!value.is_string())
      return wrong(key, "a text is expected");
    auto& said = value.get_ref<std::string&>();
    const wiped each(said);
    if (key == "name")
      result.name = said;
    else if (key == "password")
      result.password = secret_of(said);
    else if (key == "link")
      result.link = secret_of(said);
    else
      return wrong(key, "this field is not known; there are name and password, or link");
  }
  if (!result.link.empty() && result.name.empty() && result.password.empty())
    return result;
  if (!result.link.empty() || result.name.empty() || result.password.empty())
    return wrong({}, "either name and password, or link");
  return result;
}

std::string_view token_of(const io::http::server_request& asked) {
  constexpr std::string_view bearer = "Bearer ";
  if (const auto said = asked.find("Authorization"); said.starts_with(bearer))
    return io::trimmed(said.substr(bearer.size()));
  constexpr std::string_view name = "godwit_session=";
  auto cookies = asked.find("Cookie");
  while (!cookies.empty()) {
    const auto end = std::min(cookies.find(';'), cookies.size());
    const auto each = io::trimmed(cookies.substr(0, end));
    if (each.starts_with(name))
      return each.substr(name.size());
    cookies.remove_prefix(std::min(end + 1, cookies.size()));
  }
  return {};
}

tl::expected<operator_bridge::audit_query, body_problem> read_audit_query(std::string_view target) {
  operator_bridge::audit_query result;
  const auto query = target.find('?');
  auto rest = query == std::string_view::npos ? std::string_view() : target.substr(query + 1);
  bool has_rows = false;
  bool has_before = false;
  while (!rest.empty()) {
    const auto end = std::min(rest.find('&'), rest.size());
    const auto each = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (each.starts_with("rows=") && !std::exchange(has_rows, true) && io::read_number(each.substr(5), result.most) &&
        result.most >= 1 && result.most <= operator_bridge::max_audit_page)
      continue;
    if (each.starts_with("before=") && !std::exchange(has_before, true) &&
        io::read_number(each.substr(7), result.before) && result.before <= max_row)
      continue;
    return wrong("rows", "the query is rows=1 to rows=" + std::to_string(operator_bridge::max_audit_page) +
                             ", and before=N for rows with smaller numbers than N");
  }
  return result;
}

} // namespace godwit::operator_port
