#include "programs/godwitd/control/request_line.hpp"

#include <nlohmann/json.hpp>

namespace godwit::control {

using nlohmann::json;

namespace {

std::string text_of(const json& document, const char* key) {
  const auto found = document.find(key);
  return found != document.end() && found->is_string() ? found->get<std::string>() : std::string();
}

std::string all_verbs() {
  std::string result;
  for (const auto& [verb, name] : enum_names(operator_words::verb{}))
    result += (result.empty() ? "" : ", ") + std::string(name);
  return result;
}

tl::expected<control_request, std::string> read_word(const json& document, operator_words::verb verb) {
  control_request result;
  result.what = request_kind::word;
  result.said.verb = verb;
  result.said.by = text_of(document, "by");
  if (result.said.by.empty())
    return tl::make_unexpected(std::string("a word to the flight says whose it is, such as \"by\": \"anna\""));
  if (verb != operator_words::verb::acknowledge)
    return result;
  const auto report = document.find("report");
  if (report == document.end() || !report->is_number_unsigned())
    return tl::make_unexpected(std::string("acknowledge names the preflight report, such as \"report\": 1"));
  result.said.report = report->get<std::uint32_t>();
  return result;
}

} // namespace

tl::expected<control_request, std::string> read_request(std::string_view line) {
  const auto document = json::parse(line, nullptr, false);
  if (!document.is_object())
    return tl::make_unexpected(std::string("a request is a JSON object on one line, such as {\"do\": \"status\"}"));
  const auto what = text_of(document, "do");
  if (const auto verb = io::value_of<operator_words::verb>(what))
    return read_word(document, *verb);
  if (what == "status")
    return control_request{};
  if (what == "outbox_retry")
    return control_request{0, request_kind::outbox_retry, text_of(document, "key"), {}};
  if (what == "crash")
    return control_request{0, request_kind::crash, text_of(document, "actor"), {}};
  return tl::make_unexpected("\"do\" is status, outbox_retry, crash, or a word to the flight: " + all_verbs());
}

std::string refusal_line(const std::string& sentence) {
  return json{{"ok", false}, {"error", sentence}}.dump(-1, ' ', false, json::error_handler_t::replace);
}

} // namespace godwit::control
