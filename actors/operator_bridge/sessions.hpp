// Who is logged in. A session is opened for a password that was right, or for a link of `godwitd ctl login`, which
// works once; it ends when it was silent for long, after its longest time, at a logout, and when its account is gone or
// has another role or password. A program comes with the bearer token of its account and has no session to open.
//
// Ends are told by the wall clock, because they have to hold over a restart. Pure. Thread: one owner.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "actors/operator_bridge/audit.hpp"
#include "actors/operator_bridge/control.hpp"
#include "actors/operator_bridge/effects.hpp"
#include "actors/operator_bridge/settings.hpp"
#include "io/time_units.hpp"

namespace godwit::operator_bridge {

class sessions {
public:
  static constexpr std::int64_t link_ns = 300 * ns_per_s;        // from `ctl login` to its use
  static constexpr std::int64_t written_each_ns = 60 * ns_per_s; // that it was used
  static constexpr std::int64_t swept_each_ns = 60 * ns_per_s;

  sessions(const settings& set, const state& durable, audit& rows, control& has_control)
      : set_(set), s_(durable), audit_(rows), control_(has_control) {}

  // -- in and out
  [[nodiscard]] session_answer open(effects& out, const open_session& m, instant now);
  [[nodiscard]] session_answer open(effects& out, const use_link& m, instant now);
  [[nodiscard]] link_answer make(effects& out, const make_link& m, instant now);
  [[nodiscard]] session_ended close(effects& out, const end_session& m, instant now);

  // -- who it is
  [[nodiscard]] identity find(effects& out, const identify& m, instant now);
  // It was used.
  void touch(effects& out, const std::string& id, instant now);
  // BY is still whom it was found to be.
  [[nodiscard]] bool is_alive(const operators::principal& by, instant now) const;
  // The newest session of that name.
  [[nodiscard]] std::optional<operators::principal> named(const std::string& name, instant now) const;

  void on_accounts(effects& out, const accounts_read& m, instant now);
  void sweep(effects& out, instant now);

private:
  [[nodiscard]] bool is_over(const session& each, instant now) const;
  [[nodiscard]] std::int64_t used_ns(const session& each) const;
  [[nodiscard]] session_answer put(effects& out, account who, std::string token_hash, std::string from, instant now);
  void end(effects& out, const session& each, const std::string& why, instant now);
  void make_room(effects& out, const std::string& name, instant now);

  const settings& set_;
  const state& s_;
  audit& audit_;
  control& control_;
  std::map<std::string, std::int64_t> used_ns_; // by the session, wall clock; newer than what is written
};

} // namespace godwit::operator_bridge
