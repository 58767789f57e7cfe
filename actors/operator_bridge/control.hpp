// Who has control. Of who is silent for silent_ns it is free; whoever had it when godwitd was restarted has as long to
// be heard again.
//
//   free ──take──> held ──take (oneself), take_over (engineer), hand_over──> held
//    ▲              │
//    └──────────────┴── give, silent for 10 s, its session ends
//
// At the control socket nobody is asked for a sign of life: a command there needs no control as long as it is free.
// Pure. Thread: one owner.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "actors/operator_bridge/audit.hpp"
#include "actors/operator_bridge/effects.hpp"
#include "io/time_units.hpp"

namespace godwit::operator_bridge {

class control {
public:
  static constexpr std::int64_t silent_ns = 10 * ns_per_s;

  control(const state& durable, audit& rows, instant now) : s_(durable), audit_(rows), heard_ns_(now.monotonic_ns) {}

  // WHO was heard. True: WHO has control.
  bool hear(const operators::principal& who, instant now);
  // Why WHO may not command now; empty: nothing stands against it.
  [[nodiscard]] std::string objection_to(const operators::principal& who, instant now) const;
  // BY is known. TO: of a hand_over, who that is; none: nobody of that name is logged in.
  [[nodiscard]] control_answer change(effects& out, const change_control& m,
                                      const std::optional<operators::principal>& to, instant now);
  // Of who is silent, or whose session has ended.
  void free_silent(effects& out, instant now);
  void free_session(effects& out, const std::string& session, instant now);
  // Monotonic; never: a time that does not come.
  [[nodiscard]] std::int64_t silent_at_ns(std::int64_t never) const;

private:
  [[nodiscard]] bool is_silent(instant now) const { return now.monotonic_ns - heard_ns_ > silent_ns; }
  [[nodiscard]] const operators::principal* holder(instant now) const;
  void give_to(effects& out, const change_control& m, std::optional<operators::principal> to, const std::string& what,
               instant now);
  [[nodiscard]] control_answer refuse(effects& out, const change_control& m, const std::string& what,
                                      std::string reason, instant now);

  const state& s_;
  audit& audit_;
  std::int64_t heard_ns_; // of the holder; monotonic
};

} // namespace godwit::operator_bridge
