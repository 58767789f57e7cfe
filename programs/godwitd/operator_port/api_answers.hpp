// What the operator's API answers, as JSON; refusals as problem documents with a `verdict`. Pure. Thread: any.
// Source: RFC 9457.
#pragma once

#include <cstdint>
#include <string>

#include <nlohmann/json.hpp>

#include "actors/telemetry_stream/core.hpp"
#include "io/http/server/response_head.hpp"
#include "messages/operator_bridge/audit.hpp"
#include "messages/operator_bridge/command.hpp"
#include "messages/operator_bridge/control.hpp"
#include "messages/operator_bridge/session.hpp"

namespace godwit::operator_port {

[[nodiscard]] io::http::server_response json_answer(unsigned status, const nlohmann::json& document);
// PLACE: of the body, such as "place.latitude"; empty: not said.
[[nodiscard]] io::http::server_response problem(unsigned status, const std::string& detail,
                                                const std::string& place = {});

// 200 taken; 401 no_session; 403 wrong_role; 408 late; 409 refused, superseded; 412 stale; 422 id_used;
// 423 no_control; 503 busy, not_done; 504 unknown
[[nodiscard]] unsigned status_of(operator_bridge::verdict which);
// ID: of a command; empty: it was none.
[[nodiscard]] io::http::server_response answer_of(const std::string& id, const operator_bridge::command_answer& answer);
[[nodiscard]] io::http::server_response answer_of(const operators::principal& who, std::int64_t ends_ns,
                                                  std::int64_t wall_ns, unsigned status);
[[nodiscard]] io::http::server_response answer_of(const operator_bridge::control_answer& answer);
// IS_YOURS: the one who asks has it.
[[nodiscard]] io::http::server_response answer_of(const operator_bridge::operators_view& view,
                                                  const operators::principal& who);
[[nodiscard]] io::http::server_response answer_of(const operator_bridge::audit_page& page);
[[nodiscard]] io::http::server_response answer_of(const telemetry_stream::points_update& seen);

} // namespace godwit::operator_port
