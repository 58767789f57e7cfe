#include "runtime/trace/reading/record_parser.hpp"

#include <charconv>
#include <optional>

#include <nlohmann/json.hpp>

namespace godwit::runtime {

namespace {

// Reads what stands next, in the one order and form that the renderer writes.
class cursor {
public:
  explicit cursor(std::string_view text) : rest_(text) {}

  bool skip(std::string_view expected) {
    if (!rest_.starts_with(expected))
      return false;
    rest_.remove_prefix(expected.size());
    return true;
  }
  template <class N>
  bool number(std::string_view before, N& to) {
    if (!skip(before))
      return false;
    const auto [end, code] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), to);
    if (code != std::errc())
      return false;
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return true;
  }
  bool text(std::string_view before, std::string_view& to) {
    if (!skip(before))
      return false;
    const auto end = rest_.find_first_of("\"\\");
    if (end == std::string_view::npos || rest_[end] == '\\')
      return false;
    to = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return true;
  }
  [[nodiscard]] std::string_view rest() const { return rest_; }

private:
  std::string_view rest_;
};

std::optional<outcome> outcome_named(std::string_view name) {
  if (name == "handled") // nearly all
    return outcome::handled;
  for (const auto& [value, text] : enum_names(outcome{}))
    if (text == name)
      return value;
  return std::nullopt;
}

bool parse_rendered(std::string_view text, record_fields& to) {
  cursor at(text);
  std::string_view how;
  if (!at.number(R"({"id":)", to.id) || !at.number(R"(,"cause":)", to.cause) || !at.text(R"(,"actor":")", to.actor) ||
      !at.number(R"(,"incarnation":)", to.incarnation) || !at.text(R"(,"sender":")", to.sender) ||
      !at.number(R"(,"duration_ns":)", to.duration_ns))
    return false;
  to.clock_offset_ns = 0;
  to.wall_offset_ns = 0;
  (void)(at.number(R"(,"clock_offset_ns":)", to.clock_offset_ns) &&
         at.number(R"(,"wall_offset_ns":)", to.wall_offset_ns)); // older traces have none
  if (!at.text(R"(,"outcome":")", how))
    return false;
  const auto named = outcome_named(how);
  if (!named)
    return false;
  to.how = *named;
  to.oversize = at.rest() == R"(,"oversize":true})";
  to.body = {};
  if (to.oversize)
    return true;
  if (!at.skip(R"(,"message":)") || !at.rest().ends_with('}') || at.rest().size() < 2)
    return false;
  to.body = at.rest().substr(0, at.rest().size() - 1);
  return true;
}

template <class N>
bool take(const nlohmann::json& from, const char* name, N& to) {
  const auto found = from.find(name);
  if (found == from.end() || !found->is_number_integer())
    return false;
  to = found->get<N>();
  return true;
}

bool take(const nlohmann::json& from, const char* name, std::string& to) {
  const auto found = from.find(name);
  if (found == from.end() || !found->is_string())
    return false;
  to = found->get<std::string>();
  return true;
}

} // namespace

bool record_parser::parse(std::string_view text, record_fields& to) {
  return parse_rendered(text, to) || parse_any(text, to);
}

bool record_parser::parse_any(std::string_view text, record_fields& to) {
  const auto document = nlohmann::json::parse(text, nullptr, false);
  std::string how;
  if (!document.is_object() || !take(document, "id", to.id) || !take(document, "cause", to.cause) ||
      !take(document, "actor", actor_) || !take(document, "incarnation", to.incarnation) ||
      !take(document, "sender", sender_) || !take(document, "duration_ns", to.duration_ns) ||
      !take(document, "outcome", how))
    return false;
  const auto named = outcome_named(how);
  if (!named)
    return false;
  to.clock_offset_ns = 0;
  to.wall_offset_ns = 0;
  (void)(take(document, "clock_offset_ns", to.clock_offset_ns) && take(document, "wall_offset_ns", to.wall_offset_ns));
  to.how = *named;
  to.actor = actor_;
  to.sender = sender_;
  to.oversize = document.value("oversize", nlohmann::json()) == true;
  const auto body = document.find("message");
  body_ = body == document.end() ? std::string() : body->dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  to.body = body_;
  return true;
}

} // namespace godwit::runtime
