// The command line of godwitd, read.
//
// Errors: exit code 2 with a sentence and the help on stderr; --help and --version end with 0. Thread: one.
#pragma once

#include <cstdint>
#include <string>

#include <tl/expected.hpp>

#include "messages/operator/types.hpp"
#include "messages/operator_bridge/control.hpp"
#include "messages/scan_controller/point.hpp"
#include "programs/godwitd/accounts/operator_command.hpp"
#include "programs/godwitd/configuration.hpp"
#include "programs/godwitd/convert_command.hpp"
#include "runtime/process.hpp"

namespace godwit::daemon {

enum class task {
  run,
  check_config,
  examine,
  may_restart,
  list_outbox,
  convert,
  ask_status,
  retry_outbox,
  say_word,
  override_failsafe,
  crash_actor,
  list_points,
  decide_point,
  rescue_journal,
  set_up_signing,
  change_control,
  list_audit,
  make_link,
  keep_accounts
};

struct wanted_override {
  std::string rule;
  std::int64_t seconds = 0;
  std::string reason;
};

struct wanted_control {
  operator_bridge::control_act act = operator_bridge::control_act::take;
  std::string to; // hand_over
};

struct invocation {
  task what = task::run;
  given_texts options;                   // by the names of configuration.hpp
  bool json = false;                     // answers for programs
  std::uint32_t patience_s = 5;          // examine: so long it listens on the line
  convert_arguments files;               // convert
  std::string outbox_key;                // retry_outbox; empty: all
  operators::command said;               // say_word; by is left empty
  wanted_override overridden;            // override_failsafe
  std::string actor;                     // crash_actor
  wanted_control control;                // change_control
  std::uint32_t rows = 50;               // list_audit
  std::uint64_t before = 0;              // the same; 0: the newest
  accounts::operator_arguments account;  // keep_accounts
  scan_controller::decide_point decided; // decide_point; by is left empty
  std::uint64_t point = 0;               // say_word, insert: at its place; 0: none
  bool ends_signing = false;             // set_up_signing
  [[nodiscard]] bool has(std::string_view option) const { return options.contains(option); }
};

// Or with what the program ends at once.
[[nodiscard]] tl::expected<invocation, runtime::exit_code> read_command_line(int argc, const char* const* argv);

} // namespace godwit::daemon
