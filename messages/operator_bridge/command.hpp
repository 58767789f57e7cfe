// A command of a person or a program, with all that is needed to obey it at most once, in time, and only from who may.
//
// Whatever way it comes (control socket, HTTP, a ground station), it becomes this, and operator_bridge answers it.
// Thread: plain values.
#pragma once

#include <cstdint>
#include <string>

#include "io/fields/field_table.hpp"
#include "messages/operator/principal.hpp"
#include "messages/operator/types.hpp"

namespace godwit::operator_bridge {

inline constexpr std::size_t max_command_id = 64;

struct operator_command {
  std::string id; // made by the sender, another one for each command that it means; empty: not repeated
  std::int64_t valid_until_ns = 0; // ns since 1970 (UTC); later it is refused; 0: a few seconds from now on
  operators::principal by;
  operators::command what; // `by` is filled in from the principal
  static constexpr auto fields =
      io::table("operator_bridge.command", io::field("id", &operator_command::id),
                io::field("valid_until_ns", &operator_command::valid_until_ns), io::field("by", &operator_command::by),
                io::field("what", &operator_command::what));
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

constexpr auto enum_names(verdict) {
  return io::names<verdict>({{verdict::taken, "taken"},
                             {verdict::refused, "refused"},
                             {verdict::stale, "stale"},
                             {verdict::late, "late"},
                             {verdict::no_session, "no_session"},
                             {verdict::wrong_role, "wrong_role"},
                             {verdict::no_control, "no_control"},
                             {verdict::id_used, "id_used"},
                             {verdict::superseded, "superseded"},
                             {verdict::busy, "busy"},
                             {verdict::not_done, "not_done"},
                             {verdict::unknown, "unknown"}});
}

struct command_answer {
  operator_bridge::verdict verdict = operator_bridge::verdict::unknown;
  std::string reason;     // sentence for people; empty when taken
  std::string state = {}; // of the flight, when stale
  static constexpr auto fields =
      io::table("operator_bridge.command_answer", io::field("verdict", &command_answer::verdict),
                io::field("reason", &command_answer::reason), io::field("state", &command_answer::state));
  friend bool operator==(const command_answer&, const command_answer&) = default;
};

// May BY do something that is no command to the flight, such as a decision about a point of interest? The rules are
// those of a command. A refusal is in the audit; of what is granted whoever does it tells the outcome.
struct ask_leave {
  operators::principal by;
  std::string what; // for the audit
  static constexpr auto fields =
      io::table("operator_bridge.ask_leave", io::field("by", &ask_leave::by), io::field("what", &ask_leave::what));
};

struct leave {
  operator_bridge::verdict verdict = operator_bridge::verdict::unknown; // taken: it may be done
  std::string reason;                                                   // sentence for people; empty when taken
  static constexpr auto fields =
      io::table("operator_bridge.leave", io::field("verdict", &leave::verdict), io::field("reason", &leave::reason));
};

} // namespace godwit::operator_bridge
