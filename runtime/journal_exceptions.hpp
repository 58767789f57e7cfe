// The two ways in which the journal ends an incarnation. Both are for the supervisor, not for actor code.
#pragma once

#include <stdexcept>
#include <string>

#include "runtime/journal/error.hpp"

namespace godwit::runtime {

// What the journal keeps of this actor can not be read by this version of it. Restarting does not help: the supervisor
// gives up at once.
struct state_unreadable : std::runtime_error {
  state_unreadable(const std::string& actor, const std::string& why)
      : std::runtime_error(
            "the journal's state of " + actor + " can not be read: " + why +
            ". It was written by another version of godwit; start that version, or move the journal away") {}
};

// The journal did not take a write (its queue is at its bound, or it is closing).
struct journal_refused : std::runtime_error {
  explicit journal_refused(const journal_error& why) : std::runtime_error(why.message()) {}
};

} // namespace godwit::runtime
