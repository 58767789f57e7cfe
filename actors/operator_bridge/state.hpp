// What of operator_bridge must survive a crash: who is logged in, who has control and which commands were obeyed. The
// rows of the audit are in a table of the journal (audit_table.hpp), and only their last number is here. The facts
// change it and decide nothing. Pure. Thread: plain values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>
#include <tl/expected.hpp>

#include "io/fields/field_table.hpp"
#include "messages/operator_bridge/audit.hpp"
#include "messages/operator_bridge/command.hpp"
#include "messages/operator_bridge/control.hpp"
#include "messages/operator_bridge/rules.hpp"
#include "messages/operator_bridge/session.hpp"

namespace godwit::operator_bridge {

inline constexpr std::size_t max_kept_commands = 256; // ids whose repetition is known
inline constexpr std::size_t max_kept_of_one = 64;    // of one person or program
inline constexpr std::size_t max_sessions = 64;       // of all; one more ends the one that was silent for longest
inline constexpr std::size_t max_sessions_of_one = 8; // of one name
inline constexpr std::size_t max_links = 8;           // of `ctl login` that nobody has used

struct session {
  std::string id; // "s7"
  account who;    // as it was at the login; without a stamp: by a link, and of no account
  std::string token_hash;
  std::string from;
  std::int64_t opened_ns = 0;
  std::int64_t used_ns = 0; // written once a minute at most
  GODWIT_FIELDS(session, "operator_bridge.session", id, who, token_hash, from, opened_ns, used_ns);
};

struct link {
  std::string hash;
  operators::principal by;
  std::int64_t until_ns = 0;
  GODWIT_FIELDS(link, "operator_bridge.link", hash, by, until_ns);
};

// A command that was handed on, or refused to somebody who is known. While it has no answer, it is with the executor:
// after a crash nobody can say what became of it.
struct kept_command {
  std::uint64_t number = 0;
  operators::principal by;
  std::string id;   // empty: it is not repeated
  std::string text; // of the command, to tell a repetition from another one
  std::int64_t valid_until_ns = 0;
  std::optional<command_answer> answer;
  GODWIT_FIELDS(kept_command, "operator_bridge.kept_command", number, by, id, text, valid_until_ns, answer);
};

// -- facts ------------------------------------------------------------------------------------------

struct command_kept {
  kept_command what;
  GODWIT_FIELDS(command_kept, "operator_bridge.command_kept", what);
};

struct command_ended {
  std::uint64_t number = 0;
  command_answer answer;
  GODWIT_FIELDS(command_ended, "operator_bridge.command_ended", number, answer);
};

// A row of the audit; with the number of an earlier one it takes that one's place. Without a number: of an earlier
// version, which kept the rows in the state.
struct audited {
  audit_row row;
  GODWIT_FIELDS(audited, "operator_bridge.audited", row);
};

// Rows that were in the state are in the table now.
struct rows_moved {
  std::vector<audit_row> rows;
  GODWIT_FIELDS(rows_moved, "operator_bridge.rows_moved", rows);
};

struct control_changed {
  std::optional<operators::principal> to; // none: it is free
  GODWIT_FIELDS(control_changed, "operator_bridge.control_changed", to);
};

struct session_opened {
  session what; // without its times
  GODWIT_FIELDS(session_opened, "operator_bridge.session_opened", what);
};

struct session_used {
  std::string id;
  GODWIT_FIELDS(session_used, "operator_bridge.session_used", id);
};

struct session_closed {
  std::string id;
  GODWIT_FIELDS(session_closed, "operator_bridge.session_closed", id);
};

struct link_made {
  link what;
  GODWIT_FIELDS(link_made, "operator_bridge.link_made", what);
};

struct link_dropped {
  std::string hash;
  GODWIT_FIELDS(link_dropped, "operator_bridge.link_dropped", hash);
};

struct state {
  std::uint64_t last_command = 0;
  std::uint64_t last_session = 0;
  std::uint64_t last_row = 0;
  std::vector<kept_command> commands;           // the oldest first, bounded by max_kept_commands
  std::vector<session> sessions;                // bounded by max_sessions
  std::vector<link> links;                      // bounded by max_links
  std::optional<std::vector<account>> accounts; // none: not read yet, and the sessions count as they are
  std::optional<control_holder> control;
  std::vector<audit_row> unmoved;   // of an older version: still to be written to the table
  static constexpr int version = 2; // 1: with the rows of the audit
  GODWIT_FIELDS(state, "operator_bridge.state", last_command, last_session, last_row, commands, sessions, links,
                control, unmoved, accounts);
};

struct durable_core {
  using state = operator_bridge::state;
  using event = std::variant<command_kept, command_ended, audited, rows_moved, control_changed, session_opened,
                             session_used, session_closed, link_made, link_dropped, accounts_read>;
  using effect = std::variant<command_answer>; // none comes of a fact: the shell answers

  [[nodiscard]] static std::vector<effect> apply(state& s, const event& happened, std::int64_t at_ns);
  [[nodiscard]] static std::vector<effect> resume(const state&, std::int64_t) { return {}; }
  [[nodiscard]] static tl::expected<nlohmann::json, std::string> migrate(nlohmann::json old, int from_version);
};

// A new id can be kept: there is room, or one whose time has passed gives it.
[[nodiscard]] bool has_room(const state& s, const operators::principal& who, std::int64_t wall_ns);

} // namespace godwit::operator_bridge
