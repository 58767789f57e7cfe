// Logging in, and who it is that comes with a token. Tokens are never here: only what SHA-256 makes of them.
//
// Whoever asks has made the token and judged the password; operator_bridge keeps the session. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"
#include "messages/operator/principal.hpp"

namespace godwit::operator_bridge {

// An account, as far as operator_bridge needs it. STAMP changes with the password.
struct account {
  std::string name;
  operators::role role = operators::role::viewer;
  std::string stamp;
  std::string token_hash; // of its bearer token; empty: it has none
  GODWIT_FIELDS(account, "operator_bridge.account", name, role, stamp, token_hash);
  friend bool operator==(const account&, const account&) = default;
};

// The accounts are these: sessions of others end, and of those whose role or password has changed.
struct accounts_read {
  std::vector<account> list;
  GODWIT_FIELDS(accounts_read, "operator_bridge.accounts_read", list);
};

// The password was right.
struct open_session {
  account who;
  std::string token_hash; // of the new session
  std::string from;       // for people: "127.0.0.1"
  GODWIT_FIELDS(open_session, "operator_bridge.open_session", who, token_hash, from);
};

// A link of `godwitd ctl login` is used.
struct use_link {
  std::string link_hash;
  std::string token_hash;
  std::string from;
  GODWIT_FIELDS(use_link, "operator_bridge.use_link", link_hash, token_hash, from);
};

struct session_answer {
  bool is_open = false;
  std::string reason; // sentence for people; empty when open
  operators::principal who;
  std::int64_t ends_ns = 0; // ns since 1970 (UTC), whatever is done in it
  GODWIT_FIELDS(session_answer, "operator_bridge.session_answer", is_open, reason, who, ends_ns);
};

// Somebody at the control socket wants a link that logs in once.
struct make_link {
  operators::principal by;
  std::string link_hash;
  GODWIT_FIELDS(make_link, "operator_bridge.make_link", by, link_hash);
};

struct link_answer {
  bool is_made = false;
  std::string reason;
  std::int64_t valid_until_ns = 0; // ns since 1970 (UTC)
  GODWIT_FIELDS(link_answer, "operator_bridge.link_answer", is_made, reason, valid_until_ns);
};

// Who comes with this token, of a session or of a program. It is a sign of life.
struct identify {
  std::string token_hash;
  GODWIT_FIELDS(identify, "operator_bridge.identify", token_hash);
};

struct identity {
  bool is_known = false;
  operators::principal who;
  std::int64_t ends_ns = 0; // of the session; 0: a program's, which has no end
  GODWIT_FIELDS(identity, "operator_bridge.identity", is_known, who, ends_ns);
};

struct end_session {
  operators::principal by;
  GODWIT_FIELDS(end_session, "operator_bridge.end_session", by);
};

struct session_ended {
  bool was_open = false;
  GODWIT_FIELDS(session_ended, "operator_bridge.session_ended", was_open);
};

} // namespace godwit::operator_bridge
