#include "programs/godwitd/operator_text.hpp"

#include <cstdint>

#include "actors/domain/mission/utc_text.hpp"
#include "io/time_units.hpp"

namespace godwit::daemon {
namespace {

using json = nlohmann::json;

std::string text(const json& part, const char* key) { return part.value(key, std::string()); }

// To the second: that is as fine as people compare it.
std::string time_text(const json& row) {
  return mission::utc_text(row.value("at_ns", std::int64_t{0}) / ns_per_s * ns_per_s);
}

std::string who_text(const json& who) {
  const auto name = text(who, "name");
  const auto session = text(who, "session");
  return (name.empty() ? "nobody" : name) + " (" + (session.empty() ? "unknown" : text(who, "role") + ", " + session) +
         ")";
}

std::string row_text(const json& row) {
  auto result = time_text(row) + "  " + who_text(row.value("who", json::object())) + ": " + text(row, "what") + ": " +
                text(row, "outcome");
  if (const auto count = row.value("count", std::uint64_t{1}); count != 1)
    result += ", " + std::to_string(count) + " times";
  if (const auto reason = text(row, "reason"); !reason.empty())
    result += " (" + reason + ")";
  return result;
}

} // namespace

std::string audit_text(const json& answer) {
  std::string result;
  const auto rows = answer.value("rows", json::array());
  if (answer.value("has_older", false) && !rows.empty())
    result = "older rows: godwitd ctl audit --before " + std::to_string(rows.front().value("number", std::uint64_t{0}));
  for (const auto& row : rows)
    result += (result.empty() ? "" : "\n") + row_text(row);
  return result.empty() ? "there are no entries" : result;
}

std::string control_text(const json& answer) {
  const auto holder = text(answer, "holder");
  return holder.empty() ? "control is free" : holder + " has control";
}

std::string port_line(const json& part) {
  const auto fingerprint = text(part, "fingerprint");
  return text(part, "url") + (fingerprint.empty() ? "" : ", fingerprint " + fingerprint);
}

std::string operators_line(const json& part) {
  const auto control = part.find("control");
  std::string result = control != part.end() && control->is_object()
                           ? text(control->value("who", json::object()), "name") + " has control"
                           : "control is free";
  for (const auto& each : part.value("sessions", json::array()))
    result += ", " + who_text(each.value("who", json::object()));
  return result;
}

} // namespace godwit::daemon
