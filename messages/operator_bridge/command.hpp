// A command of a person or a program, with all that is needed to obey it at most once, in time, and only from who may.
//
// Whatever way it comes (control socket, HTTP, a ground station), it becomes this, and operator_bridge answers it.
// Thread: plain values.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

#include "io/fields/field_table.hpp"
#include "messages/operator/principal.hpp"
#include "messages/operator/types.hpp"

namespace godwit::operator_bridge {

inline constexpr std::size_t max_command_id = 64;

// Of who brings a hold or a return: longer than the answer takes; then it goes past operator_bridge, to the executor.
inline constexpr std::chrono::milliseconds stop_patience{300};

struct operator_command {
  std::string id; // made by the sender, another one for each command that it means; empty: not repeated
  std::int64_t valid_until_ns = 0; // ns since 1970 (UTC); later it is refused; 0: a few seconds from now on
  operators::principal by;
  operators::command what; // `by` is filled in from the principal
  GODWIT_FIELDS(operator_command, "operator_bridge.command", id, valid_until_ns, by, what);
};

enum class verdict {
  taken,      // the executor has it; what comes of it is seen in the status of the flight
  refused,    // by the executor, or it makes no sense: `reason` says why
  stale,      // it was meant for another state of the flight; `state` is how it stands
  late,       // its time had passed before it could be obeyed
  no_session, // nobody is logged in there, any more
  wrong_role, // this person may not say it
  no_control, // somebody else has control, or nobody
  id_used,    // by the same person, for another command
  superseded, // a hold or a return came before it went out
  busy,       // too many are under way
  not_done,   // the executor takes nothing now: nothing was done
  unknown     // it was handed over, and what became of it is not known: look at the status
};

GODWIT_ENUM_NAMES(verdict, taken, refused, stale, late, no_session, wrong_role, no_control, id_used, superseded, busy,
                  not_done, unknown);

struct command_answer {
  operator_bridge::verdict verdict = operator_bridge::verdict::unknown;
  std::string reason;     // sentence for people; of one that is taken what its sender should know, mostly nothing
  std::string state = {}; // of the flight, when stale
  GODWIT_FIELDS(command_answer, "operator_bridge.command_answer", verdict, reason, state);
  friend bool operator==(const command_answer&, const command_answer&) = default;
};

// May BY do something that is no command to the flight, such as a decision about a point of interest? The rules are
// those of a command. A refusal is in the audit; of what is granted whoever does it tells the outcome.
struct ask_leave {
  operators::principal by;
  std::string what; // for the audit
  GODWIT_FIELDS(ask_leave, "operator_bridge.ask_leave", by, what);
};

struct leave {
  operator_bridge::verdict verdict = operator_bridge::verdict::unknown; // taken: it may be done
  std::string reason;                                                   // sentence for people; empty when taken
  GODWIT_FIELDS(leave, "operator_bridge.leave", verdict, reason);
};

} // namespace godwit::operator_bridge
