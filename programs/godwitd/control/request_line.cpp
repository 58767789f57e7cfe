#include "programs/godwitd/control/request_line.hpp"

#include <limits>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "io/fields/json_value.hpp"
#include "messages/mission/item_fields.hpp"
#include "messages/operator_bridge/rules.hpp"

namespace godwit::control {

using nlohmann::json;

namespace {

constexpr std::int64_t max_override_s = 3'600; // as long as the failsafe lets one last
constexpr std::uint64_t max_time_ns = std::numeric_limits<std::int64_t>::max();

std::string text_of(const json& document, const char* key) {
  const auto found = document.find(key);
  return found != document.end() && found->is_string() ? found->get<std::string>() : std::string();
}

std::string all_verbs() {
  std::string result;
  for (const auto& [kind, name] : enum_names(operators::command_kind{}))
    result += (result.empty() ? "" : ", ") + std::string(name);
  return result;
}

control_request request_of(const json& document, request_kind what) {
  control_request result;
  result.what = what;
  result.by = text_of(document, "by");
  return result;
}

std::optional<std::uint64_t> point_of(const json& document) {
  const auto found = document.find("point");
  if (found == document.end() || !found->is_number_unsigned() || found->get<std::uint64_t>() == 0)
    return std::nullopt;
  return found->get<std::uint64_t>();
}

// The point says where, and nobody but a person how high.
tl::expected<control_request, std::string> read_insert_at_point(const json& document, control_request so_far) {
  const auto point = point_of(document);
  const auto altitude = document.find("altitude_m");
  if (!point || altitude == document.end() || !altitude->is_number() || document.contains("place"))
    return tl::make_unexpected(std::string("insert at a point names the point and the altitude, such as \"point\": 3, "
                                           "\"altitude_m\": 40, and no place"));
  so_far.point = *point;
  so_far.said.place.emplace().altitude_m = altitude->get<double>();
  return so_far;
}

tl::expected<control_request, std::string> read_decision(const json& document, scan_controller::decision says) {
  auto result = request_of(document, request_kind::decide_point);
  result.decided = {point_of(document).value_or(0), says, text_of(document, "by")};
  if (result.decided.number == 0)
    return tl::make_unexpected(std::string("a decision names the point of interest, such as \"point\": 3"));
  if (result.decided.by.empty())
    return tl::make_unexpected(std::string("a decision names who made it, such as \"by\": \"anna\""));
  return result;
}

tl::expected<control_request, std::string> read_command(const json& document, operators::command_kind kind) {
  auto result = request_of(document, request_kind::command);
  result.said.kind = kind;
  if (result.by.empty())
    return tl::make_unexpected(std::string("a command to the flight names who sends it, such as \"by\": \"anna\""));
  result.said.by = result.by;
  result.said.after = text_of(document, "after");
  result.said.state = text_of(document, "state");
  result.id = text_of(document, "id");
  if (const auto until = document.find("valid_until_ns"); until != document.end()) {
    if (!until->is_number_unsigned() || until->get<std::uint64_t>() > max_time_ns)
      return tl::make_unexpected(std::string("\"valid_until_ns\" is a time in ns since 1970"));
    result.valid_until_ns = until->get<std::int64_t>();
  }
  if (kind == operators::command_kind::insert && document.contains("point"))
    return read_insert_at_point(document, std::move(result));
  if (const auto place = document.find("place"); place != document.end())
    if (const auto read = io::read_json(*place, result.said.place.emplace(), "place"); !read)
      return tl::make_unexpected("the place can not be read: " + read.error().message());
  if ((kind == operators::command_kind::go_to || kind == operators::command_kind::insert) && !result.said.place)
    return tl::make_unexpected(std::string(
        "a place is missing, such as \"place\": {\"latitude\": 47.398, \"longitude\": 8.546, \"altitude_m\": 40}"));
  if (kind != operators::command_kind::acknowledge)
    return result;
  const auto report = document.find("report");
  if (report == document.end() || !report->is_number_unsigned() ||
      report->get<std::uint64_t>() > std::numeric_limits<std::uint32_t>::max())
    return tl::make_unexpected(std::string("acknowledge names the preflight report, such as \"report\": 1"));
  result.said.report = report->get<std::uint32_t>();
  return result;
}

tl::expected<control_request, std::string> read_override(const json& document) {
  const auto rule = io::value_of<failsafe::rule>(text_of(document, "rule"));
  if (!rule)
    return tl::make_unexpected(std::string("the rule is operator_link, battery_low, fence or battery_critical"));
  const auto seconds = document.find("seconds");
  // A number beyond the signed ones is unsigned to the reader, and would be cut.
  const bool is_number = seconds != document.end() && seconds->is_number_integer();
  const bool is_too_large = is_number && seconds->is_number_unsigned() &&
                            seconds->get<std::uint64_t>() > static_cast<std::uint64_t>(max_override_s);
  if (!is_number || is_too_large || seconds->get<std::int64_t>() <= 0)
    return tl::make_unexpected("\"seconds\" is for how long: 1 to " + std::to_string(max_override_s));
  auto result = request_of(document, request_kind::override_rule);
  result.overridden.scope = *rule;
  result.overridden.reason = result.by + ": " + text_of(document, "reason");
  result.lasts_s = seconds->get<std::int64_t>();
  return result;
}

tl::expected<control_request, std::string> read_control(const json& document) {
  const auto act = io::value_of<operator_bridge::control_act>(text_of(document, "act"));
  if (!act)
    return tl::make_unexpected(std::string("\"act\" is take, take_over, give or hand_over"));
  auto result = request_of(document, request_kind::control);
  result.act = *act;
  result.to = text_of(document, "to");
  if (!operator_bridge::names_whom_it_needs(*act, result.to))
    return tl::make_unexpected(std::string(result.to.empty() ? "hand_over needs a receiver, such as \"to\": \"bob\""
                                                             : "only hand_over has a receiver"));
  return result;
}

// None: it is there, and no number from 0 on that the journal can have.
std::optional<std::uint64_t> number_of(const json& document, const char* name, std::uint64_t usual) {
  const auto found = document.find(name);
  if (found == document.end())
    return usual;
  constexpr std::uint64_t most = std::numeric_limits<std::int64_t>::max();
  if (!found->is_number_unsigned() || found->get<std::uint64_t>() > most)
    return std::nullopt;
  return found->get<std::uint64_t>();
}

tl::expected<control_request, std::string> read_audit(const json& document) {
  auto result = request_of(document, request_kind::audit);
  const auto rows = number_of(document, "rows", result.rows);
  const auto before = number_of(document, "before", 0);
  if (!rows || *rows == 0 || *rows > operator_bridge::max_audit_page)
    return tl::make_unexpected("\"rows\" is 1 to " + std::to_string(operator_bridge::max_audit_page));
  if (!before)
    return tl::make_unexpected("\"before\" is the number of a row");
  result.rows = static_cast<std::uint32_t>(*rows);
  result.before = *before;
  return result;
}

control_request with_key(const json& document, request_kind what, const char* key) {
  auto result = request_of(document, what);
  result.key = text_of(document, key);
  return result;
}

tl::expected<control_request, std::string> read_login(const json& document) {
  constexpr std::size_t sha256_digits = 64;
  auto result = with_key(document, request_kind::login, "link_hash");
  if (result.key.size() != sha256_digits || result.key.find_first_not_of("0123456789abcdef") != std::string::npos)
    return tl::make_unexpected(std::string("\"link_hash\" is the SHA-256 of the link, 64 hexadecimal digits"));
  return result;
}

tl::expected<control_request, std::string> read_sign(const json& document) {
  auto result = request_of(document, request_kind::sign);
  if (result.by.empty())
    return tl::make_unexpected(std::string("sign names who sends it, such as \"by\": \"anna\""));
  if (const auto off = document.find("off"); off != document.end()) {
    if (!off->is_boolean())
      return tl::make_unexpected(std::string("\"off\" is true or false"));
    result.ends_signing = off->get<bool>();
  }
  return result;
}

} // namespace

tl::expected<control_request, std::string> read_request(std::string_view line) {
  const auto document = json::parse(line, nullptr, false);
  if (!document.is_object())
    return tl::make_unexpected(std::string("a request is a JSON object on one line, such as {\"do\": \"status\"}"));
  const auto what = text_of(document, "do");
  if (const auto kind = io::value_of<operators::command_kind>(what))
    return read_command(document, *kind);
  if (what == "status")
    return control_request{};
  if (what == "outbox_retry")
    return with_key(document, request_kind::outbox_retry, "key");
  if (what == "override")
    return read_override(document);
  if (what == "crash")
    return with_key(document, request_kind::crash, "actor");
  if (what == "rescue_journal")
    return request_of(document, request_kind::rescue_journal);
  if (what == "control")
    return read_control(document);
  if (what == "audit")
    return read_audit(document);
  if (what == "login")
    return read_login(document);
  if (what == "sign")
    return read_sign(document);
  if (what == "points")
    return request_of(document, request_kind::points);
  if (const auto says = io::value_of<scan_controller::decision>(what))
    return read_decision(document, *says);
  return tl::make_unexpected("\"do\" is status, audit, control, login, sign, outbox_retry, override, points, "
                             "confirm, decline, rescue_journal, crash, "
                             "or a command to the flight: " +
                             all_verbs());
}

std::string refusal_line(const std::string& sentence) {
  return json{{"ok", false}, {"error", sentence}}.dump(-1, ' ', false, json::error_handler_t::replace);
}

} // namespace godwit::control
