// What clients of the operator's API send, read strictly: a body that is no JSON, an unknown field, a wrong type, a
// missing part is a refusal that names the place. Pure. Thread: any.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

#include "io/http/secret_file.hpp"
#include "io/http/server/response_head.hpp"
#include "messages/failsafe/types.hpp"
#include "messages/operator_bridge/audit.hpp"
#include "messages/operator_bridge/command.hpp"
#include "messages/operator_bridge/control.hpp"
#include "messages/scan_controller/point.hpp"

namespace godwit::operator_port {

inline constexpr std::size_t max_command_body = 4 * 1024;
inline constexpr std::size_t max_login_body = 2 * 1024;

struct body_problem {
  std::string place; // "place.latitude"; empty: the whole
  std::string sentence;
};

// {"id": "a1", "command": "go_to", "valid_until": "2026-05-04T10:15:30Z", "state": "...", "place": {...}}
// An id, a deadline and a state have to be there; not the latter two for a hold, not the state for a return.
[[nodiscard]] tl::expected<operator_bridge::operator_command, body_problem> read_command(std::string_view body);

struct control_body {
  operator_bridge::control_act act = operator_bridge::control_act::take;
  std::string to;
};
// {"act": "hand_over", "to": "bob"}
[[nodiscard]] tl::expected<control_body, body_problem> read_control(std::string_view body);

// {"point": 3, "decision": "confirm"}
[[nodiscard]] tl::expected<scan_controller::decide_point, body_problem> read_decision(std::string_view body);

struct override_body {
  failsafe::override_rule wanted; // without its end
  std::uint32_t lasts_s = 0;
};
// {"rule": "operator_link", "seconds": 600, "reason": "we walk over the hill"}. How long it may last, and which rules
// can be overridden, says the failsafe.
[[nodiscard]] tl::expected<override_body, body_problem> read_override(std::string_view body);

struct login_body {
  std::string name;
  io::http::secret_text password; // one of both
  io::http::secret_text link;
};
// {"name": "anna", "password": "..."} or {"link": "..."}. What the body has is wiped.
[[nodiscard]] tl::expected<login_body, body_problem> read_login(std::string body);

// Of a header "Authorization: Bearer ..." or the cookie godwit_session; empty: there is none.
[[nodiscard]] std::string_view token_of(const io::http::server_request& asked);

// "rows" of a query such as "?rows=20": 1 to 200.
[[nodiscard]] tl::expected<operator_bridge::audit_query, body_problem> read_audit_query(std::string_view target);

} // namespace godwit::operator_port
