#include "programs/godwitd/control/request_line.hpp"

#include <nlohmann/json.hpp>

namespace godwit::control {

using nlohmann::json;

namespace {

std::string text_of(const json& document, const char* key) {
  const auto found = document.find(key);
  return found != document.end() && found->is_string() ? found->get<std::string>() : std::string();
}

} // namespace

tl::expected<control_request, std::string> read_request(std::string_view line) {
  const auto document = json::parse(line, nullptr, false);
  if (!document.is_object())
    return tl::make_unexpected(std::string("a request is a JSON object on one line, such as {\"do\": \"status\"}"));
  const auto what = text_of(document, "do");
  if (what == "start")
    return tl::make_unexpected(std::string("this godwitd does not fly missions yet: nothing is armed or started"));
  const auto kind = io::value_of<request_kind>(what);
  if (!kind)
    return tl::make_unexpected(std::string("\"do\" is status or outbox_retry"));
  return control_request{0, *kind, text_of(document, "key")};
}

std::string refusal_line(const std::string& sentence) {
  return json{{"ok", false}, {"error", sentence}}.dump(-1, ' ', false, json::error_handler_t::replace);
}

} // namespace godwit::control
