// Who has control: the one operator whose commands move the vehicle. Hold and return are open to every operator.
//
// Control of who is silent for control_silent_ns is free. Thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"
#include "messages/operator/principal.hpp"

namespace godwit::operator_bridge {

enum class control_act {
  take,      // that is free, or one's own in another session
  take_over, // from whoever has it: an engineer
  give,      // one's own: it is free then
  hand_over  // one's own, to an operator who is logged in
};

GODWIT_ENUM_NAMES(control_act, take, take_over, give, hand_over);

struct change_control {
  operators::principal by;
  control_act act = control_act::take;
  std::string to; // hand_over: a name
  GODWIT_FIELDS(change_control, "operator_bridge.change_control", by, act, to);
};

struct control_answer {
  bool is_done = false;
  std::string reason; // sentence for people; empty when done
  std::string holder; // who has control after it; empty: nobody
  GODWIT_FIELDS(control_answer, "operator_bridge.control_answer", is_done, reason, holder);
};

struct control_holder {
  operators::principal who;
  std::int64_t since_ns = 0; // ns since 1970 (UTC)
  GODWIT_FIELDS(control_holder, "operator_bridge.control_holder", who, since_ns);
  friend bool operator==(const control_holder&, const control_holder&) = default;
};

// Told when another one has it than before, and when operator_bridge begins anew.
struct control_news {
  std::string holder; // a name; empty: nobody
  GODWIT_FIELDS(control_news, "operator_bridge.control_news", holder);
};

// Whoever has control was heard just now: told as it happens, at most once in holder_news_ns.
struct holder_heard {
  static constexpr auto fields = io::table("operator_bridge.holder_heard");
};

struct get_operators {
  static constexpr auto fields = io::table("operator_bridge.get_operators");
};

struct session_view {
  operators::principal who;
  std::string from; // the way that the login took, such as an address
  std::int64_t opened_ns = 0;
  std::int64_t used_ns = 0; // last, to a minute
  GODWIT_FIELDS(session_view, "operator_bridge.session_view", who, from, opened_ns, used_ns);
};

struct operators_view {
  std::optional<control_holder> control; // none: it is free
  std::vector<session_view> sessions;
  std::uint64_t commands = 0; // since godwitd began
  std::uint64_t refused = 0;  // of them
  GODWIT_FIELDS(operators_view, "operator_bridge.operators_view", control, sessions, commands, refused);
};

} // namespace godwit::operator_bridge
