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
  static constexpr auto fields =
      io::table("operator_bridge.account", io::field("name", &account::name), io::field("role", &account::role),
                io::field("stamp", &account::stamp), io::field("token_hash", &account::token_hash));
  friend bool operator==(const account&, const account&) = default;
};

// The accounts are these: sessions of others end, and of those whose role or password has changed.
struct accounts_read {
  std::vector<account> list;
  static constexpr auto fields = io::table("operator_bridge.accounts_read", io::field("list", &accounts_read::list));
};

// The password was right.
struct open_session {
  account who;
  std::string token_hash; // of the new session
  std::string from;       // for people: "127.0.0.1"
  static constexpr auto fields =
      io::table("operator_bridge.open_session", io::field("who", &open_session::who),
                io::field("token_hash", &open_session::token_hash), io::field("from", &open_session::from));
};

// A link of `godwitd ctl login` is used.
struct use_link {
  std::string link_hash;
  std::string token_hash;
  std::string from;
  static constexpr auto fields =
      io::table("operator_bridge.use_link", io::field("link_hash", &use_link::link_hash),
                io::field("token_hash", &use_link::token_hash), io::field("from", &use_link::from));
};

struct session_answer {
  bool is_open = false;
  std::string reason; // sentence for people; empty when open
  operators::principal who;
  std::int64_t ends_ns = 0; // ns since 1970 (UTC), whatever is done in it
  static constexpr auto fields =
      io::table("operator_bridge.session_answer", io::field("is_open", &session_answer::is_open),
                io::field("reason", &session_answer::reason), io::field("who", &session_answer::who),
                io::field("ends_ns", &session_answer::ends_ns));
};

// Somebody at the control socket wants a link that logs in once.
struct make_link {
  operators::principal by;
  std::string link_hash;
  static constexpr auto fields = io::table("operator_bridge.make_link", io::field("by", &make_link::by),
                                           io::field("link_hash", &make_link::link_hash));
};

struct link_answer {
  bool is_made = false;
  std::string reason;
  std::int64_t valid_until_ns = 0; // ns since 1970 (UTC)
  static constexpr auto fields =
      io::table("operator_bridge.link_answer", io::field("is_made", &link_answer::is_made),
                io::field("reason", &link_answer::reason), io::field("valid_until_ns", &link_answer::valid_until_ns));
};

// Who comes with this token, of a session or of a program. It is a sign of life.
struct identify {
  std::string token_hash;
  static constexpr auto fields = io::table("operator_bridge.identify", io::field("token_hash", &identify::token_hash));
};

struct identity {
  bool is_known = false;
  operators::principal who;
  std::int64_t ends_ns = 0; // of the session; 0: a program's, which has no end
  static constexpr auto fields = io::table("operator_bridge.identity", io::field("is_known", &identity::is_known),
                                           io::field("who", &identity::who), io::field("ends_ns", &identity::ends_ns));
};

struct end_session {
  operators::principal by;
  static constexpr auto fields = io::table("operator_bridge.end_session", io::field("by", &end_session::by));
};

struct session_ended {
  bool was_open = false;
  static constexpr auto fields =
      io::table("operator_bridge.session_ended", io::field("was_open", &session_ended::was_open));
};

} // namespace godwit::operator_bridge
