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

constexpr auto enum_names(ask_errc) {
  return io::names<ask_errc>({{ask_errc::timeout, "timeout"},
                              {ask_errc::not_taken, "not_taken"},
                              {ask_errc::outcome_unknown, "outcome_unknown"},
                              {ask_errc::given_up, "given_up"}});
}

struct ask_error {
  ask_errc code = ask_errc::timeout;
  std::string what;
  static constexpr auto fields =
      io::table("runtime.ask_error", io::field("code", &ask_error::code), io::field("what", &ask_error::what));
};

// How a failed ask appears in the trace.
struct ask_failed {
  ask_error why;
  static constexpr auto fields = io::table("runtime.ask_failed", io::field("why", &ask_failed::why));
};

[[nodiscard]] ask_error describe(const caf::error& why);

} // namespace godwit::runtime
