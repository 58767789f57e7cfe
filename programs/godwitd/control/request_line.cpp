#include "programs/godwitd/control/request_line.hpp"

#include <limits>

#include <nlohmann/json.hpp>

#include "io/fields/json_value.hpp"
#include "messages/mission/item_fields.hpp"

namespace godwit::control {

using nlohmann::json;

namespace {

constexpr std::int64_t max_override_s = 3'600; // as long as the failsafe lets one last

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

tl::expected<control_request, std::string> read_command(const json& document, operators::command_kind kind) {
  control_request result;
  result.what = request_kind::command;
  result.said.kind = kind;
  result.said.by = text_of(document, "by");
  if (result.said.by.empty())
    return tl::make_unexpected(std::string("a command to the flight says whose it is, such as \"by\": \"anna\""));
  result.said.after = text_of(document, "after");
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
    return tl::make_unexpected("\"seconds\" says for how long: 1 to " + std::to_string(max_override_s));
  control_request result;
  result.what = request_kind::override_rule;
  result.overridden.scope = *rule;
  result.overridden.reason = text_of(document, "by") + ": " + text_of(document, "reason");
  result.lasts_s = seconds->get<std::int64_t>();
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
    return control_request{0, request_kind::outbox_retry, text_of(document, "key"), {}, {}, 0};
  if (what == "override")
    return read_override(document);
  if (what == "crash")
    return control_request{0, request_kind::crash, text_of(document, "actor"), {}, {}, 0};
  if (what == "rescue_journal")
    return control_request{0, request_kind::rescue_journal, {}, {}, {}, 0};
  return tl::make_unexpected(
      "\"do\" is status, outbox_retry, override, rescue_journal, crash, or a command to the flight: " + all_verbs());
}

std::string refusal_line(const std::string& sentence) {
  return json{{"ok", false}, {"error", sentence}}.dump(-1, ' ', false, json::error_handler_t::replace);
}

} // namespace godwit::control
