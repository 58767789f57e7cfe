// Why an ask got no answer. All but `not_taken` leave open whether the receiver acted: ask again with the same key.
// Thread: plain values.
#pragma once

#include <string>

#include "io/fields/field_table.hpp"

namespace caf {
class error;
}

namespace godwit::runtime {

enum class ask_errc {
  timeout,         // no answer in time
  not_taken,       // the receiver has stopped, or its mailbox is at its bound: the request was not handled
  outcome_unknown, // the receiver crashed while it had the request
  given_up,        // the request crashed its handler max_crashes times and is in the dead-letter table
};

GODWIT_ENUM_NAMES(ask_errc, timeout, not_taken, outcome_unknown, given_up);

struct ask_error {
  ask_errc code = ask_errc::timeout;
  std::string what;
  GODWIT_FIELDS(ask_error, "runtime.ask_error", code, what);
};

// How a failed ask appears in the trace.
struct ask_failed {
  ask_error why;
  GODWIT_FIELDS(ask_failed, "runtime.ask_failed", why);
};

[[nodiscard]] ask_error describe(const caf::error& why);

} // namespace godwit::runtime
