// A line of the control socket:
//
//   {"do": "status"}
//   {"do": "outbox_retry", "key": "..."}
//   {"do": "start", "by": "anna"}                    and the other words of messages/operator; may have "id" and
//                                                    "valid_until_ns" (messages/operator_bridge), and "state"
//   {"do": "control", "by": "anna", "act": "take"}   or take_over, give, hand_over with "to"
//   {"do": "login", "by": "anna", "link_hash": "..."}
//   {"do": "audit", "by": "anna", "rows": 50, "before": 1200}
//   {"do": "acknowledge", "by": "anna", "report": 1}
//   {"do": "go_to", "by": "anna", "place": {"latitude": 47.398, "longitude": 8.546, "altitude_m": 40}}
//   {"do": "insert", "by": "anna", "point": 3, "altitude_m": 40}
//   {"do": "points"}
//   {"do": "confirm", "by": "anna", "point": 3}        and "decline"
//   {"do": "override", "by": "anna", "rule": "operator_link", "seconds": 600, "reason": "we walk over the hill"}
//   {"do": "crash", "actor": "executor"}
//
// Errors: a sentence. Thread: pure.
#pragma once

#include <string>
#include <string_view>

#include <tl/expected.hpp>

#include "programs/godwitd/control/messages.hpp"

namespace godwit::control {

// Without a ticket.
[[nodiscard]] tl::expected<control_request, std::string> read_request(std::string_view line);

// {"ok":false,"error":"..."}
[[nodiscard]] std::string refusal_line(const std::string& sentence);

} // namespace godwit::control
